// The module of WebAssembly as plain calls: answers are objects, failures are errors with the
// sentence and the exit code of the command-line tool.
import createPlexway from 'plexway-module';

export class PlexwayError extends Error {
  constructor(message, code) {
    super(message);
    this.code = code;
  }
}

export async function loadEngine(wasmBinary) {
  const module = await createPlexway({ wasmBinary, print() {}, printErr() {} });
  const call = (name, types, values) => {
    const code = module.ccall('plexway_' + name, 'number', types, values);
    const text = module.ccall('plexway_text', 'string', [], []);
    if (code !== 0) throw new PlexwayError(text, code);
    return JSON.parse(text);
  };
  // Copies: the module's memory moves when it grows.
  const copied = (heap, name, size) => {
    const at = module.ccall('plexway_' + name, 'number', [], []);
    return at === 0 ? null : heap().slice(at >> 2, (at >> 2) + size);
  };
  const floats = () => module.HEAPF32;
  const whole = () => module.HEAP32;
  let vertices = 0;

  const array = (which, heap) => {
    const at = module.ccall('plexway_array', 'number', ['number'], [which]);
    const size = module.ccall('plexway_array_size', 'number', ['number'], [which]);
    return heap().slice(at >> 2, (at >> 2) + size);
  };

  return {
    version: module.ccall('plexway_version', 'string', [], []),

    // `files`: the file itself first, then those that lie beside it, as {name, bytes}.
    open(files, as = '', twice = false) {
      for (const file of files) module.FS.writeFile('/' + file.name, file.bytes);
      try {
        const told = call('open', ['string', 'string', 'number'],
          ['/' + files[0].name, as, twice ? 1 : 0]);
        vertices = told.vertices;
        return {
          ...told,
          positions: array(0, floats),
          triangles: new Uint32Array(array(1, whole)),
          edges: new Uint32Array(array(2, whole)),
        };
      } catch (error) {
        if (error instanceof PlexwayError) error.message = error.message.replace(/^\//, '');
        throw error;
      } finally {
        for (const file of files) module.FS.unlink('/' + file.name);
      }
    },

    pick: ({ from, direction, slack }) =>
      call('pick', Array(7).fill('number'), [...from, ...direction, slack]),
    // Without a vertex: what was picked last.
    setSource: (index, vertex = -1) => call('set_source', ['number', 'number'], [index, vertex]),
    clearSources: () => module.ccall('plexway_clear_sources', null, [], []),
    solve(accuracy) {
      const told = call('solve', ['string'], [accuracy]);
      return {
        ...told,
        distance: copied(floats, 'distance', vertices),
        label: copied(whole, 'label', vertices),
      };
    },
    compare() {
      const told = call('compare', [], []);
      return { ...told, difference: copied(floats, 'difference', vertices) };
    },
    path(accuracy) {
      const told = call('path', ['string'], [accuracy]);
      return { ...told, way: copied(floats, 'way', 3 * told.points) };
    },
    cut(normal, offset) {
      const told = call('cut', Array(4).fill('number'), [...normal, offset]);
      return { ...told, section: copied(floats, 'section', 12 * told.triangles) };
    },
    // The bytes of a file that holds the field.
    write(name) {
      call('write', ['string'], ['/' + name]);
      const bytes = module.FS.readFile('/' + name);
      module.FS.unlink('/' + name);
      return bytes;
    },
  };
}
