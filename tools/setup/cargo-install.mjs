/** Programs that cargo installs, in the cache. */
import { existsSync } from 'node:fs';
import { rm } from 'node:fs/promises';
import { join } from 'node:path';
import { native } from '../util/env.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { cached, entry } from './cached.mjs';
import { quietly, task } from './task.mjs';

/** They run for seconds: better quickly built than quick. */
const env = {
  ...native,
  CARGO_PROFILE_RELEASE_OPT_LEVEL: '0',
  CARGO_PROFILE_RELEASE_DEBUG: '0',
  CARGO_PROFILE_RELEASE_LTO: 'off',
  CARGO_PROFILE_RELEASE_CODEGEN_UNITS: '16',
  // Dependencies that need a newer Rust than there is are passed over for older ones.
  CARGO_RESOLVER_INCOMPATIBLE_RUST_VERSIONS: 'fallback',
};

/**
 * The folder of a crate's programs.
 * @param {string} crate
 * @param {string} version
 * @param {{ time: string, source: string[], what?: string }} options `source`: what `cargo install` is told
 */
export async function cargoInstall(crate, version, { time, source, what = `${crate} ${version}` }) {
  const name = `${crate}-${version}`;
  if (existsSync(entry(name))) return join(entry(name), 'bin');
  const folder = await task(`${what}, built by cargo install, in the cache`, time, () =>
    cached(name, async (draft) => {
      const where = ['--root', draft, '--target-dir', join(draft, 'target')];
      const args = ['install', ...source, ...where];
      const { ok, output, failure } = await quietly(crate, 'cargo', args, { env, cwd: root, limit: 3600 });
      if (!ok && /linker .* not found/.test(output)) {
        throw new Problem('Rust finds no linker here: install a C compiler (on Debian `apt-get install build-essential`).');
      }
      if (!ok) {
        throw new Problem(`cargo could not build ${crate} ${version} (${failure}): `
          + `see that cargo's registry can be reached, or put ${crate} ${version} on the PATH yourself.`);
      }
      await rm(join(draft, 'target'), { recursive: true, force: true });
    }));
  return join(folder, 'bin');
}
