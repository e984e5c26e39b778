/** Pages in a browser, and the servers of tools. */
import { spawn } from 'node:child_process';
import { chromium } from 'playwright-core';
import { Problem } from '../util/problem.mjs';

/** The content security policy that the package promises to live with. */
export const strict =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; img-src data:";

/** The same for a bundle that has the worker as a copy. */
export const withBlobs = strict.replace("worker-src 'self'", "worker-src 'self' blob:");

/** The same for a page with a script in it. */
export const withInline = strict.replace("script-src 'self'", "script-src 'self' 'unsafe-inline'");

/**
 * The same for a page that has the package from another origin.
 * @param {string} origin
 */
export const withOrigin = (origin) =>
  `default-src 'none'; script-src 'self' 'wasm-unsafe-eval' ${origin}; connect-src ${origin}; worker-src blob:; img-src data:`;

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
    const { page, incidents } = await openPage(browser, url);
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
