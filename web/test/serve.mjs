// A server of one folder, as simple as a page's host may be.
import { createReadStream } from 'node:fs';
import { stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

export async function serve(folder) {
  const server = createServer(async (request, answer) => {
    const name = normalize(decodeURIComponent(new URL(request.url, 'http://page').pathname));
    const file = join(folder, name === '/' ? 'index.html' : name);
    const found = await stat(file).catch(() => null);
    if (!found?.isFile() || name.includes('..')) {
      answer.writeHead(404).end();
      return;
    }
    answer.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    createReadStream(file).pipe(answer);
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}
