/** Cargo's own checks. */
import { target } from '../setup/wasm-target.mjs';
import { native } from '../util/env.mjs';
import { run } from '../util/process.mjs';
import { Skip, check } from './step.mjs';

/** @typedef {import('./step.mjs').Context} Context */
/** @typedef {import('./step.mjs').Env} Env */

export async function format() {
  await component('fmt', 'rustfmt', native);
  await check('cargo', ['fmt', '--all', '--check'], native);
  // A crate of its own; all else about it is left to `npm run bench`, for it takes minutes to compile.
  await check('cargo', ['fmt', '--check', '--manifest-path', 'benches/Cargo.toml'], native);
}

export async function lint() {
  await component('clippy', 'clippy', native);
  await check('cargo', ['clippy', '--all-targets', '--', '-D', 'warnings'], native);
}

/** @param {Context} context */
export async function lintWasm({ env }) {
  await component('clippy', 'clippy', env);
  await check('cargo', ['clippy', '--workspace', '--exclude', 'developable-bindgen', '--lib', '--tests', '--target', target, '--', '-D', 'warnings'], env);
}

export async function nativeTests() {
  await check('cargo', ['test'], native);
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
