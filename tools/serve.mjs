/** Serves the page at `/` and the package at `/pkg/`, with the strict policy that it has to live with. */
import { existsSync } from 'node:fs';
import { STATUS_CODES, createServer } from 'node:http';
import { extname, join } from 'node:path';
import send from 'send';
import { pkg, www } from './util/paths.mjs';

const strict = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "img-src 'self' blob: data:",
  "style-src 'self'",
].join('; ');

/**
 * Headers by which browsers isolate a page from others, so that its memory may be shared with its workers. Every file of the
 * page needs them, the worker's script too.
 */
export const isolation = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

/** Media types of the files that may lie compressed beside themselves. @type {Record<string, string>} */
const MEDIA_TYPES = {
  '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.css': 'text/css; charset=utf-8', '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml', '.webmanifest': 'application/manifest+json',
};

/** Encodings by the ends of such files' names, the shortest first. */
const ENCODINGS = /** @type {const} */ ([['br', '.br'], ['gzip', '.gz']]);

/**
 * @typedef {import('node:http').IncomingMessage} Request
 * @typedef {import('node:http').ServerResponse} Response
 * @typedef {{ url: string, close: () => Promise<void> }} Server
 * @typedef {object} Site
 * @property {Record<string, string>} folders what is served: from a path that ends in `/` to a folder on the disk
 * @property {string} policy the content security policy of every answer
 * @property {Record<string, string>} headers further headers of every answer, or other values of those it has anyway
 */

/**
 * @param {Partial<Site> & { port?: number, host?: string }} [options] port 0 is any free one
 * @returns {Promise<Server>}
 */
export async function serve({
  port = 0, host = '127.0.0.1', folders = { '/': www, '/pkg/': pkg }, policy = strict, headers = {},
} = {}) {
  const server = createServer((request, response) => answer(request, response, { folders, policy, headers }));
  server.on('clientError', (_, socket) => {
    if (socket.writable) socket.end('HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n');
    else socket.destroy();
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

/**
 * @param {Request} request
 * @param {Response} response
 * @param {Site} site
 */
function answer({ method, url = '', headers: asked }, response, { folders, policy, headers }) {
  const path = url.replace(/[?#].*$/s, '');
  response.setHeader('Content-Security-Policy', policy);
  // The names of a bundle's files change with what is in them.
  response.setHeader('Cache-Control', /\/assets\//.test(path) ? 'public, max-age=31536000, immutable' : 'no-store');
  response.setHeader('X-Content-Type-Options', 'nosniff');
  for (const [name, value] of Object.entries(headers)) response.setHeader(name, value);
  if (method !== 'GET' && method !== 'HEAD') {
    response.setHeader('Allow', 'GET, HEAD');
    return refuse(response, 405);
  }
  // The folder with the longest path that fits.
  const prefix = Object.keys(folders).filter((one) => path.startsWith(one)).sort((a, b) => b.length - a.length)[0];
  if (prefix === undefined) return refuse(response, 400);
  const name = `/${path.slice(prefix.length) || 'index.html'}`;
  const end = compressedEnd(join(folders[prefix], name), response, String(asked['accept-encoding'] ?? ''));
  send(/** @type {Request} */ ({ method, headers: asked }), name + end, { root: folders[prefix], cacheControl: false })
    .on('error', ({ status }) => (response.headersSent ? response.destroy() : refuse(response, status ?? 500)))
    .on('directory', () => refuse(response, 404))
    .pipe(response);
}

/**
 * How the name of a compressed copy goes on that the browser takes, for which the headers are set; nothing without one.
 * @param {string} file
 * @param {Response} response
 * @param {string} accepted the encodings that the browser takes
 */
function compressedEnd(file, response, accepted) {
  const type = MEDIA_TYPES[extname(file)];
  const found = type && ENCODINGS.find(([encoding, end]) => new RegExp(`\\b${encoding}\\b`).test(accepted) && existsSync(file + end));
  if (!found) return '';
  response.setHeader('Content-Type', type);
  response.setHeader('Content-Encoding', found[0]);
  response.setHeader('Vary', 'Accept-Encoding');
  return found[1];
}

/**
 * @param {Response} response
 * @param {number} status
 */
function refuse(response, status) {
  // These headers were set for the file.
  response.removeHeader('Content-Encoding');
  response.writeHead(status, { 'Content-Type': 'text/plain', 'Cache-Control': 'no-store' }).end(`${STATUS_CODES[status]}\n`);
}
