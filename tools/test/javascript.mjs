/** Checks and tests of the JavaScript. */
import { readdir } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { stripVTControlCharacters } from 'node:util';
import { buildOptionTypes } from '../build/option-types.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { Skip, check } from './step.mjs';

/** @typedef {import('./step.mjs').Context} Context */
/** @typedef {import('./step.mjs').Env} Env */

export async function types() {
  await buildOptionTypes();
  await check(process.execPath, [join(root, 'node_modules/typescript/bin/tsc')], process.env);
}

/** @param {Context} context */
export async function nodeTests({ browser: { chrome } }) {
  await nodeTest('tests/js', { ...process.env, DEVELOPABLE_CHROME: chrome });
}

/** @param {Context} context */
export async function pageTests({ browser: { chrome } }) {
  if (!chrome) throw new Skip('no Chromium or Chrome was found (CHROME can name one)');
  await nodeTest('tests/page', { ...process.env, DEVELOPABLE_CHROME: chrome });
}

/**
 * @param {string} folder
 * @param {Env} env
 */
async function nodeTest(folder, env) {
  const names = await readdir(join(root, folder)).catch(() => /** @type {string[]} */ ([]));
  const files = names.filter((name) => name.endsWith('.test.mjs')).map((name) => `${folder}/${name}`);
  if (files.length === 0) throw new Problem(`there is no test in ${folder}`);
  // They wait for workers and browsers; Node by itself would leave one core idle.
  const options = ['--test', '--test-reporter=spec', `--test-concurrency=${availableParallelism()}`];
  const output = await check(process.execPath, [...options, ...files.sort()], env);
  const skipped = Number(/\bskipped (\d+)\s*$/m.exec(stripVTControlCharacters(output))?.[1] ?? 0);
  if (process.env.CI && skipped > 0) throw new Problem(`${skipped} tests in ${folder} were skipped`);
}
