// The worker, seen from the page.
const inFileSystem = location.protocol === 'file:';

// Scripts that hold binary files as text: pages opened from a disk cannot fetch.
function script(name) {
  return new Promise((done, failed) => {
    const element = document.createElement('script');
    element.src = name;
    element.onload = done;
    element.onerror = () => failed(new Error(`${name} is missing beside the page`));
    document.head.append(element);
  });
}

function decoded(text) {
  const bytes = atob(text);
  return Uint8Array.from(bytes, (c) => c.charCodeAt(0));
}

// A file that lies beside the page.
export async function beside(name) {
  if (inFileSystem) {
    if (!self.plexwayFiles) await script('files.js');
    return decoded(self.plexwayFiles[name]);
  }
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name} is missing on the server (${answer.status})`);
  return new Uint8Array(await answer.arrayBuffer());
}

export class Solver {
  #worker;
  #waiting = new Map();
  #next = 0;

  static async start(workerText) {
    const solver = new Solver();
    const url = URL.createObjectURL(new Blob([workerText], { type: 'text/javascript' }));
    solver.#worker = new Worker(url);
    solver.#worker.onmessage = ({ data }) => {
      const { done, failed } = solver.#waiting.get(data.id);
      solver.#waiting.delete(data.id);
      if (data.error === undefined) done(data.answer);
      else failed(Object.assign(new Error(data.error), { code: data.code }));
    };
    solver.#worker.onerror = (event) => {
      for (const { failed } of solver.#waiting.values())
        failed(new Error(event.message || 'the solver stopped: reload the page'));
      solver.#waiting.clear();
    };
    const wasm = await beside('plexway.wasm');
    const { version } = await solver.call('load', { wasm }, [wasm.buffer]);
    solver.version = version;
    return solver;
  }

  call(call, values, transfer = []) {
    const id = this.#next++;
    return new Promise((done, failed) => {
      this.#waiting.set(id, { done, failed });
      this.#worker.postMessage({ id, call, values }, transfer);
    });
  }
}

// Runs one task at a time and of those that wait only the last.
export class Latest {
  #running = false;
  #next = null;

  run(task) {
    if (this.#running) {
      this.#next = task;
      return;
    }
    this.#running = true;
    task().finally(() => {
      this.#running = false;
      const next = this.#next;
      this.#next = null;
      if (next) this.run(next);
    });
  }
}
