/** A Rust that builds for wasm32-unknown-unknown: the one that is there, rustup's, or Debian's. */
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { wasm, withPath, without } from '../util/env.mjs';
import { inTemporaryFolder } from '../util/folders.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';
import { which } from '../util/which.mjs';
import { aptUpdate, isDebian } from './apt.mjs';
import { cached, entry } from './cached.mjs';
import { quietly, task } from './task.mjs';

/** @typedef {import('../util/process.mjs').Env} Env */

export const target = 'wasm32-unknown-unknown';

/** Raise the number when the script changes what it makes. */
const fallback = 'debian-rust-1';

const advice = `run \`rustup target add ${target}\` where rustup can download, `
  + 'or install the package with which your system adds this target to its Rust.';

/**
 * The environment in which cargo builds for wasm32.
 * @returns {Promise<Env>}
 */
export async function wasmTarget() {
  if (await links(wasm)) return wasm;
  const private_ = fallbackEnv(entry(fallback));
  if (await links(private_)) return private_;
  if (which('rustup') && await rustupAdds() && await links(wasm)) return wasm;
  if (!isDebian) throw new Problem(`Rust cannot build for ${target} here: ${advice}`);
  await build();
  if (await links(private_)) return private_;
  throw new Problem(`The toolchain in ${entry(fallback)} does not work: delete that folder and try again.`);
}

/**
 * The real test: a small library that uses std gets linked.
 * @param {Env} env
 */
const links = (env) => inTemporaryFolder(async (folder) => {
  const source = join(folder, 'probe.rs');
  await writeFile(source, '#[unsafe(no_mangle)] pub extern "C" fn f(n: usize) -> usize { vec![n; n].len() }');
  const args = ['--edition=2024', '--target', target, '--crate-type', 'cdylib', '-O', source];
  const { ok } = await run('rustc', [...args, '-o', join(folder, 'probe.wasm')], { env, cwd: root, limit: 600 });
  return ok;
});

/**
 * @param {string} folder
 * @returns {Env}
 */
function fallbackEnv(folder) {
  // Cargo asks these before it looks for rustc on the path.
  const env = without(wasm, 'RUSTC', 'RUSTDOC', 'CARGO_BUILD_RUSTC', 'RUSTUP_TOOLCHAIN');
  return withPath(env, join(folder, 'bin'));
}

async function rustupAdds() {
  return task(`Rust's ${target} target, by rustup`, 'about 20 s, given up after 5 minutes', async () => {
    const { ok, failure } = await quietly('rustup', 'rustup', ['target', 'add', target], { cwd: root, limit: 300 });
    if (!ok) console.log(`  rustup could not add it (${failure})`);
    return ok;
  });
}

async function build() {
  const what = `a Rust of its own for ${target}, from Debian's packages (150 MB), in the cache`;
  await task(what, 'about 3 minutes', async () => {
    await aptUpdate();
    await cached(fallback, async (folder) => {
      const script = fileURLToPath(new URL('debian-rust.sh', import.meta.url));
      const { ok, output, failure } = await quietly('debian-rust', 'bash', [script, folder], { limit: 1800 });
      if (ok) return;
      const reason = /^debian-rust: (.*)$/m.exec(output)?.[1] ?? 'it stopped early';
      throw new Problem(`Neither rustup nor Debian's packages gave a Rust for ${target} (${reason}; ${failure}): ${advice}`);
    });
  });
}
