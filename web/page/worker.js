// Solves beside the page, so that it never stands still. Messages {id, call, values}; answers
// {id, answer} or {id, error, code}.
import { loadEngine } from './engine.js';

let engine = null;

const calls = {
  async load({ wasm }) {
    engine = await loadEngine(wasm);
    return { version: engine.version };
  },
  open: ({ files, as, twice }) => engine.open(files, as, twice),
  // One message for what a pointer's move asks: pick, move the source, solve.
  move({ ray, index, vertex, accuracy }) {
    const start = performance.now();
    if (ray) {
      const hit = engine.pick(ray);
      if (!hit.hit) return { hit: false };
    }
    const pickMs = performance.now() - start;
    const placed = engine.setSource(index, vertex ?? -1);
    const solved = engine.solve(accuracy);
    return { hit: true, pickMs, ...placed, ...solved, workerMs: performance.now() - start };
  },
  solve: ({ accuracy }) => engine.solve(accuracy),
  pick: ({ ray }) => engine.pick(ray),
  path({ ray, accuracy }) {
    const hit = engine.pick(ray);
    return hit.hit ? { ...hit, ...engine.path(accuracy) } : hit;
  },
  clear() {
    engine.clearSources();
    return {};
  },
  compare: () => engine.compare(),
  cut: ({ normal, offset }) => engine.cut(normal, offset),
  write: ({ name }) => ({ bytes: engine.write(name) }),
};

self.onmessage = async ({ data: { id, call, values } }) => {
  try {
    const answer = await calls[call](values ?? {});
    const moved = Object.values(answer).filter(ArrayBuffer.isView).map((view) => view.buffer);
    self.postMessage({ id, answer }, [...new Set(moved)]);
  } catch (error) {
    self.postMessage({ id, error: String(error.message ?? error), code: error.code ?? 1 });
  }
};
