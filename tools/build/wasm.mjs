/** Rust to wasm: cargo, wasm-bindgen, wasm-opt, and a look at the size. */
import { createHash } from 'node:crypto';
import { chmod, copyFile, mkdtemp, readFile, readdir, rename, rm, writeFile } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { basename, join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { target } from '../setup/wasm-target.mjs';
import { pkg, pkgWasm, root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';

/** @typedef {import('../util/process.mjs').Env} Env */

/**
 * The package's wasm files, each of the crate `wasm/NAME`. `limit` is the most bytes that a server may
 * have to send, gzipped.
 */
const files = [
  { name: 'solver', limit: 238_000 },
  { name: 'files', limit: 275_000 },
  { name: 'images', limit: 560_000 },
  { name: 'meshes', limit: 295_000 },
  { name: 'fitmesh', limit: 174_000 },
  { name: 'unroll', limit: 272_000 },
  { name: 'patterns', limit: 523_000 },
];

/**
 * `quick`: for whoever changes the code and looks at the page. Only what has changed is compiled, in
 * pieces; the wasm is a little larger and slower.
 * @typedef {'release' | 'quick'} Build
 */

/** @param {Env} env */
export async function buildWasm(env) {
  await compileWasm(env);
  await packWasm(env);
}

/** The package's crates, as cargo is told. */
export const crates = files.flatMap(({ name }) => ['--package', `developable-wasm-${name}`]);

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
 * @param {Env} env
 * @param {Build} [kind]
 */
export async function packWasm(env, kind = 'release') {
  const from = join(await targetFolder(env), target, 'release');
  const tools = await fingerprint(env, kind);
  const modules = await Promise.all(files.map(async ({ name }) => {
    const module = join(from, `developable_wasm_${name}.wasm`);
    const origin = createHash('sha256').update(tools).update(await readFile(module)).digest('hex');
    const packed = await readFile(made(pkgWasm, name), 'utf8').catch(() => '');
    return { name, module, origin, current: packed === origin };
  }));
  if (!modules.every(({ current }) => current)) {
    const draft = await mkdtemp(join(pkg, 'wasm-draft-'));
    try {
      const pending = modules[Symbol.iterator]();
      // As many at a time as there are cores: wasm-opt has but one thread.
      await Promise.all(Array.from({ length: availableParallelism() }, async () => {
        for (const module of pending) await pack(draft, module, env, kind);
      }));
      // `mkdtemp` lets nobody else in.
      await chmod(draft, 0o755);
      await rm(pkgWasm, { recursive: true, force: true });
      await rename(draft, pkgWasm);
    } finally {
      await rm(draft, { recursive: true, force: true });
    }
  }
  if (kind === 'release') for (const { name, limit } of files) await checkSize(name, limit);
}

/**
 * @param {string} folder
 * @param {{ name: string, module: string, origin: string, current: boolean }} file
 * @param {Env} env
 * @param {Build} kind
 */
async function pack(folder, { name, module, origin, current }, env, kind) {
  if (current) {
    for (const part of await readdir(pkgWasm)) {
      if (part === basename(made('', name)) || new RegExp(`^${name}(_bg)?\\.`).test(part)) {
        await copyFile(join(pkgWasm, part), join(folder, part));
      }
    }
    return;
  }
  await must('wasm-bindgen', ['--target', 'web', '--out-dir', folder, '--out-name', name, module], env);
  if (kind === 'release') {
    const packed = join(folder, `${name}_bg.wasm`);
    // Beyond -O1 it takes twice as long for a file of the same size, gzipped.
    await must(process.execPath, [wasmOpt, '-O1', packed, '-o', packed], env);
  }
  await writeFile(made(folder, name), origin);
}

/**
 * Where it says what a file was made from.
 * @param {string} folder
 * @param {string} name
 */
const made = (folder, name) => join(folder, `${name}.made-from`);

/** npm's binaryen. It takes the module's features from the module itself. */
const wasmOpt = join(root, 'node_modules/binaryen/bin/wasm-opt');

/**
 * What the result depends on besides the module: the two tools, and this file.
 * @param {Env} env
 * @param {Build} kind
 */
async function fingerprint(env, kind) {
  const bindgen = await run('wasm-bindgen', ['--version'], { env });
  const binaryen = await readFile(join(root, 'node_modules/binaryen/package.json'));
  const own = await readFile(new URL(import.meta.url));
  return createHash('sha256').update(bindgen.output).update(binaryen).update(own).update(kind).digest();
}

/** @param {Env} env */
async function targetFolder(env) {
  const { output } = await run('cargo', ['metadata', '--no-deps', '--format-version=1', '--quiet'], { env, cwd: root });
  return /** @type {string} */ (JSON.parse(output.slice(output.indexOf('{'))).target_directory);
}

/**
 * @param {string} name
 * @param {number} limit
 */
async function checkSize(name, limit) {
  const bytes = await readFile(join(pkgWasm, `${name}_bg.wasm`));
  const gzipped = gzipSync(bytes, { level: 9 }).length;
  console.log(`${name}: ${(bytes.length / 1000).toFixed(1)} kB of wasm, ${(gzipped / 1000).toFixed(1)} kB gzipped`);
  if (gzipped > limit) {
    throw new Problem(`${name}_bg.wasm is ${gzipped} bytes gzipped and may be ${limit}: look at what was added to it.`);
  }
}

/**
 * @param {string} command
 * @param {string[]} args
 * @param {Env} env
 */
async function must(command, args, env) {
  const { ok, failure } = await run(command, args, { env, cwd: root, show: true });
  if (!ok) throw new Problem(`The build stopped (${failure}): see what ${command} says above.`);
}
