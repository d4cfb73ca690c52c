// Where things are: .ci/web says so by the environment.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const of = (name, otherwise) => resolve(process.env[name] ?? join(root, otherwise));
export const page = of('PLEXWAY_PAGE', 'build/web/page');
export const moduleFolder = of('PLEXWAY_WEB_MODULE', 'build/web/module');
export const tool = of('PLEXWAY_TOOL', 'build/bin/plexway');
export const data = join(root, 'data');
export const scratch = mkdtempSync(join(tmpdir(), 'plexway-page-'));

export const chromium = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
// Drawn in software where there is no other way; root needs the second.
export const chromiumArguments = ['--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist', '--no-sandbox'];

// What the tool writes for the same question.
export function byTool(file, options, extension = 'npy') {
  const out = join(scratch, `tool.${extension}`);
  execFileSync(tool, ['distance', file, ...options, '--out', out], { stdio: 'pipe' });
  return readFileSync(out);
}

// A file of data/ in another format, by the tool.
export function converted(file, extension) {
  const out = join(scratch, `converted.${extension}`);
  execFileSync(tool, ['convert', file, out], { stdio: 'pipe' });
  return out;
}

// A torus of about so many vertices, as a binary .ply.
export function torus(vertices) {
  const m = Math.round(Math.sqrt(vertices / 2)), n = Math.round(vertices / m);
  const points = new Float32Array(3 * n * m), faces = Buffer.alloc(13 * 2 * n * m);
  let at = 0;
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < m; ++j) {
      const u = (2 * Math.PI * (i + 0.3 * Math.sin(7 * j))) / n, v = (2 * Math.PI * j) / m;
      points.set([(3 + Math.cos(v)) * Math.cos(u), (3 + Math.cos(v)) * Math.sin(u), Math.sin(v)], 3 * (i * m + j));
      const [i1, j1] = [(i + 1) % n, (j + 1) % m];
      for (const face of [[i * m + j, i1 * m + j, i1 * m + j1], [i * m + j, i1 * m + j1, i * m + j1]]) {
        at = faces.writeUInt8(3, at);
        for (const corner of face) at = faces.writeUInt32LE(corner, at);
      }
    }
  const header = `ply\nformat binary_little_endian 1.0\nelement vertex ${n * m}\nproperty float x\n` +
    'property float y\nproperty float z\n' +
    `element face ${2 * n * m}\nproperty list uchar uint vertex_indices\nend_header\n`;
  return Buffer.concat([Buffer.from(header), Buffer.from(points.buffer), faces]);
}

// Milliseconds of a solve by the tool, the median of many.
export function solveMsByTool(file, accuracy = 'fast') {
  const told = JSON.parse(execFileSync(tool,
    ['bench', file, '--source', 'vertex:0', '--accuracy', accuracy, '--repeats', '31', '--json'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
  return (told.ns_per_vertex * told.vertices) / 1e6;
}

// An .npy of one axis, or what is in its header.
export function numbers(npy) {
  const length = npy[6] === 1 ? npy.readUInt16LE(8) : npy.readUInt32LE(8);
  const begin = (npy[6] === 1 ? 10 : 12) + length;
  const header = npy.subarray(10, begin).toString('latin1');
  const type = /'descr': '<(f[48])'/.exec(header)?.[1];
  const bytes = npy.subarray(begin);
  const copy = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  return type === 'f4' ? new Float32Array(copy) : new Float64Array(copy);
}
