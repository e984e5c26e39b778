/**
 * `node tools/ci-start.mjs`: runs `npm start` as the README says, waits until the page answers and has solved its
 * example of a scan in a real browser, and ends it with Ctrl-C's signal.
 */
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { createInterface } from 'node:readline';
import { browser } from './setup/browser.mjs';
import { root } from './util/paths.mjs';
import { main, Problem } from './util/problem.mjs';

const MAX_START_MINUTES = 30;
const MAX_FIT_MINUTES = 5;

await main(async () => {
  const start = spawn('npm', ['start'], {
    cwd: root, env: { ...process.env, PORT: '0' }, stdio: ['ignore', 'pipe', 'inherit'], detached: true,
  });
  const ended = once(start, 'exit');
  const signal = (/** @type {NodeJS.Signals} */ name) => process.kill(-(start.pid ?? 0), name);
  process.on('exit', () => start.exitCode === null && start.signalCode === null && signal('SIGKILL'));
  const url = await address(start);
  const response = await fetch(url);
  if (!response.ok) throw new Problem(`${url} answers ${response.status}.`);
  await fitInBrowser(url);
  signal('SIGINT');
  await Promise.race([ended, late(1, '`npm start` does not end by Ctrl-C.')]);
  await assert.rejects(fetch(url), 'the port is still open after Ctrl-C');
  console.log('npm start: the page answers, fits its example in Chromium, and ends by Ctrl-C.');
  process.exit(0);
});

/**
 * The address that `npm start` prints when it serves the page. What it prints is shown.
 * @param {import('node:child_process').ChildProcessByStdio<null, import('node:stream').Readable, null>} start
 * @returns {Promise<string>}
 */
function address(start) {
  const found = new Promise((resolve, reject) => {
    createInterface({ input: start.stdout }).on('line', (line) => {
      console.log(line);
      const url = /page is at (\S+)/.exec(line)?.[1];
      if (url) resolve(url);
    });
    start.on('exit', (status) => reject(new Problem(`\`npm start\` ended with status ${status} before it served the page.`)));
  });
  return Promise.race([found, late(MAX_START_MINUTES, '`npm start` did not serve the page')]);
}

/** @param {string} url */
async function fitInBrowser(url) {
  const { chrome } = await browser();
  if (!chrome) throw new Problem('No Chromium or Chrome was found: install one or name it by CHROME.');
  // Only now: `npm start` has installed it.
  const { chromium } = await import('playwright-core');
  const program = await chromium.launch({ executablePath: chrome, args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });
  try {
    const page = await program.newPage();
    /** @type {string[]} */
    const errors = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    await page.goto(url);
    await page.locator('[data-example="scan"]').click();
    // The headline is written when the surface's pieces are counted.
    await page.locator('#verdict').filter({ hasText: 'piece' }).waitFor({ timeout: MAX_FIT_MINUTES * 60_000 });
    assert.deepEqual(errors, []);
  } finally {
    await program.close();
  }
}

/**
 * @param {number} minutes
 * @param {string} what
 * @returns {Promise<never>}
 */
function late(minutes, what) {
  return new Promise((_, reject) => {
    setTimeout(() => reject(new Problem(`${what} after ${minutes} minutes.`)), minutes * 60_000).unref();
  });
}
