/** Chromium, and folders served to it under the strict policy that the package promises to live with. */
import assert from 'node:assert/strict';
import { accessSync, constants } from 'node:fs';
import { chromium } from 'playwright-core';
import { serve as serveFolders } from '../../../tools/serve.mjs';

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
/**
 * @param {Record<string, string>} folders from where in the site to what on the disk
 * @param {Record<string, string>} [headers] of every answer
 * @returns {Promise<{ url: string, close: () => Promise<void> }>}
 */
export const serve = (folders, headers) => serveFolders({ folders, policy, headers });

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
