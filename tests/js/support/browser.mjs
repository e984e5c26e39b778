/** Chromium, and folders served to it under the strict policy that the package promises to live with. */
import assert from 'node:assert/strict';
import { accessSync, constants } from 'node:fs';
import { createServer } from 'node:http';
import { chromium } from 'playwright-core';
import sirv from 'sirv';

const executablePath = process.env.DEVELOPABLE_CHROME || '/usr/bin/chromium';
const args = [
  '--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
];

/** Why the tests cannot run here; in CI that is a failure. */
export const skip = missing() && `no browser at ${executablePath}`;

function missing() {
  try {
    accessSync(executablePath, constants.X_OK);
    return false;
  } catch {
    assert.notEqual(process.env.CI, 'true', `there must be a browser in CI: ${executablePath}`);
    return true;
  }
}

export const launch = () => chromium.launch({ executablePath, args });

const policy =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; img-src data:";
/** @param {import('node:http').ServerResponse} response */
const setHeaders = (response) => void response.setHeader('Content-Security-Policy', policy);

/**
 * @param {Record<string, string>} folders from where in the site to what on the disk
 * @returns {Promise<{ url: string, close: () => Promise<void> }>}
 */
export async function serve(folders) {
  const places = Object.entries(folders).map(([prefix, folder]) => ({
    prefix,
    handle: sirv(folder, { dev: true, setHeaders }),
  }));
  const server = createServer((request, response) => {
    const place = places.find(({ prefix }) => request.url?.startsWith(prefix));
    request.url = request.url?.slice((place?.prefix.length ?? 1) - 1);
    const missing = () => void response.writeHead(404).end();
    if (place) place.handle(request, response, missing);
    else missing();
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(undefined)));
  const address = server.address();
  assert.ok(address && typeof address === 'object');
  return {
    url: `http://127.0.0.1:${address.port}/`,
    close: () => new Promise((resolve) => {
      server.close(() => resolve());
      server.closeAllConnections();
    }),
  };
}

/**
 * A page that collects what goes wrong on it: errors, console messages, breaches of the policy.
 * @param {import('playwright-core').Browser} browser
 * @param {string} url
 */
export async function openPage(browser, url) {
  const page = await browser.newPage();
  /** @type {string[]} */
  const incidents = [];
  page.on('pageerror', (error) => incidents.push(String(error)));
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) incidents.push(message.text());
  });
  await page.goto(url);
  return { page, incidents };
}
