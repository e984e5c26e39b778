/** wasm-bindgen's tests: those in tests/NAME.rs, compiled to wasm, run in Node and in a browser. */
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { stripVTControlCharacters } from 'node:util';
import { crates } from '../build/wasm.mjs';
import { target } from '../setup/wasm-target.mjs';
import { without } from '../util/env.mjs';
import { inTemporaryFolder } from '../util/folders.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { Skip, check } from './step.mjs';

/** @typedef {import('./step.mjs').Context} Context */
/** @typedef {import('./step.mjs').Env} Env */

/**
 * @param {string} name
 * @returns {(context: Context) => Promise<void>}
 */
export const inNode = (name) => ({ env }) => inTemporaryFolder(async (folder) => {
  // The runner writes CommonJS below its temporary folder; a package.json above that may say otherwise.
  await writeFile(join(folder, 'package.json'), '{ "type": "commonjs" }\n');
  await cargoTest(name, { ...env, TMPDIR: folder, TEMP: folder, TMP: folder });
});

/**
 * @param {string} name
 * @returns {(context: Context) => Promise<void>}
 */
export const inBrowser = (name) => async ({ env, browser: { chrome, driver } }) => {
  if (!chrome) throw new Skip('no Chromium or Chrome was found (CHROME can name one)');
  if (!driver) throw new Skip('no chromedriver was found (CHROMEDRIVER can name one)');
  const capabilities = JSON.parse(await readFile(join(root, 'tests/wasm/webdriver.json'), 'utf8'));
  capabilities['goog:chromeOptions'].binary = chrome;
  await inTemporaryFolder(async (folder) => {
    const file = join(folder, 'webdriver.json');
    await writeFile(file, JSON.stringify(capabilities));
    // The runner would prefer another browser's driver, or one that is running elsewhere.
    const own = without(env, /^(GECKO|SAFARI|MSEDGE|CHROME)DRIVER/);
    await cargoTest(name, { ...own, CHROMEDRIVER: driver, WASM_BINDGEN_TEST_WEBDRIVER_JSON: file });
  });
};

/**
 * @param {string} name
 * @param {Env} env
 */
async function cargoTest(name, env) {
  // The package's crates are named so that cargo gives the library the features that it has in them.
  const features = ['--no-default-features', '--features', 'developable/formats'];
  const which = ['--package', 'developable', ...crates, ...features, '--test', name];
  const output = await check('cargo', ['test', '--release', '--target', target, ...which], {
    ...env,
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: 'wasm-bindgen-test-runner',
    WASM_BINDGEN_TEST_TIMEOUT: '300',
  });
  // The runner is content with a file without any test.
  if (!/test result: ok\. [1-9]\d* passed/.test(stripVTControlCharacters(output))) throw new Problem(`tests/${name}.rs ran no test`);
}
