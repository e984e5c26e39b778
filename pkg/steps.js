/** A solve in the wasm that runs in steps. */
import { DevelopableError } from './errors.js';
import { show } from './values.js';

/**
 * Milliseconds of work to ask the wasm for at once. Little, because iterations suddenly cost
 * several times as much when the solver goes on to a finer lattice.
 */
const SLICE = 4;

/**
 * What the solvers of the wasm files have in common.
 * @typedef {{ advance(work: number): boolean, progress(): any, cancel(): void, free(): void }} Handle
 */

/** @template {Handle} H */
export class Steps {
  /** @type {H | undefined} */
  #handle;
  #instance;
  /** Conjugate-gradient iterations to ask for in one call, from how long the last ones took. */
  #work = 1;

  /**
   * @param {import('./instance.js').Instance<any>} instance
   * @param {H} handle
   */
  constructor(instance, handle) {
    this.#instance = instance;
    this.#handle = handle;
  }

  /** Begins to measure anew. */
  restarted() {
    this.#work = 1;
  }

  /** @param {number} milliseconds */
  advance(milliseconds) {
    const handle = this.live();
    if (typeof milliseconds !== 'number' || Number.isNaN(milliseconds)) {
      throw new DevelopableError('INPUT', `the milliseconds must be a number, but are ${show(milliseconds)}`);
    }
    const end = performance.now() + milliseconds;
    for (;;) {
      const start = performance.now();
      if (!this.#instance.call(() => handle.advance(this.#work))) return false;
      const now = performance.now();
      // Clocks are coarse, so at most twice as much as before.
      const each = (now - start) / this.#work;
      this.#work = Math.max(1, Math.floor(Math.min(2 * this.#work, SLICE / each)));
      // Rather half a slice too early than half of one too late.
      if (now + (each * this.#work) / 2 >= end) return true;
    }
  }

  progress() {
    const handle = this.live();
    return this.#instance.call(() => handle.progress());
  }

  cancel() {
    const handle = this.live();
    this.#instance.call(() => handle.cancel());
  }

  get disposed() {
    return this.#handle === undefined;
  }

  dispose() {
    const handle = this.#handle;
    this.#handle = undefined;
    // After a trap there is nothing left that could be freed in an orderly way.
    if (this.#instance.alive) handle?.free();
  }

  live() {
    if (this.#handle === undefined) {
      throw new DevelopableError('DISPOSED', 'this solver has been disposed');
    }
    return this.#handle;
  }
}
