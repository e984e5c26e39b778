/** Chromium, and folders served to it under the strict policy that the package promises to live with. */
import assert from 'node:assert/strict';
import { chromium } from 'playwright-core';
import { strict } from '../../../tools/consumers/browse.mjs';
import { serve as serveFolders } from '../../../tools/serve.mjs';
import { isProgram } from '../../../tools/util/which.mjs';

export { openPage } from '../../../tools/consumers/browse.mjs';

export const executablePath = process.env.DEVELOPABLE_CHROME || '/usr/bin/chromium';
export const args = [
  '--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync',
];

/** Why the tests cannot run here; in CI that is a failure. */
export const skip = !isProgram(executablePath) && `no browser at ${executablePath}`;
if (skip) assert.notEqual(process.env.CI, 'true', `in CI there must be one: ${skip}`);

export const launch = () => chromium.launch({ executablePath, args });

/**
 * @param {Record<string, string>} folders from where in the site to what on the disk
 * @param {Record<string, string>} [headers] of every answer
 * @returns {Promise<{ url: string, close: () => Promise<void> }>}
 */
export const serve = (folders, headers) => serveFolders({ folders, policy: strict, headers });
