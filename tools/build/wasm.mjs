/** Rust to wasm: cargo, wasm-bindgen, wasm-opt, and a look at the size. */
import { createHash } from 'node:crypto';
import { existsSync } from 'node:fs';
import { copyFile, readFile, writeFile } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { target } from '../setup/wasm-target.mjs';
import { replaceFolder } from '../util/folders.mjs';
import { pkgWasm, root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run, succeed } from '../util/process.mjs';

/** @typedef {import('../util/process.mjs').Env} Env */

/**
 * @typedef {object} Tools what the set-up has found
 * @property {Env} env in which cargo builds for wasm
 * @property {string} bindgen the program that makes JavaScript and types
 */

/**
 * The package's wasm files, each of the crate `wasm/NAME`. `limit` is the most bytes that a server may
 * have to send, gzipped.
 */
const files = [
  { name: 'solver', limit: 271_000 },
  { name: 'files', limit: 295_000 },
  { name: 'images', limit: 591_000 },
  { name: 'meshes', limit: 345_000 },
  { name: 'fitmesh', limit: 231_000 },
  { name: 'unroll', limit: 366_000 },
  { name: 'patterns', limit: 710_000 },
];

/**
 * `quick`: for whoever changes the code and looks at the page. Only what has changed is compiled, in
 * pieces; the wasm is a little larger and slower.
 * @typedef {'release' | 'quick'} Build
 */

/** @param {Tools} tools */
export async function buildWasm(tools) {
  await compileWasm(tools.env);
  await packWasm(tools);
}

/** What the package's wasm files are called. */
export const names = files.map(({ name }) => name);

/** The package's crates, as cargo is told. */
export const crates = names.flatMap((name) => ['--package', `developable-wasm-${name}`]);

/**
 * Compiles the crates, in one call and one folder, so that what they share is compiled once.
 * @param {Env} env without need of wasm-bindgen
 * @param {Build} [kind]
 */
export async function compileWasm(env, kind = 'release') {
  const pieces = ['developable', 'developable-wasm-images'].map((name) => `package.${name}.codegen-units=64`);
  const settings = kind === 'quick' ? ['incremental=true', ...pieces] : [];
  const config = settings.flatMap((setting) => ['--config', `profile.release.${setting}`]);
  await must('cargo', ['build', '--release', '--target', target, ...crates, ...config], env);
}

/**
 * Makes the package's files of the modules that have changed: in a new folder beside the old one, so
 * that who reads there finds one or the other.
 * @param {Tools} tools
 * @param {Build} [kind]
 */
export async function packWasm({ env, bindgen }, kind = 'release') {
  const from = await modulesFolder(env);
  const tools = await fingerprint(bindgen, kind);
  const modules = await Promise.all(files.map(async ({ name }) => {
    const module = join(from, moduleFile(name));
    const origin = createHash('sha256').update(tools).update(await readFile(module)).digest('hex');
    return { name, module, origin, current: await isCurrent(name, origin) };
  }));
  if (!modules.every(({ current }) => current)) {
    await replaceFolder(pkgWasm, async (draft) => {
      const pending = modules[Symbol.iterator]();
      // As many at a time as there are cores: wasm-opt has but one thread.
      await Promise.all(Array.from({ length: availableParallelism() }, async () => {
        for (const module of pending) await pack(draft, module, bindgen, kind);
      }));
    });
  }
  if (kind === 'release') for (const { name, limit } of files) await checkSize(pkgWasm, name, limit);
}

/**
 * @param {string} folder
 * @param {{ name: string, module: string, origin: string, current: boolean }} file
 * @param {string} bindgen
 * @param {Build} kind
 */
async function pack(folder, { name, module, origin, current }, bindgen, kind) {
  if (current) {
    for (const part of [...partsOf(name), made(name)]) await copyFile(join(pkgWasm, part), join(folder, part));
    return;
  }
  await must(bindgen, bindgenArguments(folder, name, module), process.env);
  const missing = partsOf(name).filter((part) => !existsSync(join(folder, part)));
  if (missing.length > 0) {
    throw new Problem(`${bindgen} did not write ${missing.join(', ')}: see what tools/bindgen asks of it.`);
  }
  if (kind === 'release') {
    const packed = join(folder, `${name}_bg.wasm`);
    // Beyond -O1 it takes twice as long for a file of the same size, gzipped.
    await must(process.execPath, [wasmOpt, '-O1', packed, '-o', packed], process.env);
  }
  await writeFile(join(folder, made(name)), origin);
}

/**
 * What wasm-bindgen is told; its own command and the program in tools/bindgen understand it alike.
 * @param {string} folder
 * @param {string} name
 * @param {string} module
 */
export const bindgenArguments = (folder, name, module) =>
  ['--target', 'web', '--out-dir', folder, '--out-name', name, module];

/**
 * The files that wasm-bindgen makes of a module.
 * @param {string} name
 */
const partsOf = (name) => [`${name}.js`, `${name}.d.ts`, `${name}_bg.wasm`, `${name}_bg.wasm.d.ts`];

/**
 * Where it says what a module's files were made from.
 * @param {string} name
 */
const made = (name) => `${name}.made-from`;

/**
 * Whether all files of a module are there, and were made from what there is now.
 * @param {string} name
 * @param {string} origin
 */
async function isCurrent(name, origin) {
  const from = await readFile(join(pkgWasm, made(name)), 'utf8').catch(() => '');
  return from === origin && partsOf(name).every((part) => existsSync(join(pkgWasm, part)));
}

/** npm's binaryen. It takes the module's features from the module itself. */
export const wasmOpt = join(root, 'node_modules/binaryen/bin/wasm-opt');

/**
 * What the files depend on besides the module: the two tools, and this script.
 * @param {string} bindgen
 * @param {Build} kind
 */
async function fingerprint(bindgen, kind) {
  const binaryen = await readFile(join(root, 'node_modules/binaryen/package.json'));
  const own = await readFile(new URL(import.meta.url));
  return createHash('sha256').update(await readFile(bindgen)).update(binaryen).update(own).update(kind).digest();
}

/**
 * Where cargo leaves the modules.
 * @param {Env} env
 */
export async function modulesFolder(env) {
  const { output } = await run('cargo', ['metadata', '--no-deps', '--format-version=1', '--quiet'], { env, cwd: root });
  const { target_directory: folder } = JSON.parse(output.slice(output.indexOf('{')));
  return join(folder, target, 'release');
}

/** @param {string} name */
export const moduleFile = (name) => `developable_wasm_${name}.wasm`;

/**
 * Tells the size of a wasm file, and stops the build where that is too large.
 * @param {string} folder
 * @param {string} name
 * @param {number} limit in bytes, gzipped
 */
export async function checkSize(folder, name, limit) {
  const bytes = await readFile(join(folder, `${name}_bg.wasm`));
  const gzipped = gzipSync(bytes, { level: 9 }).length;
  console.log(`${name}: ${(bytes.length / 1000).toFixed(1)} kB of wasm, ${(gzipped / 1000).toFixed(1)} kB gzipped`);
  if (gzipped > limit) {
    throw new Problem(`${name}_bg.wasm is ${gzipped} bytes gzipped and may be ${limit}: look at what was added to it.`);
  }
}

/**
 * Runs a program, and stops the build where it fails.
 * @param {string} command
 * @param {string[]} args
 * @param {Env} env
 */
export const must = (command, args, env) => succeed(command, args, { env, cwd: root, show: true });
