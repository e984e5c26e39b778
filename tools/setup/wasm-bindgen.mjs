/** wasm-bindgen's programs, in the very version that the crate is built with. */
import { readFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';
import { which } from '../util/which.mjs';
import { cargoInstall } from './cargo-install.mjs';

const programs = ['wasm-bindgen', 'wasm-bindgen-test-runner'];

/** The version in Cargo.lock. */
async function wanted() {
  const lock = await readFile(join(root, 'Cargo.lock'), 'utf8');
  const version = /^name = "wasm-bindgen"\nversion = "(.*)"$/m.exec(lock.replaceAll('\r', ''))?.[1];
  if (!version) throw new Problem('Cargo.lock does not name a wasm-bindgen: run `git checkout Cargo.lock`.');
  return version;
}

/**
 * @param {string} folder
 * @param {string} version
 */
async function holds(folder, version) {
  const results = await Promise.all(
    programs.map((name) => run(join(folder, name), ['--version'], { limit: 60 })));
  return results.every(({ ok, output }) => ok && output.trim().endsWith(` ${version}`));
}

/** The folder of the programs. */
export async function wasmBindgen() {
  const version = await wanted();
  const there = which('wasm-bindgen');
  if (there && await holds(dirname(there), version)) return dirname(there);
  const folder = await cargoInstall('wasm-bindgen-cli', version, {
    time: 'about 4 minutes',
    flags: programs.flatMap((name) => ['--bin', name]),
  });
  if (!await holds(folder, version)) {
    throw new Problem(`The programs in ${folder} do not run: delete that folder and try again.`);
  }
  return folder;
}
