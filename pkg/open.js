/** A solver that stays in the worker, from the client's side. Documented in `index.d.ts`. */
import { handedOver } from './calls.js';
import { controlOf } from './control.js';
import { DevelopableError } from './errors.js';
import { asInput } from './input.js';
import { makeDisposable } from './platform.js';
import { orAborted, solve } from './solve.js';

/**
 * @typedef {import('./index.js').OpenSolver} OpenSolverApi
 * @typedef {import('./types.js').Progress} Progress
 */

/** One call of `fit`, which a newer one can end before its time. */
class Turn {
  /** @type {DevelopableError | undefined} */
  error;
  /** Stops the solve, once there is one. */
  abandon = () => {};
  #reject = (/** @type {DevelopableError} */ _) => {};
  /** @type {Promise<never>} */
  ended = new Promise((_, reject) => (this.#reject = reject));

  /** @param {DevelopableError} error */
  end(error) {
    this.error = error;
    this.abandon();
    this.#reject(error);
  }
}

/** @implements {Omit<OpenSolverApi, typeof Symbol.dispose>} */
export class OpenSolver {
  #connection;
  #id;
  #disposed = false;
  /** @type {Turn | undefined} the call of `fit` under way */
  #turn;

  /**
   * @param {import('./connection.js').Connection} connection
   * @param {number} id the solver's number in the worker
   */
  constructor(connection, id) {
    this.#connection = connection;
    this.#id = id;
  }

  /** @param {import('./index.js').OpenFitOptions} [given] */
  async fit(given) {
    const { control, options } = controlOf('openFit', given);
    if (!control.keep) control.signal?.throwIfAborted();
    const connection = this.#live();
    this.#turn?.end(new DevelopableError('REPLACED', 'a newer call of fit took the place of this one'));

    const turn = new Turn();
    this.#turn = turn;
    const { onProgress } = control;
    const told = onProgress && ((/** @type {Progress} */ progress) => turn.error ?? onProgress(progress));
    const surface = connection.request(async (remote) => {
      if (turn.error) throw turn.error;
      return solve(
        remote,
        (id, interval) => {
          turn.abandon = () => void remote.stop(id, false).catch(() => {});
          return remote.startOpen(this.#id, id, options, interval);
        },
        { ...control, onProgress: told },
      );
    });
    try {
      return await orAborted(Promise.race([surface, turn.ended]), control);
    } finally {
      if (this.#turn === turn) this.#turn = undefined;
    }
  }

  /**
   * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
   * @param {import('./index.js').HandOver} [options]
   */
  async replace(input, options) {
    const sent = handedOver(asInput(input), options);
    return this.#live().request((remote) => remote.replace(this.#id, sent));
  }

  get disposed() {
    return this.#disposed;
  }

  dispose() {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#turn?.end(new DevelopableError('DISPOSED', 'this solver has been disposed'));
    if (this.#connection.open) this.#connection.request((remote) => remote.close(this.#id)).catch(() => {});
  }

  #live() {
    if (this.#disposed) throw new DevelopableError('DISPOSED', 'this solver has been disposed');
    const { end } = this.#connection;
    if (end?.code === 'DISPOSED') throw end;
    if (end) {
      throw new DevelopableError(
        'WORKER',
        `the worker that held this solver has ended; open its input again (${end.message})`,
        { cause: end },
      );
    }
    return this.#connection;
  }
}
makeDisposable(OpenSolver);
