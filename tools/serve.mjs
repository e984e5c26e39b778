/** Serves the page at `/` and the package at `/pkg/`, with the strict policy that it has to live with. */
import { open } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, relative, sep } from 'node:path';
import { pipeline } from 'node:stream/promises';
import { pkg, www } from './util/paths.mjs';

const strict = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "img-src 'self' blob: data:",
  "style-src 'self'",
].join('; ');

/** @type {Record<string, string>} */
const types = {
  '.css': 'text/css; charset=utf-8',
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.json': 'application/json',
  '.mjs': 'text/javascript; charset=utf-8',
  '.png': 'image/png',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/**
 * @typedef {import('node:http').IncomingMessage} Request
 * @typedef {import('node:http').ServerResponse} Response
 * @typedef {{ url: string, close: () => Promise<void> }} Server
 * @typedef {object} Site
 * @property {Record<string, string>} folders what is served: from a path that ends in `/` to a folder on the disk
 * @property {string} policy the content security policy of every answer
 * @property {Record<string, string>} headers further headers of every answer
 */

/**
 * @param {Partial<Site> & { port?: number, host?: string }} [options] port 0 is any free one
 * @returns {Promise<Server>}
 */
export async function serve({
  port = 0, host = '127.0.0.1', folders = { '/': www, '/pkg/': pkg }, policy = strict, headers = {},
} = {}) {
  const server = createServer(async (request, response) => {
    try {
      await answer(request, response, { folders, policy, headers });
    } catch {
      // The client has gone, or the file became unreadable while it was sent.
      if (response.headersSent) response.destroy();
      else refuse(response, 500, 'Internal server error');
    }
  });
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
 * Sends a whole file: ranges are not offered, and a request for one may be answered with all of it.
 * @param {Request} request
 * @param {Response} response
 * @param {Site} site
 */
async function answer({ method, url = '' }, response, { folders, policy, headers }) {
  for (const [name, value] of Object.entries(headers)) response.setHeader(name, value);
  response.setHeader('Content-Security-Policy', policy);
  response.setHeader('Cache-Control', 'no-store');
  response.setHeader('X-Content-Type-Options', 'nosniff');
  if (method !== 'GET' && method !== 'HEAD') {
    response.setHeader('Allow', 'GET, HEAD');
    return refuse(response, 405, 'Method not allowed');
  }
  const path = pathOf(url);
  if (path === undefined) return refuse(response, 400, 'Bad request');
  const place = placeOf(path, folders);
  const file = place && (await open(place).catch(() => undefined));
  if (!file) return refuse(response, 404, 'Not found');
  try {
    const stats = await file.stat();
    if (!stats.isFile()) return refuse(response, 404, 'Not found');
    response.writeHead(200, {
      'Content-Type': types[extname(place).toLowerCase()] ?? 'application/octet-stream',
      'Content-Length': stats.size,
      'Last-Modified': stats.mtime.toUTCString(),
    });
    if (method === 'HEAD' || stats.size === 0) return response.end();
    // Never more than was announced, should the file grow meanwhile.
    await pipeline(file.createReadStream({ end: stats.size - 1, autoClose: false }), response);
  } finally {
    await file.close();
  }
}

/**
 * The path that is asked for, without its escapes; nothing if it is malformed.
 * @param {string} url
 */
function pathOf(url) {
  try {
    const path = decodeURIComponent(url.startsWith('/') ? url.replace(/[?#].*$/s, '') : new URL(url).pathname);
    return path.includes('\0') ? undefined : path;
  } catch {
    return undefined;
  }
}

/**
 * The file's place on the disk, in the folder with the longest path that fits; nothing outside of it.
 * @param {string} path
 * @param {Site['folders']} folders
 */
function placeOf(path, folders) {
  const prefix = Object.keys(folders).filter((one) => path.startsWith(one)).sort((a, b) => b.length - a.length)[0];
  if (prefix === undefined) return undefined;
  const folder = folders[prefix];
  const place = join(folder, path.slice(prefix.length), path.endsWith('/') ? 'index.html' : '');
  const inside = relative(folder, place);
  return inside === '' || inside.split(sep)[0] === '..' ? undefined : place;
}

/**
 * @param {Response} response
 * @param {number} status
 * @param {string} message
 */
function refuse(response, status, message) {
  response.writeHead(status, { 'Content-Type': 'text/plain' }).end(`${message}\n`);
}
