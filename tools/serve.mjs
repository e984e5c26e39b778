/** Serves the page at `/` and the package at `/pkg/`, with the strict policy that it has to live with. */
import { createServer } from 'node:http';
import sirv from 'sirv';
import { pkg, www } from './util/paths.mjs';

const policy = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "img-src 'self' blob: data:",
  "style-src 'self'",
].join('; ');

/** @typedef {{ url: string, close: () => Promise<void> }} Server */

/**
 * @param {object} [options]
 * @param {number} [options.port] 0 is any free one
 * @param {string} [options.host]
 * @returns {Promise<Server>}
 */
export async function serve({ port = 0, host = '127.0.0.1' } = {}) {
  // `dev`: files are looked up anew on each request.
  const page = sirv(www, { dev: true, setHeaders });
  const library = sirv(pkg, { dev: true, setHeaders });
  const server = createServer((request, response) => {
    const inPackage = /^\/pkg(?=\/)/;
    const missing = () => {
      setHeaders(response);
      response.writeHead(404, { 'Content-Type': 'text/plain' }).end('Not found\n');
    };
    if (!inPackage.test(request.url ?? '')) return page(request, response, missing);
    request.url = request.url?.replace(inPackage, '');
    library(request, response, missing);
  });
  await new Promise((resolve, reject) => {
    server.once('error', reject);
    server.listen(port, host, () => resolve(undefined));
  });
  const address = server.address();
  const bound = typeof address === 'object' && address ? address.port : port;
  return {
    url: `http://${host}:${bound}/`,
    close: () => new Promise((resolve) => {
      server.close(() => resolve());
      server.closeAllConnections();
    }),
  };
}

/** @param {import('node:http').ServerResponse} response */
function setHeaders(response) {
  response.setHeader('Content-Security-Policy', policy);
  response.setHeader('Cache-Control', 'no-store');
  response.setHeader('X-Content-Type-Options', 'nosniff');
}
