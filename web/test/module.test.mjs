// The module against the command-line tool: the same bits on files of every kind.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, join } from 'node:path';
import { test } from 'node:test';
import { byTool, converted, data, moduleFolder, scratch, tool } from './setup.mjs';
import { build } from 'esbuild';

// The page's own calls, bundled around the module as the worker has them.
const bundled = join(scratch, 'engine.cjs');
await build({
  entryPoints: [join(import.meta.dirname ?? new URL('.', import.meta.url).pathname, '../page/engine.js')],
  bundle: true, format: 'cjs', platform: 'node', outfile: bundled, logLevel: 'error',
  alias: { 'plexway-module': join(moduleFolder, 'plexway.cjs') },
});
const { loadEngine } = createRequire(import.meta.url)(bundled);
const engine = await loadEngine(readFileSync(join(moduleFolder, 'plexway.wasm')));

const read = (...names) => names.map((name) => ({ name: basename(name), bytes: readFileSync(join(data, name)) }));

for (const [kind, vertex, ...files] of [
  ['surface', 0, 'knot.ply'], ['surface', 17, 'hills.off'], ['surface', 3, 'box.stl'],
  ['surface', 100, 'exact/surfaces/spot.obj'], ['surface', 5, 'moebius.obj'], ['surface', 9, 'two_parts.obj'],
  ['solid', 20, 'elbow.mesh'], ['solid', 14, 'exact/solids/notch_10k.node', 'exact/solids/notch_10k.ele'],
  ['wireframe', 4, 'vessels.obj'], ['cloud', 8, 'roll.xyz'],
]) {
  test(`${files[0]}: the module and the tool write the same bytes`, () => {
    const told = engine.open(read(...files));
    assert.equal(told.kind, kind);
    assert.equal(told.positions.length, 3 * told.vertices);
    engine.setSource(0, vertex);
    const solved = engine.solve('usual');
    assert.equal(solved.distance[vertex], 0);
    for (const extension of ['npy', 'csv']) {
      const ours = Buffer.from(engine.write('d.' + extension));
      assert.ok(ours.equals(byTool(join(data, files[0]), ['--source', `vertex:${vertex}`], extension)),
        `the .${extension} differs`);
    }
  });
}

for (const [from, ...extensions] of [
  ['knot.ply', 'obj', 'off', 'ply', 'stl'],
  ['elbow.mesh', 'mesh', 'vtu', 'vtk', 'node'],
  ['vessels.obj', 'edges', 'obj'],
])
  for (const extension of extensions)
    test(`.${extension} of ${from}: the module and the tool write the same bytes`, () => {
      const file = converted(join(data, from), extension);
      const names = extension === 'node' ? [file, file.replace(/node$/, 'ele')] : [file];
      const files = names.map((name) => ({ name: basename(name), bytes: readFileSync(name) }));
      if (extension === 'edges') {
        // By lengths alone there is nothing to draw, and that is said.
        assert.throws(() => engine.open(files), /can be solved, but has no directions and cannot be drawn/);
        return;
      }
      engine.open(files);
      engine.setSource(0, 7);
      engine.solve('usual');
      assert.ok(Buffer.from(engine.write('d.npy')).equals(byTool(file, ['--source', 'vertex:7'])));
    });

test('lines and triangles of one file are a mixed domain', () => {
  const file = join(scratch, 'mixed.vtk');
  writeFileSync(file, [
    '# vtk DataFile Version 3.0', 'a square with a whisker', 'ASCII', 'DATASET UNSTRUCTURED_GRID',
    'POINTS 5 double', '0 0 0', '1 0 0', '1 1 0', '0 1 0', '2 1 0',
    'CELLS 3 11', '3 0 1 2', '3 0 2 3', '2 2 4', 'CELL_TYPES 3', '5', '5', '3', ''].join('\n'));
  const told = engine.open([{ name: 'mixed.vtk', bytes: readFileSync(file) }], 'mixed');
  assert.equal(told.kind, 'mixed');
  assert.equal(told.edges.length, 2);
  assert.equal(told.triangles.length, 6);
  engine.setSource(0, 0);
  const { distance } = engine.solve('usual');
  assert.ok(Math.abs(distance[4] - (Math.SQRT2 + 1)) < 1e-6);
});

test('what distances may be far off by is told', () => {
  // Two squares of points, corner to corner: no triangles join them.
  const points = [];
  for (let i = 0; i < 12; ++i)
    for (let j = 0; j < 12; ++j) points.push(`${i} ${j} 0`, `${13.5 + i} ${13.5 + j} 0`);
  const { notes } = engine.open([{ name: 'squares.xyz', bytes: Buffer.from(points.join('\n') + '\n') }]);
  assert.ok(notes.some((note) => note.includes('no triangles between them')), notes.join());
  assert.ok(notes.every((note) => !note.includes('--')), 'options of the tool are not the page\'s');
  engine.setSource(0, 0);
  assert.ok(Array.isArray(engine.solve('usual').notes));
  assert.deepEqual(engine.open(read('knot.ply')).notes, []);
});

for (const accuracy of ['fast', 'accurate', 'exact'])
  test(`${accuracy}: the module and the tool write the same bytes`, () => {
    engine.open(read('exact/surfaces/spot.obj'));
    engine.setSource(0, 100);
    engine.solve(accuracy);
    const precision = accuracy === 'exact' ? ['--precision', 'double'] : [];
    assert.ok(Buffer.from(engine.write('d.npy')).equals(byTool(join(data, 'exact/surfaces/spot.obj'),
      ['--source', 'vertex:100', '--accuracy', accuracy, ...precision])));
  });

test('what is on screen is the boundary of a solid: closed, each edge on two triangles', () => {
  const { triangles } = engine.open(read('elbow.mesh'));
  const edges = new Map();
  for (let t = 0; t < triangles.length; t += 3)
    for (let i = 0; i < 3; ++i) {
      const pair = [triangles[t + i], triangles[t + (i + 1) % 3]].sort((a, b) => a - b).join();
      edges.set(pair, (edges.get(pair) ?? 0) + 1);
    }
  assert.ok(edges.size > 100);
  assert.ok([...edges.values()].every((count) => count === 2));
});

test('a picked point is a source: distances around it are those of straight lines', () => {
  const { positions } = engine.open(read('box.stl'));
  let [low, high] = [Infinity, -Infinity];
  for (let k = 2; k < positions.length; k += 3) [low, high] = [Math.min(low, positions[k]), Math.max(high, positions[k])];
  // Straight down on the top, a little off its middle.
  const hit = engine.pick({ from: [0.13, 0.07, 10 * high], direction: [0, 0, -1], slack: 0 });
  assert.ok(hit.hit);
  assert.ok(Math.abs(hit.at[2] - high) < 1e-6 * (high - low));
  engine.setSource(0);
  const { distance } = engine.solve('fast');
  let seen = 0;
  for (let v = 0; v < distance.length; ++v) {
    const [x, y, z] = positions.subarray(3 * v, 3 * v + 3);
    if (Math.abs(z - high) > 1e-6) continue;
    const straight = Math.hypot(x - hit.at[0], y - hit.at[1]);
    assert.ok(Math.abs(distance[v] - straight) < 1e-5 * straight, `vertex ${v}: ${distance[v]}, ${straight}`);
    ++seen;
  }
  assert.ok(seen >= 4);
});

test('the cut of a solid lies on its plane and carries values between those of the vertices', () => {
  engine.open(read('elbow.mesh'));
  engine.setSource(0, 0);
  const { farthest } = engine.solve('fast');
  const { section, triangles } = engine.cut([0.6, 0, 0.8], 0.01);
  assert.ok(triangles > 10);
  for (let k = 0; k < section.length; k += 4) {
    assert.ok(Math.abs(0.6 * section[k] + 0.8 * section[k + 2] - 0.01) < 1e-5);
    assert.ok(section[k + 3] >= 0 && section[k + 3] <= farthest * (1 + 1e-6));
  }
});

test('Dijkstra on the edges is never shorter, and longer in the mean', () => {
  engine.open(read('exact/surfaces/spot.obj'));
  engine.setSource(0, 100);
  engine.solve('fast');
  const told = engine.compare();
  assert.ok(told.mean > 0.005 && told.mean < 0.2, `mean ${told.mean}`);
  assert.ok(told.difference.every((share) => share > -0.03));
});

test('a path is as long as the distance where it starts', () => {
  const { positions } = engine.open(read('exact/surfaces/spot.obj'));
  engine.setSource(0, 100);
  const { distance } = engine.solve('fast');
  const vertex = 2000;
  const [x, y, z] = positions.subarray(3 * vertex, 3 * vertex + 3);
  const hit = engine.pick({ from: [3 * x, 3 * y, 3 * z], direction: [-x, -y, -z], slack: 0.01 });
  assert.ok(hit.hit);
  const way = engine.path('fast');
  assert.ok(Math.abs(way.length / hit.distance - 1) < 0.02, `${way.length} and ${hit.distance}`);
  assert.equal(way.way.length, 3 * way.points);
  assert.ok(Number.isFinite(distance[vertex]));
});

test('failures are the sentences and the codes of the tool', () => {
  const bad = (name, text) => [{ name, bytes: new TextEncoder().encode(text) }];
  for (const [name, text, code, words] of [
    ['bad.obj', 'v 0 0 0\nv 1 0 0\nf 1 2 3\n', 3, /bad\.obj:3/],
    ['empty.ply', '', 3, /empty\.ply/],
    ['picture.xyzw', 'hm', 3, /picture\.xyzw/],
  ]) {
    let caught = null;
    try {
      engine.open(bad(name, text));
    } catch (error) {
      caught = error;
    }
    assert.ok(caught, name);
    assert.match(caught.message, words);
    assert.equal(caught.code, code, caught.message);
  }
  assert.ok(tool.length > 0);
});
