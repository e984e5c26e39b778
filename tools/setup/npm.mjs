/** npm's packages, as package-lock.json has them. */
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { quietly, task } from './task.mjs';

/** @typedef {Record<string, { version?: string, optional?: boolean }>} Packages */

/**
 * @param {string} file
 * @returns {Promise<Packages>}
 */
async function packages(file) {
  return JSON.parse(await readFile(file, 'utf8')).packages;
}

/** Whether node_modules is what the lock file asks for; npm leaves a lock file of what it installed. */
async function isCurrent() {
  const wanted = await packages(join(root, 'package-lock.json'));
  const installed = await packages(join(root, 'node_modules/.package-lock.json')).catch(() => null);
  return installed !== null && Object.entries(wanted).every(([path, { version, optional }]) =>
    path === '' || installed[path]?.version === version || (optional && !installed[path]));
}

export async function npmPackages() {
  if (await isCurrent()) return;
  await task('npm packages, into node_modules', 'about 15 s', async () => {
    const args = ['ci', '--ignore-scripts', '--no-audit', '--no-fund'];
    // npm hands on where its own program is; on Windows that is the only way without a shell.
    const npm = process.env.npm_execpath;
    const options = { cwd: root, limit: 600 };
    const { ok, failure } = npm
      ? await quietly('npm', process.execPath, [npm, ...args], options)
      : await quietly('npm', 'npm', args, options);
    if (!ok) {
      throw new Problem(`npm could not install the packages of package-lock.json (${failure}): `
        + 'see that its registry can be reached and run `npm ci`.');
    }
  });
}
