/** The part of the options that is the caller's side of a solve, not the solver's. */
import { optionsOf } from './options.js';

/**
 * @typedef {import('./types.js').Progress} Progress
 * @typedef {object} Control
 * @property {AbortSignal} [signal]
 * @property {boolean} keep whether an abort is to give the best surface so far
 * @property {(progress: Progress) => unknown} [onProgress] awaited, if it gives a promise
 */

/**
 * Splits the options of a solve into those for its control and those for the solver.
 * @param {'fit' | 'openFit' | 'fitMesh'} call
 * @param {import('./index.js').FitOptions | import('./index.js').FitMeshOptions} [options]
 * @returns {{ control: Control, options: import('./types.js').SolverOptions & { transfer?: boolean } }}
 */
export function controlOf(call, options) {
  const { signal, onAbort, onProgress, ...rest } = optionsOf(call, options);
  return { control: { signal, keep: onAbort === 'keep', onProgress }, options: rest };
}
