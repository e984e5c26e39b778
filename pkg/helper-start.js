/** What a helper needs to start in the solver's team, and the report of its end. */

/**
 * @typedef {object} HelperStart
 * @property {WebAssembly.Module} module
 * @property {WebAssembly.Memory} memory
 * @property {number} stack address of the top of the helper's stack
 * @property {number} jobs address of the number of jobs
 * @property {number} crashes address of the number of helpers that have crashed
 */

/**
 * Tells the solver, which may be waiting for a helper, that the helper has ended.
 * @param {HelperStart} start
 */
export function reportCrash({ memory, crashes }) {
  const words = new Int32Array(memory.buffer);
  Atomics.add(words, crashes / 4, 1);
  Atomics.notify(words, crashes / 4);
}
