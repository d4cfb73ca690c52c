// measure.mjs MESH...: milliseconds of a solve in the module beside the tool's, at a median of 30
// sources, for each accuracy. After .ci/web build; run it while nothing else runs.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, join } from 'node:path';
import { build } from 'esbuild';
import { moduleFolder, scratch, solveMsByTool } from './test/setup.mjs';

const bundled = join(scratch, 'engine.cjs');
await build({
  entryPoints: [join(import.meta.dirname ?? new URL('.', import.meta.url).pathname, 'page/engine.js')],
  bundle: true, format: 'cjs', platform: 'node', outfile: bundled, logLevel: 'error',
  alias: { 'plexway-module': join(moduleFolder, 'plexway.cjs') },
});
const { loadEngine } = createRequire(import.meta.url)(bundled);
const engine = await loadEngine(readFileSync(join(moduleFolder, 'plexway.wasm')));

console.log('mesh, vertices, accuracy, module ms, tool ms, ratio');
for (const file of process.argv.slice(2)) {
  const told = engine.open([{ name: basename(file), bytes: readFileSync(file) }]);
  for (const accuracy of ['fast', 'accurate', 'exact']) {
    const times = [];
    for (let k = 0; k < (accuracy === 'exact' ? 10 : 30); ++k) {
      engine.setSource(0, Math.floor((k * told.vertices) / 30));
      const start = performance.now();
      engine.solve(accuracy);
      times.push(performance.now() - start);
    }
    const ours = times.sort((a, b) => a - b)[times.length >> 1];
    const native = solveMsByTool(file, accuracy);
    console.log([basename(file), told.vertices, accuracy, ours.toFixed(2), native.toFixed(2),
      (ours / native).toFixed(2)].join(', '));
  }
}
