/** The Rust that is there. */
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { native } from '../util/env.mjs';
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { run } from '../util/process.mjs';

/** Fails unless there is a cargo and a rustc that is new enough for this crate. */
export async function rust() {
  const manifest = await readFile(join(root, 'Cargo.toml'), 'utf8');
  const needed = /^rust-version = "(.*)"$/m.exec(manifest)?.[1] ?? '0';
  const [rustc, cargo] = await Promise.all(
    ['rustc', 'cargo'].map((name) => run(name, ['--version'], { env: native, cwd: root, limit: 600 })));
  if (!rustc.ok || !cargo.ok) {
    throw new Problem(`Rust ${needed} or newer is needed and rustc or cargo does not run: `
      + 'install it as https://rust-lang.org/tools/install says.');
  }
  const found = /^rustc (\d+\.\d+)/m.exec(rustc.output)?.[1] ?? '0';
  if (minor(found) < minor(needed)) {
    throw new Problem(`Rust ${needed} or newer is needed and this is ${found}: run \`rustup update stable\`.`);
  }
}

/** @param {string} version */
const minor = (version) => Number(version.split('.')[1] ?? 0);
