/**
 * A mesh as it is, without a view: solved, and what is asked about the result. Each in a worker of its own, which ends
 * with what is given up.
 */
import { apart } from './worker-task.js';
import { Events } from './events.js';

/** @import {Api, Mesh} from './api.js' */
/** @import {Worker} from './worker-task.js' */
/** @typedef {import('../pkg/types.js').MeshSurface} MeshSurface */
/** @typedef {import('../pkg/types.js').Progress} Progress */

/** Of rulings as far apart as they are drawn, so many go along the longest side, however coarse the mesh. */
const RULINGS = 30;

/**
 * @typedef {object} WholeEvents
 * @property {Mesh} start it is being solved
 * @property {Progress} progress
 * @property {MeshSurface} result
 * @property {unknown} failure why there is none
 * @property {null} left nothing of it is wanted any more
 */

/** @extends {Events<WholeEvents>} */
export class Whole extends Events {
  /** @type {Mesh | null} */
  mesh = null;
  /** What it is solved with. @type {number | 'auto'} */
  lambda = 'auto';
  /** @type {MeshSurface | null} */
  surface = null;
  /** Of the same mesh, before the solve under way. @type {MeshSurface | null} */
  #before = null;
  /** The solve under way, or the last one. @type {object | null} */
  #turn = null;
  /** What is worked out now. @type {Set<AbortController>} */
  #open = new Set();
  /** Answers by their question. @type {WeakMap<object, Map<string, Promise<any>>>} */
  #known = new WeakMap();

  /** @param {Api} api */
  constructor(api) {
    super();
    this.api = api;
  }

  /** @param {Mesh} mesh @param {number | 'auto'} lambda */
  async solve(mesh, lambda) {
    this.stop();
    const turn = (this.#turn = {});
    this.#before = this.mesh === mesh ? this.surface ?? this.#before : null;
    this.mesh = mesh;
    this.lambda = lambda;
    this.surface = null;
    this.emit('start', mesh);
    try {
      const surface = await this.#apart((worker, signal) => worker.fitMesh(mesh, {
        lambda,
        onProgress: (progress) => {
          if (!signal.aborted) this.emit('progress', progress);
        },
      }));
      if (!surface || this.#turn !== turn) return;
      this.surface = surface;
      this.emit('result', surface);
    } catch (error) {
      if (this.#turn === turn) this.emit('failure', error);
    }
  }

  /** Takes the surface before the solve that was stopped. @returns {boolean} whether there is one */
  restore() {
    if (!this.surface && this.#before) {
      this.surface = this.#before;
      this.emit('result', this.surface);
    }
    return this.surface !== null;
  }

  /** Ends whatever is being worked out; those who wait for it are told so. */
  stop() {
    for (const abort of this.#open) abort.abort();
    this.#open.clear();
  }

  leave() {
    this.stop();
    if (!this.mesh) return;
    this.#turn = null;
    this.mesh = this.surface = null;
    this.emit('left', null);
  }

  /** @param {Mesh} mesh */
  curvatures(mesh) {
    return this.#once(mesh, 'curvatures', (worker) => worker.analyzeMesh(shapeOf(mesh)));
  }

  /** @param {Mesh} mesh */
  rulings(mesh) {
    return this.#once(mesh, 'rulings', (worker) => worker.meshRulings(shapeOf(mesh), { separation: longestSide(mesh) / RULINGS }));
  }

  /** @param {Mesh} mesh */
  unrolled(mesh) {
    return this.#once(mesh, 'unrolled', (worker) => worker.unrollMesh(shapeOf(mesh)));
  }

  /** @param {Mesh} mesh @param {import('../pkg/types.js').MeshPatternOptions} options */
  pattern(mesh, options) {
    return this.#once(mesh, `pattern ${JSON.stringify(options)}`, (worker) => worker.patternMesh(shapeOf(mesh), options));
  }

  /** @param {import('../pkg/types.js').Drawing} drawing */
  svg(drawing) {
    return this.#once(drawing, 'svg', (worker) => worker.writeSvg(drawing));
  }

  /**
   * @template T
   * @param {object} about
   * @param {string} question
   * @param {(worker: Worker) => Promise<T>} work
   * @returns {Promise<T>}
   */
  #once(about, question, work) {
    const answers = this.#known.get(about) ?? new Map();
    this.#known.set(about, answers);
    const answer = answers.get(question) ?? this.#apart(work).then((found) => found ?? Promise.reject(new Error('it was cancelled')));
    answers.set(question, answer);
    // What failed may be asked again.
    answer.catch(() => answers.delete(question));
    return answer;
  }

  /**
   * @template T
   * @param {(worker: Worker, signal: AbortSignal) => Promise<T>} work
   * @returns {Promise<T | undefined>} nothing where it was given up
   */
  async #apart(work) {
    const abort = new AbortController();
    this.#open.add(abort);
    try {
      return await apart(this.api, abort.signal, (worker) => work(worker, abort.signal));
    } catch (error) {
      if (abort.signal.aborted) return undefined;
      throw error;
    } finally {
      this.#open.delete(abort);
    }
  }
}

/** @param {Mesh} mesh */
function shapeOf({ positions, triangles, unit }) {
  return { positions, triangles, unit };
}

/** @param {Mesh} mesh */
export function longestSide({ positions }) {
  return Math.max(...[0, 1, 2].map((k) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = k; i < positions.length; i += 3) {
      low = Math.min(low, positions[i]);
      high = Math.max(high, positions[i]);
    }
    return high - low;
  }));
}
