/** The part of the options that is the caller's side of a solve, not the solver's. */
import { DevelopableError } from './errors.js';

/**
 * @typedef {import('./types.js').Progress} Progress
 * @typedef {object} Control
 * @property {AbortSignal} [signal]
 * @property {boolean} keep whether an abort is to give the best surface so far
 * @property {(progress: Progress) => void} [onProgress]
 */

/**
 * Options, or none; with a word of the package's own for anything else.
 * @template {object} T
 * @param {T | undefined} options
 * @returns {Partial<T>}
 */
export function asOptions(options) {
  if (options === undefined) return {};
  if (options === null || typeof options !== 'object') {
    throw new DevelopableError('OPTION', `the options must be an object, but are ${options}`);
  }
  return options;
}

/**
 * Splits the options of a solve into those for its control and those for the solver.
 * @param {import('./index.js').FitOptions} [options]
 * @returns {{ control: Control, options: import('./types.js').SolverOptions & { transfer?: boolean } }}
 */
export function controlOf(options) {
  const { signal, onAbort = 'reject', onProgress, ...rest } = asOptions(options);
  if (onAbort !== 'reject' && onAbort !== 'keep') {
    throw new DevelopableError('OPTION', "option `onAbort` must be 'reject' or 'keep'");
  }
  if (signal !== undefined && typeof Object(signal).throwIfAborted !== 'function') {
    throw new DevelopableError('OPTION', 'option `signal` must be an AbortSignal');
  }
  if (onProgress !== undefined && typeof onProgress !== 'function') {
    throw new DevelopableError('OPTION', 'option `onProgress` must be a function');
  }
  return { control: { signal, keep: onAbort === 'keep', onProgress }, options: rest };
}
