/** Rust to wasm: cargo, wasm-bindgen, wasm-opt, and a look at the size. */
import { createHash } from 'node:crypto';
import { chmod, mkdtemp, readFile, rename, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { target } from '../setup/wasm-target.mjs';
import { pkg, pkgWasm, root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';

/** @typedef {import('../util/process.mjs').Env} Env */

/**
 * The package's wasm files: the crate's JavaScript bindings of one cargo feature each. `limit`
 * is the most bytes that a server may have to send, gzipped.
 */
const files = [
  { name: 'solver', feature: 'js-solver', limit: 165_000 },
  { name: 'files', feature: 'js-files', limit: 250_000 },
  { name: 'images', feature: 'js-images', limit: 560_000 },
  { name: 'meshes', feature: 'meshes', limit: 285_000 },
  { name: 'unroll', feature: 'js-unroll', limit: 150_000 },
  { name: 'patterns', feature: 'js-patterns', limit: 320_000 },
];

const stamp = join(pkgWasm, 'made-from');

/** @param {Env} env */
export async function buildWasm(env) {
  const folder = await targetFolder(env);
  const modules = [];
  for (const { name, feature } of files) {
    // A folder each: cargo keeps one library of a name, and would link them anew each time.
    const own = join(folder, `wasm-${name}`);
    const features = ['--no-default-features', '--features', feature, '--target-dir', own];
    await must('cargo', ['build', '--release', '--lib', '--target', target, ...features], env);
    modules.push(join(own, target, 'release', 'developable.wasm'));
  }
  const origin = await fingerprint(modules, env);
  if (await readFile(stamp, 'utf8').catch(() => '') !== origin) await pack(modules, origin, env);
  for (const { name, limit } of files) await checkSize(name, limit);
}

/**
 * Makes the new folder beside the old one, so that who reads there finds one or the other.
 * @param {string[]} modules
 * @param {string} origin
 * @param {Env} env
 */
async function pack(modules, origin, env) {
  const draft = await mkdtemp(join(pkg, 'wasm-draft-'));
  try {
    for (const [i, module] of modules.entries()) {
      const { name } = files[i];
      const out = ['--out-dir', draft, '--out-name', name];
      await must('wasm-bindgen', ['--target', 'web', ...out, module], env);
      const packed = join(draft, `${name}_bg.wasm`);
      await must(process.execPath, [wasmOpt, '-O3', packed, '-o', packed], env);
    }
    await writeFile(join(draft, 'made-from'), origin);
    // `mkdtemp` lets nobody else in.
    await chmod(draft, 0o755);
    await rm(pkgWasm, { recursive: true, force: true });
    await rename(draft, pkgWasm);
  } finally {
    await rm(draft, { recursive: true, force: true });
  }
}

/** npm's binaryen. It takes the module's features from the module itself. */
const wasmOpt = join(root, 'node_modules/binaryen/bin/wasm-opt');

/**
 * What the result depends on: the modules, the two tools, and this file.
 * @param {string[]} modules
 * @param {Env} env
 */
async function fingerprint(modules, env) {
  const bindgen = await run('wasm-bindgen', ['--version'], { env });
  const binaryen = await readFile(join(root, 'node_modules/binaryen/package.json'));
  const hash = createHash('sha256').update(bindgen.output).update(binaryen);
  for (const module of modules) hash.update(await readFile(module));
  return hash.update(await readFile(new URL(import.meta.url))).digest('hex');
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
