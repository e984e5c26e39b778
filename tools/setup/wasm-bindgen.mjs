/** wasm-bindgen's programs, in the very version that the crates in wasm/ are built with. */
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { homedir } from 'node:os';
import { dirname, join } from 'node:path';
import { filesIn, hashOf } from '../util/hash.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';
import { which } from '../util/which.mjs';
import { entry } from './cached.mjs';
import { cargoInstall } from './cargo-install.mjs';

const sources = join(root, 'tools/bindgen');

/**
 * The program that makes the package's JavaScript and types: always the one in tools/bindgen, which compiles in a
 * third of the time that wasm-bindgen's own command takes. So the package does not depend on what else is installed.
 */
export async function wasmBindgen() {
  const version = await wanted();
  // The cache has one program for each state of its sources.
  const folder = await cargoInstall('developable-bindgen', `${version}-${await sourceHash()}`, {
    time: 'about 30 s',
    what: "wasm-bindgen's library as a program",
    source: ['--path', sources, '--profile', 'tool', '--locked'],
  });
  if (!await holds(folder, ['wasm-bindgen'], version)) throw broken(folder);
  return join(folder, process.platform === 'win32' ? 'wasm-bindgen.exe' : 'wasm-bindgen');
}

/** The folder of wasm-bindgen's own command and the runner of its tests. */
export async function wasmBindgenTests() {
  const version = await wanted();
  const programs = ['wasm-bindgen', 'wasm-bindgen-test-runner'];
  const found = await there(programs, version);
  if (found) return found;
  const folder = await cargoInstall('wasm-bindgen-cli', version, {
    time: 'about 1 minute',
    // Without TLS: the runner talks to a browser's driver on this machine.
    source: ['wasm-bindgen-cli', '--version', version, '--no-default-features', ...programs.flatMap((name) => ['--bin', name])],
  });
  if (!await holds(folder, programs, version)) throw broken(folder);
  return folder;
}

/** The version in Cargo.lock. */
async function wanted() {
  const lock = await readFile(join(root, 'Cargo.lock'), 'utf8');
  const version = /^name = "wasm-bindgen"\nversion = "(.*)"$/m.exec(lock.replaceAll('\r', ''))?.[1];
  if (!version) throw new Problem('Cargo.lock does not name a wasm-bindgen: run `git checkout Cargo.lock`.');
  return version;
}

/** Changes with any file of tools/bindgen. */
async function sourceHash() {
  const names = (await filesIn(join(sources, 'src'))).map((name) => `src/${name}`);
  return (await hashOf(sources, ['Cargo.toml', ...names])).slice(0, 12);
}

/**
 * A folder that has the programs in this version already: on the path, where cargo installs to, in our
 * cache.
 * @param {string[]} programs
 * @param {string} version
 */
async function there(programs, version) {
  const onPath = which('wasm-bindgen-test-runner');
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
 * Whether a folder has the programs in this version.
 * @param {string} folder
 * @param {string[]} programs
 * @param {string} version
 */
async function holds(folder, programs, version) {
  const results = await Promise.all(
    programs.map((name) => run(join(folder, name), ['--version'], { limit: 60 })));
  return results.every(({ ok, output }) => ok && output.trim().endsWith(` ${version}`));
}

/** @param {string} folder */
const broken = (folder) => new Problem(`The programs in ${folder} do not run: delete that folder and try again.`);
