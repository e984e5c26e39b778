/** wasm-bindgen's programs, in the very version that the crates in wasm/ are built with. */
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { homedir } from 'node:os';
import { dirname, join } from 'node:path';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';
import { which } from '../util/which.mjs';
import { entry } from './cached.mjs';
import { cargoInstall } from './cargo-install.mjs';

/**
 * The folder of `wasm-bindgen`: of whatever has it already, or else of our own small program, which takes
 * a third of the time that wasm-bindgen's command does.
 */
export async function wasmBindgen() {
  const version = await wanted();
  return await there(['wasm-bindgen'], version)
    ?? sound(['wasm-bindgen'], version, await cargoInstall('wasm-bindgen', version, {
      time: 'about 30 s',
      what: "wasm-bindgen's library as a program",
      source: ['--path', join(root, 'tools/bindgen'), '--profile', 'tool', '--locked'],
    }));
}

/** The folder of `wasm-bindgen` and the runner of its tests. */
export async function wasmBindgenTests() {
  const version = await wanted();
  const programs = ['wasm-bindgen', 'wasm-bindgen-test-runner'];
  return await there(programs, version)
    ?? sound(programs, version, await cargoInstall('wasm-bindgen-cli', version, {
      time: 'about 1 minute',
      // Without TLS: the runner talks to a browser's driver on this machine.
      source: ['wasm-bindgen-cli', '--version', version, '--no-default-features', ...programs.flatMap((name) => ['--bin', name])],
    }));
}

/** The version in Cargo.lock. */
async function wanted() {
  const lock = await readFile(join(root, 'Cargo.lock'), 'utf8');
  const version = /^name = "wasm-bindgen"\nversion = "(.*)"$/m.exec(lock.replaceAll('\r', ''))?.[1];
  if (!version) throw new Problem('Cargo.lock does not name a wasm-bindgen: run `git checkout Cargo.lock`.');
  return version;
}

/**
 * A folder that has the programs in this version already: on the path, where cargo installs to, in our
 * cache.
 * @param {string[]} programs
 * @param {string} version
 */
async function there(programs, version) {
  const onPath = which('wasm-bindgen');
  const folders = [
    ...(onPath ? [dirname(onPath)] : []),
    join(process.env.CARGO_HOME || join(homedir(), '.cargo'), 'bin'),
    join(entry(`wasm-bindgen-cli-${version}`), 'bin'),
  ];
  for (const folder of folders) {
    if (existsSync(folder) && await holds(folder, programs, version)) return folder;
  }
  return undefined;
}

/**
 * @param {string} folder
 * @param {string[]} programs
 * @param {string} version
 */
async function holds(folder, programs, version) {
  const results = await Promise.all(
    programs.map((name) => run(join(folder, name), ['--version'], { limit: 60 })));
  return results.every(({ ok, output }) => ok && output.trim().endsWith(` ${version}`));
}

/**
 * @param {string[]} programs
 * @param {string} version
 * @param {string} folder
 */
async function sound(programs, version, folder) {
  if (await holds(folder, programs, version)) return folder;
  throw new Problem(`The programs in ${folder} do not run: delete that folder and try again.`);
}
