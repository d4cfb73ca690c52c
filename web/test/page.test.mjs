// The page in Chromium, as people use it.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { chromium as browserType } from 'playwright-core';
import {
  byTool, chromium, chromiumArguments, data, page as folder, root, scratch, solveMsByTool, torus,
} from './setup.mjs';
import { serve } from './serve.mjs';

let browser, server, page;
const complaints = [];
const pictures = process.env.PLEXWAY_PICTURES;
const measured = {};

before(async () => {
  assert.ok(chromium, 'no Chromium: install the package chromium');
  server = await serve(folder);
  browser = await browserType.launch({ executablePath: chromium, args: chromiumArguments });
  page = await browser.newPage({ viewport: { width: 1200, height: 760 } });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  await page.goto(server.url);
  await page.waitForFunction(() => self.plexwayPage?.timings.firstPicture > 0, null, { timeout: 60000 });
  measured.firstPicture = await page.evaluate(() => self.plexwayPage.timings.firstPicture);
});
after(async () => {
  await browser?.close();
  server?.close();
  if (process.env.PLEXWAY_MEASURED)
    writeFileSync(process.env.PLEXWAY_MEASURED, JSON.stringify(measured, null, 2) + '\n');
  console.log(JSON.stringify(measured));
});

const idle = () => page.waitForTimeout(200);
const shot = async (name) => {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await page.screenshot({ path: join(pictures, `${name}.png`) });
};
const noError = async () => assert.equal(await page.locator('#error').isVisible(), false,
  await page.locator('#error').textContent());
const sourceOnCanvas = () => page.evaluate(() =>
  self.plexwayPage.view.onCanvas(self.plexwayPage.state.sources[0].at));
const field = () => page.evaluate(() => Array.from(self.plexwayPage.state.distance.slice(0, 2000)));
const openFile = async (...files) => {
  const before = await page.evaluate(() => self.plexwayPage.timings.moves.length);
  await page.setInputFiles('#file', files);
  await page.waitForFunction((n) => self.plexwayPage.timings.moves.length > n, before, { timeout: 60000 });
  await idle();
};

test('the first sample is there, in colours', async () => {
  await noError();
  const colours = await page.evaluate(async () => {
    const { view } = self.plexwayPage;
    view.drawNow();
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [view.canvas.width, view.canvas.height];
    const context = copy.getContext('2d');
    context.drawImage(view.canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    const seen = new Set();
    for (let k = 0; k < data.length; k += 4 * 97) seen.add((data[k] >> 4) * 256 + (data[k + 1] >> 4) * 16 + (data[k + 2] >> 4));
    return seen.size;
  });
  assert.ok(colours > 40, `${colours} colours`);
  await shot('spot');
});

test('dragging the ball moves the source, live', async () => {
  const [x, y] = await sourceOnCanvas();
  const box = await page.locator('#canvas').boundingBox();
  const first = await field();
  await page.mouse.move(box.x + x, box.y + y);
  await page.mouse.down();
  const centre = [box.width / 2, box.height / 2];
  for (let k = 1; k <= 20; ++k) {
    await page.mouse.move(box.x + x + ((centre[0] - x) * k) / 20, box.y + y + ((centre[1] - y) * k) / 20);
    await page.waitForTimeout(30);
  }
  await page.mouse.up();
  await idle();
  assert.notDeepEqual(await field(), first);
  const [nx, ny] = await sourceOnCanvas();
  assert.ok(Math.hypot(nx - centre[0], ny - centre[1]) < 5, `the ball is at ${nx}, ${ny}`);
  await noError();
});

test('a second source makes cells', async () => {
  await page.check('input[value=add]');
  const box = await page.locator('#canvas').boundingBox();
  const vertex = await page.evaluate(() => {
    const { state } = self.plexwayPage;
    let far = 0;
    state.distance.forEach((d, v) => { if (Number.isFinite(d) && d > state.distance[far]) far = v; });
    return far;
  });
  assert.ok(vertex > 0);
  const [x, y] = [box.width / 2 + 60, box.height / 2 + 40];
  await page.mouse.click(box.x + x, box.y + y);
  await idle();
  assert.equal(await page.evaluate(() => self.plexwayPage.state.sources.length), 2);
  await page.selectOption('#show', 'cells');
  const labels = await page.evaluate(() => [...new Set(self.plexwayPage.state.label)]);
  assert.deepEqual(labels.sort(), [0, 1]);
  await shot('cells');
  await page.click('#clear');
  await idle();
  assert.equal(await page.evaluate(() => self.plexwayPage.state.sources.length), 1);
  await page.selectOption('#show', 'distance');
});

test('a shortest path to a second point', async () => {
  await page.check('input[value=path]');
  const box = await page.locator('#canvas').boundingBox();
  await page.mouse.click(box.x + box.width / 2 + 30, box.y + box.height / 2 - 20);
  await page.waitForFunction(() => /ms/.test(document.getElementById('length').textContent), null, { timeout: 20000 });
  await shot('path');
  await page.check('input[value=move]');
  await noError();
});

test('beside Dijkstra on the edges', async () => {
  await page.selectOption('#show', 'difference');
  await page.waitForFunction(() => /%/.test(document.getElementById('against').textContent), null, { timeout: 20000 });
  await shot('dijkstra');
  await page.selectOption('#show', 'distance');
});

test('every kind of file, and what is exported is what the tool writes', async () => {
  for (const name of ['knot.ply', 'hills.off', 'box.stl', 'elbow.mesh', 'vessels.obj', 'roll.xyz']) {
    await openFile(join(data, name));
    await noError();
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-save=npy]')]);
    const file = join(scratch, 'page.npy');
    await download.saveAs(file);
    // As the page says that the tool is asked, for the same bits.
    const [, options] = /^plexway distance \S+ (.*) --out/.exec(await page.inputValue('#command'));
    assert.ok(readFileSync(file).equals(byTool(join(data, name), options.split(' '))), name);
    const windows = !/\.(mesh|obj)$/.test(name);
    assert.equal(options, windows ? '--source vertex:0 --accuracy fast' : '--source vertex:0');
    assert.equal(/accuracy="fast"\)$/.test(await page.inputValue('#python')), windows);
    await shot(name.replace('.', '-'));
  }
});

test('a solid is cut by a plane that moves', async () => {
  await openFile(join(data, 'elbow.mesh'));
  assert.ok(await page.locator('#cutting').isVisible());
  assert.ok(await page.isChecked('#cut'));
  await page.fill('#where', '300');
  await idle();
  await page.click('#play');
  await page.waitForTimeout(400);
  await page.click('#play');
  assert.notEqual(await page.inputValue('#where'), '300');
  await shot('cut');
  await noError();
});

test('pictures and files to take along', async () => {
  for (const kind of ['png', 'csv', 'ply', 'vtu']) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(`[data-save=${kind}]`)]);
    const file = join(scratch, `page.${kind}`);
    await download.saveAs(file);
    assert.ok(readFileSync(file).length > 500, kind);
  }
  assert.match(await page.inputValue('#command'), /^plexway distance elbow\.mesh --source vertex:\d+ --out/);
  assert.match(await page.inputValue('#python'), /import plexway/);
});

test('bad files: one sentence, and the picture stays', async () => {
  const before = await page.evaluate(() => self.plexwayPage.state.file);
  for (const [name, text] of [['broken.obj', 'v 0 0 0\nf 1 2 3\n'], ['none.ply', ''], ['what.docx', 'PK']]) {
    await page.setInputFiles('#file', { name, mimeType: 'text/plain', buffer: Buffer.from(text) });
    await page.locator('#error:visible', { hasText: name }).waitFor();
    const words = await page.locator('#error').textContent();
    assert.ok(!words.includes('\n'), words);
  }
  assert.equal(await page.evaluate(() => self.plexwayPage.state.file), before);
  await openFile(join(data, 'knot.ply'));
  await noError();
});

test('by keyboard alone', async () => {
  await page.focus('#canvas');
  const seen = () => page.evaluate(() => self.plexwayPage.view.ray(300, 300).from.join());
  for (const key of ['ArrowLeft', 'ArrowUp', '+', '-', 'r']) {
    const before = await seen();
    await page.keyboard.press(key);
    await idle();
    if (key !== 'r') assert.notEqual(await seen(), before, key);
  }
  await page.keyboard.press('p');
  await page.keyboard.press('s');
  await idle();
  await noError();
  await page.keyboard.press('Tab');
  assert.notEqual(await page.evaluate(() => document.activeElement.id), 'canvas');
});

test('on a phone, in the dark, nothing is cut off', async () => {
  await page.setViewportSize({ width: 390, height: 800 });
  await page.check('#dark');
  await idle();
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} pixels wide`);
  await shot('phone');
  await page.uncheck('#dark');
  await page.setViewportSize({ width: 1200, height: 760 });
});

test('opened again by its link, and offline', async () => {
  await page.selectOption('#sample', '4');
  await page.waitForFunction(() => self.plexwayPage.state.file === 'vessels.obj');
  await idle();
  const link = await page.evaluate(() => location.href);
  assert.match(link, /sample=4/);
  const context = await browser.newContext();
  const other = await context.newPage();
  await other.goto(link);
  await other.waitForFunction(() => self.plexwayPage?.timings.firstPicture > 0, null, { timeout: 60000 });
  assert.equal(await other.evaluate(() => self.plexwayPage.state.file), 'vessels.obj');
  await other.waitForFunction(() => navigator.serviceWorker.ready.then(() => true));
  await other.reload();
  await other.waitForFunction(() => self.plexwayPage?.timings.firstPicture > 0, null, { timeout: 60000 });
  await context.setOffline(true);
  await other.reload();
  await other.waitForFunction(() => self.plexwayPage?.timings.firstPicture > 0, null, { timeout: 60000 });
  await context.close();
});

test('from a disk, without a server', async () => {
  const other = await browser.newPage();
  await other.goto('file://' + join(folder, 'index.html'));
  await other.waitForFunction(() => self.plexwayPage?.timings.firstPicture > 0, null, { timeout: 60000 });
  assert.ok((await other.evaluate(() => self.plexwayPage.state.distance.length)) > 1000);
  await other.close();
});

test('a mesh that is too large is refused with its size', async () => {
  await page.evaluate(() => self.plexwayPage.openFiles([{ name: 'huge.ply', size: 5e8 }]));
  assert.match(await page.locator('#error').textContent(), /huge\.ply: 477 MB/);
  await openFile(join(data, 'knot.ply'));
});

test('every accuracy, live', async () => {
  for (const accuracy of ['accurate', 'exact', 'fast']) {
    const before = await page.evaluate(() => self.plexwayPage.timings.solves.length);
    await page.selectOption('#accuracy', accuracy);
    await page.waitForFunction((n) => self.plexwayPage.timings.solves.length > n, before, { timeout: 60000 });
    await idle();
    await noError();
  }
});

// Times are told, not asserted: what they are on a busy machine says nothing.
for (const [name, vertices] of [['scan', 35000], ['large', 100000]])
  test(`how long a move takes: ${vertices} vertices`, async () => {
    const file = join(scratch, `${name}.ply`);
    writeFileSync(file, torus(vertices));
    await openFile(file);
    const moves = await page.evaluate(async () => {
      const { view, timings } = self.plexwayPage;
      const from = timings.moves.length, solves = timings.solves.length;
      const canvas = view.canvas.getBoundingClientRect();
      const send = (type, x, y) => view.canvas.dispatchEvent(new PointerEvent(type, {
        pointerId: 1, clientX: canvas.left + x, clientY: canvas.top + y, buttons: 1, bubbles: true }));
      // The ball may hide behind: it is put at the vertex that is nearest to the eye.
      const { positions } = self.plexwayPage.state.domain, eye = view.ray(0, 0).from;
      let front = 0, most = -Infinity;
      for (let k = 0; k < positions.length; k += 3) {
        const toEye = positions[k] * eye[0] + positions[k + 1] * eye[1] + positions[k + 2] * eye[2];
        if (toEye > most) [most, front] = [toEye, k];
      }
      const [x, y] = view.onCanvas(positions.slice(front, front + 3));
      view.canvas.setPointerCapture = () => {};
      send('pointerdown', x, y);
      send('pointerup', x, y);
      await new Promise((done) => setTimeout(done, 800));
      const [bx, by] = view.onCanvas(self.plexwayPage.state.sources[0].at);
      send('pointerdown', bx, by);
      for (let k = 0; k < 40; ++k) {
        send('pointermove', bx - 2 * k, by - 0.5 * k);
        await new Promise((done) => setTimeout(done, 60));
      }
      send('pointerup', bx - 80, by - 20);
      await new Promise((done) => setTimeout(done, 500));
      return { moves: timings.moves.slice(from), solves: timings.solves.slice(solves) };
    });
    const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
    assert.ok(moves.moves.length > 3, `${moves.moves.length} moves`);
    const native = solveMsByTool(file);
    measured[name] = { vertices: await page.evaluate(() => self.plexwayPage.state.domain.vertices),
      moveMs: median(moves.moves), solveMs: median(moves.solves), nativeMs: native,
      timesNative: median(moves.solves) / native, moves: moves.moves.length };
  });

test('nothing was complained about', () => {
  const expected = /favicon/;
  assert.deepEqual(complaints.filter((line) => !expected.test(line)), []);
  assert.ok(root.length > 0);
});
