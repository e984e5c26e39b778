/** A solve that runs in batches and looks up in between. */
import { breathe } from './breathe.js';
import { DevelopableError } from './errors.js';

/** Milliseconds of work in one batch: how long a message may have to wait. */
const BATCH = 25;

/**
 * @typedef {import('./types.js').Progress} Progress
 * @typedef {import('./types.js').Surface} Surface
 * @typedef {{ progress: Progress, surface?: Surface }} News with the surface once the solve is done
 */

/** Jobs of one thread take turns, a batch each. */
export class Job {
  #solver;
  #interval;
  #told = performance.now();
  /** @type {{ resolve: (news: News) => void, reject: (error: unknown) => void } | undefined} */
  #listener;
  /** @type {{ news: News } | { error: unknown } | undefined} */
  #outcome;

  /**
   * @param {import('./direct.js').Solver} solver disposed of when the job is done
   * @param {number} interval milliseconds between two pieces of news, at least
   */
  constructor(solver, interval) {
    this.#solver = solver;
    this.#interval = interval;
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
    if (!this.#outcome) this.#solver.cancel();
  }

  /** Stops, and forgets what was done. */
  drop() {
    this.#outcome ??= { error: new DevelopableError('DISPOSED', 'this solve was dropped') };
    this.#solver.dispose();
    this.#tell();
  }

  async #run() {
    const solver = this.#solver;
    try {
      do {
        this.#tell();
        await breathe();
      } while (!this.#outcome && solver.advance(BATCH));
      this.#outcome ??= { news: { progress: solver.progress(), surface: solver.surface() } };
    } catch (error) {
      this.#outcome = { error };
    }
    solver.dispose();
    this.#tell();
  }

  #tell() {
    const listener = this.#listener;
    const outcome = this.#outcome;
    const now = performance.now();
    if (!listener || (!outcome && now - this.#told < this.#interval)) return;
    this.#listener = undefined;
    this.#told = now;
    if (!outcome) listener.resolve({ progress: this.#solver.progress() });
    else if ('news' in outcome) listener.resolve(outcome.news);
    else listener.reject(outcome.error);
  }
}
