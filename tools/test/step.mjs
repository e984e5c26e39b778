/** What a test step is, and running programs in one. */
import { root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { succeed } from '../util/process.mjs';

/** @typedef {import('../util/process.mjs').Env} Env */

/**
 * @typedef {object} Context what the set-up has found
 * @property {Env} env for wasm
 * @property {string} bindgen the program that makes the package's JavaScript and types
 * @property {import('../setup/browser.mjs').Browser} browser
 */

/**
 * @typedef {object} Step
 * @property {string} name
 * @property {string} what
 * @property {number} seconds that it takes on two idle cores, about
 * @property {boolean} [quick] it is among the few of `npm test -- --quick`
 * @property {boolean} [beside] it runs beside the others, which leave a core idle while they compile a single crate, after the set-up and those
 *   before it that run so; others get no context
 * @property {(context: Context) => Promise<void>} run throws where something is wrong
 */

/** Something is missing on this machine without which a step cannot run. */
export class Skip extends Problem {}

/** A step that takes longer than this hangs. */
const limit = 45 * 60;

/**
 * Runs a program for all to see; gives what it printed.
 * @param {string} command
 * @param {readonly string[]} args
 * @param {Env} env
 */
export function check(command, args, env) {
  const colours = process.stdout.isTTY ? { CARGO_TERM_COLOR: 'always', FORCE_COLOR: '1' } : {};
  return succeed(command, args, { env: { ...env, ...colours }, cwd: root, show: true, limit });
}
