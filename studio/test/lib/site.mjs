// The built page behind a tiny server of static files, below a path as on any web host.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

export const dist = fileURLToPath(new URL('../../dist', import.meta.url));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.mjs': 'text/javascript' };
export const below = '/some/path/';

// Returns { address, server, close }. A request to `fails` (a part of a path) is answered with 404.
export async function serveSite({ port = 0, fails = null } = {}) {
  if (!existsSync(join(dist, 'index.html'))) throw new Error('There is no built page: run npm run build first.');
  const server = createServer((request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname;
    if (!path.startsWith(below) || (fails && path.includes(fails))) return void response.writeHead(404).end();
    const inside = normalize(path.slice(below.length) || 'index.html');
    const file = join(dist, inside);
    if (inside.startsWith('..') || !existsSync(file) || !statSync(file).isFile()) return void response.writeHead(404).end();
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    createReadStream(file).pipe(response);
  });
  await new Promise((listening) => server.listen(port, '127.0.0.1', listening));
  return {
    server,
    address: `http://127.0.0.1:${server.address().port}${below}`,
    close: () =>
      new Promise((closed) => {
        server.closeAllConnections();
        server.close(closed);
      }),
  };
}
