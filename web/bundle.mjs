// bundle.mjs MODULE_FOLDER SAMPLES_FOLDER OUT: the page as one folder that any server, or a disk,
// serves.
import { build } from 'esbuild';
import { cp, mkdir, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [moduleFolder, samplesFolder, out] = process.argv.slice(2).map((name) => resolve(name));
const page = join(dirname(fileURLToPath(import.meta.url)), 'page');
await rm(out, { recursive: true, force: true });
await mkdir(join(out, 'samples'), { recursive: true });

const common = { bundle: true, minify: true, format: 'iife', target: 'es2022', legalComments: 'eof', logLevel: 'warning' };
const worker = await build({
  ...common, entryPoints: [join(page, 'worker.js')], write: false,
  alias: { 'plexway-module': join(moduleFolder, 'plexway.cjs') },
  external: ['fs', 'path', 'crypto', 'worker_threads', 'perf_hooks'],
});
const workerText = {
  name: 'worker-text',
  setup(build) {
    build.onResolve({ filter: /^worker-text$/ }, () => ({ path: 'worker-text', namespace: 'text' }));
    build.onLoad({ filter: /.*/, namespace: 'text' },
      () => ({ contents: worker.outputFiles[0].text, loader: 'text' }));
  },
};
await build({ ...common, entryPoints: [join(page, 'app.js')], outfile: join(out, 'app.js'), plugins: [workerText] });

for (const name of ['index.html', 'style.css', 'offline.js']) await cp(join(page, name), join(out, name));
await cp(join(moduleFolder, 'plexway.wasm'), join(out, 'plexway.wasm'));
for (const name of await readdir(samplesFolder)) await cp(join(samplesFolder, name), join(out, 'samples', name));

// For pages opened from a disk, where nothing can be fetched.
const files = {};
for (const name of ['plexway.wasm', ...(await readdir(samplesFolder)).map((sample) => `samples/${sample}`)])
  files[name] = (await readFile(join(out, name))).toString('base64');
await writeFile(join(out, 'files.js'), `self.plexwayFiles=${JSON.stringify(files)};`);
