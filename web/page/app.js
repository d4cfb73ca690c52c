// The page: what people press and drag, and what they read.
import workerText from 'worker-text';
import { cells, gradient, mapNames, roundStep, shortNumber } from './colours.js';
import { Latest, Solver, beside } from './solver.js';
import { View } from './view.js';

const samples = [
  { name: 'Spot, a surface', files: ['spot.obj'] },
  { name: 'Knot, a surface', files: ['knot.ply'] },
  { name: 'Elbow, a solid', files: ['elbow.mesh'] },
  { name: 'Moving obstacle: a room over time', files: ['moving.mesh'] },
  { name: 'Vessels, a wireframe', files: ['vessels.obj'] },
  { name: 'Roll, a point cloud', files: ['roll.xyz'] },
];
// What a browser can hold beside the picture.
const largestFile = 400 * 2 ** 20;
// By windows on surfaces and clouds; other domains have one way each.
const accuracies = [['fast', 'fast, about 1e-3'], ['accurate', 'accurate, 1e-4'], ['exact', 'exact']];

const at = (id) => document.getElementById(id);
const settings = new URLSearchParams(location.hash.slice(1));
const state = {
  domain: null, file: '', sources: [], target: null, distance: null, label: null, farthest: 0,
  difference: null, worst: 0, dragging: -1, stopPlay: null,
};
// What tests measure.
const timings = { moves: [], firstPicture: 0, solves: [] };
self.plexwayPage = { state, timings, openFiles };

const view = new View(at('canvas'));
self.plexwayPage.view = view;
let solver = null;
const pointer = new Latest();

function fail(error) {
  at('error').textContent = error.message;
  at('error').hidden = false;
}
function calm() {
  at('error').hidden = true;
}
async function busy(task) {
  const shown = setTimeout(() => (at('busy').hidden = false), 150);
  try {
    return await task();
  } finally {
    clearTimeout(shown);
    at('busy').hidden = true;
  }
}

const accuracy = () => (at('accuracy').disabled ? 'usual' : at('accuracy').value);
const mode = () => document.querySelector('input[name=mode]:checked').value;
const milliseconds = (ms) => (ms < 10 ? ms.toFixed(1) : Math.round(ms)) + ' ms';

// ---- what is shown ----

function isolineStep(top) {
  const lines = Number(at('lines').value);
  return lines === 0 || !(top > 0) ? 0 : roundStep(top, lines);
}

function paint() {
  if (!state.distance) return;
  const show = at('show').value;
  const asDifference = show === 'difference' && state.difference;
  const top = asDifference ? state.worst : state.farthest;
  const step = asDifference ? 0 : isolineStep(top);
  view.setLook({ map: at('map').value, step, byLabel: show === 'cells' });
  view.setValues(asDifference ? state.difference : state.distance, state.label, top);
  at('bar').style.background = show === 'cells'
    ? `linear-gradient(to right, ${cells.slice(0, Math.max(state.sources.length, 1)).map((c, i, all) =>
      `${c} ${(100 * i) / all.length}% ${(100 * (i + 1)) / all.length}%`).join(', ')})`
    : gradient(at('map').value);
  const told = asDifference ? (x) => (100 * x).toFixed(1) + ' %' : shortNumber;
  at('ticks').replaceChildren(...[0, 0.5, 1].map((share) => {
    const tick = document.createElement('span');
    tick.textContent = show === 'cells' ? (share === 0 ? 'nearest source' : '') : told(share * top);
    return tick;
  }));
}

function placeMarkers() {
  const markers = state.sources.map((source, i) => ({
    at: source.at, colour: at('show').value === 'cells' ? cells[i % cells.length] : '#ff4d6d' }));
  if (state.target) markers.push({ at: state.target.at, colour: '#4dabf7' });
  view.setMarkers(markers);
}

function tellCommands() {
  const sources = state.sources.map((source) => source.argument);
  const name = state.file;
  at('command').value = `plexway distance ${name} ` +
    sources.map((s) => `--source ${s}`).join(' ') +
    (accuracy() === 'usual' ? '' : ` --accuracy ${accuracy()}`) + ' --out distance.vtu';
  const python = sources.map((s) => s.startsWith('vertex:')
    ? s.slice(7) : `domain.closest([${s.slice(6).replaceAll(',', ', ')}])`);
  at('python').value = `import plexway\ndomain = plexway.read("${name}")\n` +
    `distance = domain.distance(${python.length === 1 ? python[0] : `[${python.join(', ')}]`}` +
    (accuracy() === 'usual' ? ')' : `, accuracy="${accuracy()}")`);
  const query = new URLSearchParams();
  const sample = at('sample').value;
  if (sample !== '') query.set('sample', sample);
  for (const source of state.sources) query.append('source', source.vertex);
  query.set('accuracy', accuracy());
  query.set('map', at('map').value);
  query.set('lines', at('lines').value);
  history.replaceState(null, '', '#' + query);
}

function solved(answer) {
  state.distance = answer.distance;
  state.label = answer.label;
  state.farthest = answer.farthest;
  timings.solves.push(answer.solveMs);
  at('farthest').textContent = shortNumber(answer.farthest) +
    (answer.unreached > 0 ? `, ${answer.unreached} unreached` : '');
  at('solve').textContent = milliseconds(answer.solveMs);
  tellNotes([...state.domain.notes, ...answer.notes]);
}

// What to know of the distances though nothing failed.
function tellNotes(notes) {
  at('notes').hidden = notes.length === 0;
  at('notes').replaceChildren(...notes.map((note) => {
    const line = document.createElement('li');
    line.textContent = note;
    return line;
  }));
}

async function afterSolve() {
  paint();
  placeMarkers();
  tellCommands();
  await Promise.all([compare(), cut(), path()]);
}

async function compare() {
  const wanted = at('show').value === 'difference';
  at('against').hidden = at('againstName').hidden = !wanted;
  state.difference = null;
  if (!wanted || !state.distance) return;
  const told = await solver.call('compare');
  state.difference = told.difference;
  state.worst = told.worst;
  at('against').textContent =
    `${(100 * told.mean).toFixed(1)} % (worst ${(100 * told.worst).toFixed(1)} %), ${milliseconds(told.solveMs)}`;
  paint();
}

async function path() {
  if (!state.target) return;
  const told = await solver.call('path', { ray: state.target.ray, accuracy: accuracy() });
  if (!told.hit) return;
  view.setPath(told.way);
  at('length').textContent = `${shortNumber(told.length)}, ${milliseconds(told.pathMs)}`;
}

async function cut() {
  if (at('cutting').hidden || !at('cut').checked) {
    view.setSection(null);
    return;
  }
  const normal = [0, 0, 0], axis = 'xyz'.indexOf(at('axis').value);
  normal[axis] = 1;
  const [low, high] = state.domain.span[axis];
  const offset = low + ((Number(at('where').value) + 0.37) / 1001) * (high - low);
  const told = await solver.call('cut', { normal, offset });
  view.setSection(told.section ?? new Float32Array(), normal, offset);
}

// ---- what is opened ----

function spans(positions) {
  const span = [[Infinity, -Infinity], [Infinity, -Infinity], [Infinity, -Infinity]];
  for (let k = 0; k < positions.length; ++k) {
    const s = span[k % 3];
    s[0] = Math.min(s[0], positions[k]);
    s[1] = Math.max(s[1], positions[k]);
  }
  return span;
}

async function open(files, sampleIndex = '') {
  const start = performance.now();
  stopPlaying();
  await busy(async () => {
    const domain = await solver.call('open', { files, as: at('as').value },
      files.map((file) => file.bytes.buffer));
    state.opened = { sampleIndex, list: state.choosing };
    domain.span = spans(domain.positions);
    Object.assign(state, { domain, file: files[0].name, sources: [], target: null, distance: null,
      label: null, difference: null });
    at('sample').value = sampleIndex;
    at('accuracy').disabled = !['surface', 'cloud'].includes(domain.kind);
    at('cutting').hidden = !['solid', 'mixed'].includes(domain.kind);
    at('cut').checked = domain.kind === 'solid';
    at('length').textContent = at('pointer').textContent = '–';
    at('domain').textContent = `${domain.kind}, ${domain.vertices.toLocaleString('en')} vertices, ` +
      `${domain.simplices.toLocaleString('en')} ${domain.simplexName}`;
    at('build').textContent = `${milliseconds(domain.loadMs)}, ${milliseconds(domain.buildMs)}`;
    view.show(domain);
    calm();
    const named = settings.getAll('source').map(Number).filter((v) => v >= 0 && v < domain.vertices);
    settings.delete('source');
    for (const [index, vertex] of (named.length > 0 ? named : [0]).entries())
      await moveSource(index, { vertex });
  });
  timings.open = performance.now() - start;
}

async function openSample(index) {
  calm();
  try {
    const names = samples[index].files;
    const files = await Promise.all(names.map(async (name) => ({ name, bytes: await beside(`samples/${name}`) })));
    await open(files, String(index));
  } catch (error) {
    fail(error);
  }
}

async function openFiles(list) {
  calm();
  try {
    const chosen = [...list];
    if (chosen.length === 0) return;
    state.choosing = chosen;
    const total = chosen.reduce((sum, file) => sum + file.size, 0);
    if (total > largestFile)
      throw new Error(`${chosen[0].name}: ${Math.round(total / 2 ** 20)} MB are more than the ` +
        `${largestFile / 2 ** 20} MB that this page takes: use the command-line tool`);
    await open(await Promise.all(chosen.map(async (file) =>
      ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) }))));
  } catch (error) {
    fail(error);
  }
}

// ---- sources ----

async function moveSource(index, { ray, vertex }, began = performance.now()) {
  const answer = await solver.call('move', { ray, vertex, index, accuracy: accuracy() });
  if (!answer.hit) return false;
  state.sources[index] = { at: answer.at, argument: answer.argument,
    vertex: vertex ?? answer.vertex ?? nearestVertex(answer.at) };
  solved(answer);
  await afterSolve();
  const ms = performance.now() - began;
  timings.moves.push(ms);
  at('latency').textContent = milliseconds(ms);
  return true;
}

function nearestVertex(place) {
  const p = state.domain.positions;
  let best = 0, least = Infinity;
  for (let v = 0; v < p.length / 3; ++v) {
    const d = (p[3 * v] - place[0]) ** 2 + (p[3 * v + 1] - place[1]) ** 2 + (p[3 * v + 2] - place[2]) ** 2;
    if (d < least) [least, best] = [d, v];
  }
  return best;
}

async function click(ray) {
  const what = mode();
  if (what === 'path') {
    const hit = await solver.call('pick', { ray });
    if (!hit.hit) return;
    state.target = { at: hit.at, ray };
    placeMarkers();
    await path();
  } else {
    await moveSource(what === 'add' ? state.sources.length : 0, { ray });
  }
}

function guarded(task) {
  pointer.run(async () => {
    try {
      await task();
      calm();
    } catch (error) {
      fail(error);
    }
  });
}

function listen() {
  const canvas = at('canvas');
  let down = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (!state.domain || event.button !== 0) return;
    const [x, y] = place(event);
    down = { x, y };
    const reach = event.pointerType === 'touch' ? 28 : 14;
    const grabbed = state.sources.findIndex((source) => {
      const [sx, sy] = view.onCanvas(source.at);
      return Math.hypot(sx - x, sy - y) < reach;
    });
    if (grabbed < 0) return;
    state.dragging = grabbed;
    view.controls.enabled = false;
    canvas.setPointerCapture(event.pointerId);
  }, { capture: true });
  canvas.addEventListener('pointermove', (event) => {
    if (!state.domain) return;
    const [x, y] = place(event);
    const ray = view.ray(x, y);
    if (state.dragging >= 0) {
      const index = state.dragging, began = performance.now();
      guarded(() => moveSource(index, { ray }, began));
    } else if (event.buttons === 0) {
      guarded(async () => {
        const hit = await solver.call('pick', { ray });
        at('pointer').textContent = hit.hit ? `${shortNumber(hit.distance)} (vertex ${hit.vertex})` : '–';
      });
    }
  });
  const release = (event) => {
    const [x, y] = place(event);
    const still = down && Math.hypot(x - down.x, y - down.y) < 5;
    const dragged = state.dragging >= 0;
    state.dragging = -1;
    view.controls.enabled = true;
    down = null;
    if (event.type === 'pointerup' && still && !(dragged && mode() === 'move')) {
      const ray = view.ray(x, y);
      guarded(() => click(ray));
    }
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);

  canvas.addEventListener('keydown', (event) => {
    const { width, height } = canvas.getBoundingClientRect();
    const middle = () => view.ray(width / 2, height / 2);
    const does = {
      ArrowLeft: () => view.turn(-0.15, 0), ArrowRight: () => view.turn(0.15, 0),
      ArrowUp: () => view.turn(0, -0.15), ArrowDown: () => view.turn(0, 0.15),
      '+': () => view.zoom(0.85), '=': () => view.zoom(0.85), '-': () => view.zoom(1 / 0.85),
      r: () => view.resetCamera(),
      s: () => { const ray = middle(); guarded(() => moveSource(0, { ray })); },
      p: () => {
        const ray = middle();
        guarded(async () => {
          const hit = await solver.call('pick', { ray });
          if (!hit.hit) return;
          state.target = { at: hit.at, ray };
          placeMarkers();
          await path();
        });
      },
    }[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!does || event.ctrlKey || event.metaKey || event.altKey || !state.domain) return;
    event.preventDefault();
    does();
  });

  at('sample').addEventListener('change', (event) => openSample(Number(event.target.value)));
  at('file').addEventListener('change', (event) => {
    openFiles(event.target.files).then(() => (event.target.value = ''));
  });
  at('as').addEventListener('change', () => {
    const { sampleIndex, list } = state.opened ?? {};
    if (sampleIndex) openSample(Number(sampleIndex));
    else if (list) openFiles(list);
  });
  at('accuracy').addEventListener('change', () => guarded(async () => {
    solved(await solver.call('solve', { accuracy: accuracy() }));
    await afterSolve();
  }));
  at('show').addEventListener('change', () => guarded(async () => {
    await compare();
    paint();
    placeMarkers();
  }));
  for (const id of ['map', 'lines'])
    at(id).addEventListener('input', () => {
      paint();
      tellCommands();
    });
  for (const id of ['cut', 'axis', 'where']) at(id).addEventListener('input', () => guarded(cut));
  at('clear').addEventListener('click', () => guarded(async () => {
    const [first] = state.sources;
    await solver.call('clear');
    state.sources = [];
    state.target = null;
    view.setPath(null);
    at('length').textContent = '–';
    await moveSource(0, { vertex: first.vertex });
  }));
  at('reset').addEventListener('click', () => view.resetCamera());
  at('play').addEventListener('click', () => (state.stopPlay ? stopPlaying() : play()));
  at('dark').addEventListener('change', look);
  for (const button of document.querySelectorAll('[data-save]'))
    button.addEventListener('click', () => save(button.dataset.save).catch(fail));
  at('link').addEventListener('click', async () => {
    await navigator.clipboard?.writeText(location.href).catch(() => {});
    at('link').textContent = 'Copied';
    setTimeout(() => (at('link').textContent = 'Link'), 1200);
  });

  const stage = at('stage');
  let inside = 0;
  document.addEventListener('dragenter', () => { ++inside; at('drop').hidden = false; });
  document.addEventListener('dragleave', () => { if (--inside <= 0) at('drop').hidden = true; });
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    inside = 0;
    at('drop').hidden = true;
    openFiles(event.dataTransfer.files);
  });
  stage.addEventListener('contextmenu', (event) => event.preventDefault());
}

function play() {
  at('cut').checked = true;
  at('play').textContent = 'Stop';
  let last = performance.now(), stopped = false;
  const frame = async (now) => {
    if (stopped) return;
    at('where').value = String((Number(at('where').value) + (now - last) * 0.25) % 1000);
    last = now;
    await cut().catch(fail);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  state.stopPlay = () => (stopped = true);
}
function stopPlaying() {
  state.stopPlay?.();
  state.stopPlay = null;
  at('play').textContent = 'Move it';
}

async function save(kind) {
  const stem = state.file.replace(/\.[^.]*$/, '');
  const name = `${stem}-distance.${kind}`;
  const blob = kind === 'png' ? await view.picture()
    : new Blob([(await solver.call('write', { name })).bytes], { type: 'application/octet-stream' });
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function look() {
  document.documentElement.dataset.look = at('dark').checked ? 'dark' : 'light';
  view.setBackground(getComputedStyle(document.documentElement).getPropertyValue('--back').trim());
  try {
    localStorage.setItem('plexway-look', document.documentElement.dataset.look);
  } catch { /* pages opened from a disk may not keep anything */ }
}

async function begin() {
  const option = (value, text) => Object.assign(document.createElement('option'), { value, textContent: text });
  at('sample').append(option('', 'your file'), ...samples.map((sample, i) => option(String(i), sample.name)));
  at('map').append(...mapNames.map((name) => option(name, name)));
  at('accuracy').append(...accuracies.map(([value, text]) => option(value, text)));
  for (const id of ['map', 'lines', 'accuracy'])
    if (settings.has(id)) at(id).value = settings.get(id);
  let kept = null;
  try {
    kept = localStorage.getItem('plexway-look');
  } catch { /* as above */ }
  at('dark').checked = kept ? kept === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  look();
  listen();
  try {
    solver = await busy(() => Solver.start(workerText));
    self.plexwayPage.solver = solver;
    at('version').textContent = `plexway ${solver.version}.`;
    const wanted = Number(settings.get('sample') ?? 0);
    await openSample(samples[wanted] ? wanted : 0);
    view.drawNow();
    timings.firstPicture = performance.now();
    if (location.protocol.startsWith('http')) navigator.serviceWorker?.register('offline.js').catch(() => {});
  } catch (error) {
    fail(error);
  }
}
begin();
