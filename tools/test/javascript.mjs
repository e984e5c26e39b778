/** Checks and tests of the JavaScript. */
import { readFile, readdir, writeFile } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { stripVTControlCharacters } from 'node:util';
import { buildOptionTypes } from '../build/option-types.mjs';
import { bundlePage } from '../site.mjs';
import { native } from '../util/env.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { Skip, check } from './step.mjs';

/** @typedef {import('./step.mjs').Context} Context */
/** @typedef {import('./step.mjs').Env} Env */

export async function size() {
  await check(process.execPath, [join(root, 'tools/size.mjs')], process.env);
}

export async function types() {
  // In a folder of its own: elsewhere cargo would wait until the library's tests are compiled.
  await check('cargo', ['test', '--quiet', '--profile', 'dev', '-p', 'developable-types', '--target-dir', 'target/types'], native);
  await buildOptionTypes();
  await check(process.execPath, [join(root, 'node_modules/typescript/bin/tsc')], process.env);
}

/** @param {Context} context */
export async function nodeTests({ browser: { chrome } }) {
  await nodeTest('tests/js', await testFiles('tests/js'), { ...process.env, DEVELOPABLE_CHROME: chrome });
}

/**
 * The page is bundled once. A process for each core runs several files, so that they share a browser, and what that has
 * compiled; how long a file takes goes with its length.
 * @param {Context} context
 */
export async function pageTests({ browser: { chrome } }) {
  if (!chrome) throw new Skip('no Chromium or Chrome was found (CHROME can name one)');
  const folder = join(root, 'target/page');
  await bundlePage(join(folder, 'bundle'));
  const lanes = Array.from({ length: availableParallelism() }, () => ({ length: 0, imports: '' }));
  const files = await Promise.all((await testFiles('tests/page')).map(async (file) => ({ file, length: (await readFile(file, 'utf8')).length })));
  for (const { file, length } of files.sort((a, b) => b.length - a.length)) {
    const shortest = lanes.reduce((one, other) => (other.length < one.length ? other : one));
    shortest.length += length;
    shortest.imports += `  await import(${JSON.stringify(pathToFileURL(file).href)});\n`;
  }
  const entries = await Promise.all(lanes.filter(({ imports }) => imports).map(async ({ imports }, k) => {
    const entry = join(folder, `lane-${k + 1}.test.mjs`);
    // Node ends a run, and closes the server of all its tests, when the first tests are over before all files are loaded.
    await writeFile(entry, `import { test } from 'node:test';\nconst loaded = (async () => {\n${imports}})();\ntest('all files are loaded', () => loaded);\n`);
    return entry;
  }));
  await nodeTest('tests/page', entries, { ...process.env, DEVELOPABLE_CHROME: chrome, DEVELOPABLE_PAGE: join(folder, 'bundle') });
}

/** @param {string} folder */
async function testFiles(folder) {
  const names = await readdir(join(root, folder)).catch(() => /** @type {string[]} */ ([]));
  const files = names.filter((name) => name.endsWith('.test.mjs')).sort().map((name) => join(root, folder, name));
  if (files.length === 0) throw new Problem(`there is no test in ${folder}`);
  return files;
}

/**
 * @param {string} folder
 * @param {readonly string[]} files
 * @param {Env} env
 */
async function nodeTest(folder, files, env) {
  // They wait for workers and browsers; Node by itself would leave one core idle.
  const options = ['--test', '--test-reporter=spec', `--test-concurrency=${availableParallelism()}`];
  const output = await check(process.execPath, [...options, ...files], env);
  const skipped = Number(/\bskipped (\d+)\s*$/m.exec(stripVTControlCharacters(output))?.[1] ?? 0);
  if (process.env.CI && skipped > 0) throw new Problem(`${skipped} tests in ${folder} were skipped`);
}
