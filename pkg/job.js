/** A solve that runs in batches and looks up in between. */
import { yieldToEventLoop } from './event-loop.js';
import { DevelopableError } from './errors.js';

/** Milliseconds of work in one batch: how long a message may have to wait. */
const BATCH = 25;

/**
 * @typedef {import('./direct.js').Solver | import('./direct.js').MeshSolver} Solver
 * @typedef {import('./types.js').Progress} Progress
 * @typedef {import('./types.js').Surface | import('./types.js').MeshSurface} Surface
 * @typedef {{ progress: Progress, surface?: Surface }} News with the surface once the solve is done
 */

/** Jobs of one thread take turns, a batch each. */
export class Job {
  /** @type {(() => Solver | Promise<Solver>) | undefined} */
  #begin;
  #release;
  #interval;
  #told = performance.now();
  /** @type {Solver | undefined} */
  #solver;
  /** @type {{ resolve: (news: News) => void, reject: (error: unknown) => void } | undefined} */
  #listener;
  /** @type {{ news: News } | { error: unknown } | undefined} */
  #outcome;
  /** Whether it is to end with the best surface so far. */
  #finishing = false;

  /**
   * @param {() => Solver | Promise<Solver>} begin sets the solver up; not called for a job that is dropped at once
   * @param {number} interval milliseconds between two pieces of news, at least
   * @param {(solver: Solver) => void} [release] what becomes of the solver when the job is done
   */
  constructor(begin, interval, release = (solver) => solver.dispose()) {
    this.#begin = begin;
    this.#interval = interval;
    this.#release = release;
    void this.#run();
  }

  /**
   * The latest progress as soon as it is due, or the outcome.
   * @returns {Promise<News>}
   */
  next() {
    return new Promise((resolve, reject) => {
      this.#listener = { resolve, reject };
      this.#tell();
    });
  }

  /** Finishes with the best surface so far. */
  finish() {
    this.#finishing = true;
    if (!this.#outcome) this.#solver?.cancel();
  }

  /**
   * Stops, and forgets what was done.
   * @param {DevelopableError} [error] what those get who wait for it
   */
  drop(error = new DevelopableError('DISPOSED', 'this solve was dropped')) {
    this.#outcome ??= { error };
    this.#end();
  }

  async #run() {
    try {
      // Not at once: it may be dropped before its turn comes.
      await yieldToEventLoop();
      const begin = this.#begin;
      this.#begin = undefined; // and with it what it holds on to
      if (this.#outcome || !begin) return;
      const solver = await begin();
      // It may have been dropped meanwhile.
      if (this.#outcome) return this.#release(solver);
      this.#solver = solver;
      if (this.#finishing) solver.cancel();
      await yieldToEventLoop();
      while (!this.#outcome && solver.advance(BATCH)) {
        this.#tell();
        await yieldToEventLoop();
      }
      this.#outcome ??= { news: { progress: solver.progress(), surface: solver.surface() } };
    } catch (error) {
      this.#outcome = { error };
    }
    this.#end();
  }

  /** Lets go of the solver, once, and says so. */
  #end() {
    const solver = this.#solver;
    this.#solver = undefined;
    if (solver) this.#release(solver);
    this.#tell();
  }

  #tell() {
    const listener = this.#listener;
    const outcome = this.#outcome;
    const now = performance.now();
    if (!listener || (!outcome && now - this.#told < this.#interval)) return;
    if (!outcome && !this.#solver) return;
    this.#listener = undefined;
    this.#told = now;
    if (!outcome) listener.resolve({ progress: /** @type {Solver} */ (this.#solver).progress() });
    else if ('news' in outcome) listener.resolve(outcome.news);
    else listener.reject(outcome.error);
  }
}
