/** Cargo's own checks. */
import { native } from '../util/env.mjs';
import { run } from '../util/process.mjs';
import { Skip, check } from './step.mjs';

/** @typedef {import('./step.mjs').Env} Env */

export async function format() {
  await component('fmt', 'rustfmt', native);
  await check('cargo', ['fmt', '--all', '--check'], native);
  // A crate of its own; all else about it is left to `npm run bench`, for it takes minutes to compile.
  await check('cargo', ['fmt', '--check', '--manifest-path', 'benches/Cargo.toml'], native);
}

export async function lint() {
  await component('clippy', 'clippy', native);
  // The wasm's crates as well: what is checked for this machine need not be checked for wasm32 once more.
  const all = ['--workspace', '--exclude', 'developable-bindgen', '--all-targets'];
  await check('cargo', ['clippy', ...all, '--', '-D', 'warnings'], native);
}

/** All at once, and not the next time's changes: a third less work than in pieces with lines for a backtrace (`benches/tests.md`). */
const whole = { ...native, CARGO_INCREMENTAL: '0', CARGO_PROFILE_DEV_DEBUG: '0' };

/** The tests beside the code, and those of the whole library, which are compiled with it. */
export async function rustTests() {
  const { ok } = await run('cargo', ['nextest', '--version'], { env: native });
  // It names the tests that are slow.
  const program = ok ? ['nextest', 'run', '--config-file', 'tools/test/nextest.toml'] : ['test'];
  await check('cargo', [...program, '--lib', '--config', 'profile.test.package.developable.codegen-units=2'], whole);
}

/** Without optimisation: they are small, and no other step needs the library by itself. */
export async function docTests() {
  await check('cargo', ['test', '--doc', '--profile', 'dev'], whole);
}

export async function docs() {
  await check('cargo', ['doc', '--no-deps'], { ...native, RUSTDOCFLAGS: '-D warnings' });
}

/**
 * Not every Rust comes with these two.
 * @param {string} command
 * @param {string} name
 * @param {Env} env
 */
async function component(command, name, env) {
  const { ok } = await run('cargo', [command, '--version'], { env });
  if (!ok) throw new Skip(`${name} is not installed (\`rustup component add ${name}\` gets it)`);
}
