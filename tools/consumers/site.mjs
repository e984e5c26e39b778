/** Folders served to a browser, each trial with the strictest content security policy that it lives with. */
import { readFile, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const types = new Map([
  ['.html', 'text/html; charset=utf-8'],
  ['.js', 'text/javascript'],
  ['.mjs', 'text/javascript'],
  ['.wasm', 'application/wasm'],
]);

/** What the package promises to live with. */
export const strict = [
  "default-src 'none'", "script-src 'self' 'wasm-unsafe-eval'", "connect-src 'self'", "worker-src 'self'", 'img-src data:',
];

/** The same for a bundle that carries the worker as a copy. */
export const withBlobs = [...strict.filter((part) => !part.startsWith('worker-src')), "worker-src 'self' blob:"];

/**
 * @param {string} folder
 * @param {{ policy?: string[], shared?: boolean }} [options] `shared`: for pages of other origins, too
 * @returns {Promise<{ url: string, close: () => Promise<void> }>}
 */
export async function site(folder, { policy, shared = false } = {}) {
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url ?? '/', 'http://localhost');
    const path = join(folder, normalize(decodeURIComponent(pathname)));
    const file = await stat(path).then((found) => (found.isDirectory() ? join(path, 'index.html') : path), () => path);
    const body = await readFile(file).catch(() => undefined);
    if (policy) response.setHeader('Content-Security-Policy', policy.join('; '));
    if (shared) response.setHeader('Access-Control-Allow-Origin', '*');
    response.writeHead(body ? 200 : 404, { 'Content-Type': types.get(extname(file)) ?? 'text/plain' }).end(body);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(undefined)));
  const address = server.address();
  if (!address || typeof address !== 'object') throw new Error('the server has no address');
  return {
    url: `http://127.0.0.1:${address.port}/`,
    close: () => new Promise((resolve) => {
      server.close(() => resolve());
      server.closeAllConnections();
    }),
  };
}
