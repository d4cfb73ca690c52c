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
