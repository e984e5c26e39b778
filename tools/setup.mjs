/** `npm run setup`: gets everything that building and testing need. What is there is left alone. */
import { pathToFileURL } from 'node:url';
import { browser } from './setup/browser.mjs';
import { npmPackages } from './setup/npm.mjs';
import { rust } from './setup/rust.mjs';
import { wasmBindgen, wasmBindgenTests } from './setup/wasm-bindgen.mjs';
import { wasmTarget } from './setup/wasm-target.mjs';
import { withPath } from './util/env.mjs';
import { describe, main, Problem } from './util/problem.mjs';

/** @typedef {import('./util/process.mjs').Env} Env */

/**
 * What a page in the browser needs. The wasm is compiled meanwhile: the tools take about as long.
 * @param {(env: Env) => Promise<void>} [compile]
 */
export async function setupBuild(compile = async () => {}) {
  await rust();
  const target = wasmTarget();
  const [env, bindgen] = await together(target, wasmBindgen(), npmPackages(), target.then(compile));
  return { env, bindgen };
}

/**
 * What the tests need besides.
 * @param {(env: Env) => Promise<void>} [compile]
 */
export async function setupTests(compile = async () => {}) {
  await rust();
  const target = wasmTarget();
  const [env, bindgen, runner, found] =
    await together(target, wasmBindgen(), wasmBindgenTests(), browser(), npmPackages(), target.then(compile));
  return { env: withPath(env, runner), bindgen, browser: found };
}

/**
 * Waits for all, so that what one has made is kept when another fails; then reports every failure.
 * @template {unknown[]} T
 * @param {[...{ [K in keyof T]: Promise<T[K]> }]} parts
 * @returns {Promise<T>}
 */
async function together(...parts) {
  const results = await Promise.allSettled(parts);
  const reasons = results.flatMap((result) => (result.status === 'rejected' ? [result.reason] : []));
  if (reasons.length > 0) throw new Problem(reasons.map(describe).join('\n'));
  return /** @type {Promise<T>} */ (Promise.all(parts));
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  await main(async () => {
    await setupTests();
    console.log('Everything is set up.');
  });
}
