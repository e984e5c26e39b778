/** Environments for the programs that are run. */
import { delimiter } from 'node:path';

/** @typedef {import('./process.mjs').Env} Env */

/**
 * A copy with folders put first on the search path (whose name has many spellings on Windows).
 * @param {Env} env
 * @param {...string} folders
 * @returns {Env}
 */
export function withPath(env, ...folders) {
  const name = Object.keys(env).find((key) => key.toUpperCase() === 'PATH') ?? 'PATH';
  return { ...env, [name]: [...folders, env[name] ?? ''].join(delimiter) };
}

/**
 * A copy without some variables, each given by its name or the pattern of its names.
 * @param {Env} env
 * @param {...(string | RegExp)} names
 * @returns {Env}
 */
export function without(env, ...names) {
  /** @param {string} key */
  const dropped = (key) => names.some((name) => (typeof name === 'string' ? name === key : name.test(key)));
  return Object.fromEntries(Object.entries(env).filter(([key]) => !dropped(key)));
}

/** For cargo on this machine's own target: a caller's choice of another target must not get in. */
export const native = without(process.env, 'CARGO_BUILD_TARGET');

/** For wasm: flags meant for this machine's processor or linker must not get in either. */
export const wasm = without(native, 'RUSTFLAGS', 'CARGO_ENCODED_RUSTFLAGS', /^WASM_BINDGEN_/);
