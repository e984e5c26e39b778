/** A solver that stays in the worker: cold the first time, warm from then on. */
import * as direct from './direct.js';
import { DevelopableError } from './errors.js';
import { Job } from './job.js';

/**
 * @typedef {import('./input.js').Image | import('./input.js').Lattice} Input
 * @typedef {import('./types.js').SolverOptions} SolverOptions
 */

export class WarmSolver {
  /** @type {Input | undefined} what to solve next; nothing means the same again */
  #input;
  /** @type {direct.Solver | undefined} */
  #solver;
  /** @type {Job | undefined} the last one */
  #job;
  #load;

  /** @param {Input} input @param {() => Promise<unknown>} load loads the wasm */
  constructor(input, load) {
    this.#input = input;
    this.#load = load;
  }

  /**
   * The input from the next solve on; one that is under way goes on.
   * @param {Input} input
   */
  replace(input) {
    this.#input = input;
  }

  /**
   * A solve that takes the place of the one under way.
   * @param {SolverOptions} options
   * @param {number} interval
   */
  start(options, interval) {
    this.#job?.drop(new DevelopableError('REPLACED', 'a newer solve took the place of this one'));
    this.#job = new Job(() => this.#begin(options), interval, () => {});
    return this.#job;
  }

  dispose() {
    this.#job?.drop(new DevelopableError('DISPOSED', 'this solver has been disposed'));
    this.#solver?.dispose();
  }

  /** @param {SolverOptions} options */
  async #begin(options) {
    await this.#load();
    const input = this.#input;
    if (!this.#solver) this.#solver = new direct.Solver(/** @type {Input} */ (input), options);
    else if (input) this.#solver.restartWith(input, options);
    else this.#solver.restart(options);
    // What is wrong with an input or an option can be put right: until then it waits.
    this.#input = undefined;
    return this.#solver;
  }
}
