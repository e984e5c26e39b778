/** Folders served to a browser, each trial with the strictest content security policy that it lives with. */
import { spawn } from 'node:child_process';
import { readFile, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { chromium } from 'playwright-core';
import { Problem } from '../util/problem.mjs';

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

/** The same for a page with a script in it. */
export const withInline = strict.map((part) => part.replace("'wasm", "'unsafe-inline' 'wasm"));

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

/**
 * Opens a page and waits for what its app has found. Whatever else goes wrong there is a failure, too.
 * @param {string} executablePath
 * @param {string} url
 * @param {RegExp[]} expected
 */
export async function browse(executablePath, url, expected) {
  const args = ['--headless', '--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-background-networking'];
  const browser = await chromium.launch({ executablePath, args });
  try {
    const page = await browser.newPage();
    /** @type {string[]} */
    const incidents = [];
    page.on('pageerror', (error) => incidents.push(String(error)));
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type())) incidents.push(message.text());
    });
    await page.goto(url);
    await page.waitForFunction('globalThis.outcome !== undefined', null, { timeout: 20_000 }).catch(() => {});
    const late = 'new Promise((_, reject) => setTimeout(reject, 60000, new Error("no answer after a minute")))';
    const outcome = await page.evaluate(`Promise.race([globalThis.outcome, ${late}])`).catch((error) => error);
    const others = incidents.filter((text) => !expected.some((pattern) => pattern.test(text)));
    if (outcome instanceof Error) throw new Problem([outcome.message, ...others].join('\n'));
    if (others.length > 0) throw new Problem(`the page complains: ${others.join('\n')}`);
    return outcome;
  } finally {
    await browser.close();
  }
}

/**
 * Runs a tool's own server as long as something is done with it.
 * @template T
 * @param {string} command
 * @param {string[]} args
 * @param {string} cwd
 * @param {(url: string) => Promise<T>} use
 */
export async function served(command, args, cwd, use) {
  const child = spawn(command, args, { cwd, stdio: ['ignore', 'pipe', 'pipe'], env: { ...process.env, NO_COLOR: '1' } });
  try {
    let output = '';
    /** @type {string} */
    const url = await new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Problem(`the server is silent: ${output}`)), 60_000);
      child.on('exit', () => reject(new Problem(`the server has ended: ${output}`)));
      for (const stream of [child.stdout, child.stderr]) {
        stream.on('data', (data) => {
          output += data;
          const found = /http:\/\/(localhost|127\.0\.0\.1):\d+\/?/.exec(output);
          if (!found) return;
          clearTimeout(timer);
          resolve(found[0]);
        });
      }
    });
    return await use(url);
  } finally {
    child.kill();
  }
}
