/** Rust to wasm: cargo, wasm-bindgen, wasm-opt, and a look at the size. */
import { createHash } from 'node:crypto';
import { mkdtemp, readFile, rename, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { target } from '../setup/wasm-target.mjs';
import { pkg, pkgWasm, root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';

/** @typedef {import('../util/process.mjs').Env} Env */

/** Most bytes of the wasm file when a server sends it gzipped. */
const limit = 150_000;

const stamp = join(pkgWasm, 'made-from');

/** @param {Env} env */
export async function buildWasm(env) {
  await must('cargo', ['build', '--release', '--lib', '--target', target], env);
  const module = join(await targetFolder(env), target, 'release', 'developable.wasm');
  const origin = await fingerprint(module, env);
  if (await readFile(stamp, 'utf8').catch(() => '') !== origin) await pack(module, origin, env);
  await checkSize(join(pkgWasm, 'developable_bg.wasm'));
}

/**
 * Makes the new folder beside the old one, so that who reads there finds one or the other.
 * @param {string} module
 * @param {string} origin
 * @param {Env} env
 */
async function pack(module, origin, env) {
  const draft = await mkdtemp(join(pkg, 'wasm-draft-'));
  try {
    await must('wasm-bindgen', ['--target', 'web', '--out-dir', draft, module], env);
    const packed = join(draft, 'developable_bg.wasm');
    await must(process.execPath, [wasmOpt, '-O3', packed, '-o', packed], env);
    await writeFile(join(draft, 'made-from'), origin);
    await rm(pkgWasm, { recursive: true, force: true });
    await rename(draft, pkgWasm);
  } finally {
    await rm(draft, { recursive: true, force: true });
  }
}

/** npm's binaryen. It takes the module's features from the module itself. */
const wasmOpt = join(root, 'node_modules/binaryen/bin/wasm-opt');

/**
 * What the result depends on: the module, the two tools, and this file.
 * @param {string} module
 * @param {Env} env
 */
async function fingerprint(module, env) {
  const bindgen = await run('wasm-bindgen', ['--version'], { env });
  const binaryen = await readFile(join(root, 'node_modules/binaryen/package.json'));
  const hash = createHash('sha256').update(bindgen.output).update(binaryen);
  return hash.update(await readFile(module)).update(await readFile(new URL(import.meta.url))).digest('hex');
}

/** @param {Env} env */
async function targetFolder(env) {
  const { output } = await run('cargo', ['metadata', '--no-deps', '--format-version=1', '--quiet'], { env, cwd: root });
  return /** @type {string} */ (JSON.parse(output.slice(output.indexOf('{'))).target_directory);
}

/** @param {string} file */
async function checkSize(file) {
  const bytes = await readFile(file);
  const gzipped = gzipSync(bytes, { level: 9 }).length;
  console.log(`${(bytes.length / 1000).toFixed(1)} kB of wasm, ${(gzipped / 1000).toFixed(1)} kB gzipped`);
  if (gzipped > limit) {
    throw new Problem(`The wasm is ${gzipped} bytes gzipped and may be ${limit}: look at what was added to it.`);
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
