/**
 * The fit of a whole mesh, and analyses of the result. Each runs in a worker of its own, which is disposed of when it is
 * cancelled.
 */
import { AnswerCache, runInWorker } from './worker-task.js';
import { Events } from './events.js';
import { TASK_WORDS } from './messages.js';
import { boxOf } from './surface/triangles.js';

/** @import {Api, Mesh} from './api.js' */
/** @import {Worker} from './worker-task.js' */
/** @typedef {import('../pkg/types.js').MeshSurface} MeshSurface */
/** @typedef {import('../pkg/types.js').Progress} Progress */
/** @typedef {(progress: import('./panels/waiting.js').TaskProgress) => void} Tell gets how far a step is */

/** Number of rulings along the longest side of the mesh, which sets their separation. */
const RULINGS_PER_LONGEST_SIDE = 30;

/**
 * @typedef {object} MeshFitEvents
 * @property {Mesh} start a solve has begun
 * @property {Progress} progress
 * @property {MeshSurface} result
 * @property {unknown} failure error of a solve
 * @property {null} left the mesh was closed
 */

/** @extends {Events<MeshFitEvents>} */
export class MeshFit extends Events {
  /** @type {Mesh | null} */
  mesh = null;
  /** λ of the last solve. @type {number | 'auto'} */
  lambda = 'auto';
  /** The result; null during a solve. @type {MeshSurface | null} */
  surface = null;
  /** The result of the same mesh before the present solve. @type {MeshSurface | null} */
  #previousSurface = null;
  /** Identity of the newest solve; results of older solves are discarded. @type {object | null} */
  #newestSolve = null;
  /** Tasks that are running. @type {Set<AbortController>} */
  #runningTasks = new Set();
  #cache = new AnswerCache();

  /** @param {Api} api */
  constructor(api) {
    super();
    this.api = api;
  }

  /** Fits a mesh, and cancels the solve before. @param {Mesh} mesh @param {number | 'auto'} lambda */
  async solve(mesh, lambda) {
    this.stop();
    const solve = (this.#newestSolve = {});
    this.#previousSurface = this.mesh === mesh ? this.surface ?? this.#previousSurface : null;
    this.mesh = mesh;
    this.lambda = lambda;
    this.surface = null;
    this.emit('start', mesh);
    try {
      const surface = await this.#runTask((worker, signal) => worker.fitMesh(mesh, {
        lambda,
        onProgress: (progress) => {
          if (!signal.aborted) this.emit('progress', progress);
        },
      }));
      if (!surface || this.#newestSolve !== solve) return;
      this.surface = surface;
      this.emit('result', surface);
    } catch (error) {
      if (this.#newestSolve === solve) this.emit('failure', error);
    }
  }

  /** Restores the result before the solve that was stopped. @returns {boolean} whether there is a result now */
  restore() {
    if (!this.surface && this.#previousSurface) {
      this.surface = this.#previousSurface;
      this.emit('result', this.surface);
    }
    return this.surface !== null;
  }

  /** Cancels all running tasks; their promises reject. */
  stop() {
    for (const abort of this.#runningTasks) abort.abort();
    this.#runningTasks.clear();
  }

  /** Closes the mesh and discards its result. */
  leave() {
    this.stop();
    if (!this.mesh) return;
    this.#newestSolve = null;
    this.mesh = this.surface = null;
    this.emit('left', null);
  }

  /** @param {Mesh} mesh */
  curvatures(mesh) {
    return this.#cached(mesh, 'curvatures', (worker) => worker.analyzeMesh(geometryOf(mesh)));
  }

  /** @param {Mesh} mesh */
  rulings(mesh) {
    return this.#cached(mesh, 'rulings', (worker) => worker.meshRulings(geometryOf(mesh), { separation: longestSide(mesh) / RULINGS_PER_LONGEST_SIDE }));
  }

  /** @param {Mesh} mesh @param {Tell} tell */
  unrolled(mesh, tell) {
    return this.#cached(mesh, 'unrolled', (worker) => worker.unrollMesh(geometryOf(mesh), { onProgress: ({ fraction }) => tell({ fraction, label: TASK_WORDS.unrolling }) }));
  }

  /** Tells what kind of mesh it is, and how thick a solid of sheet metal. @param {Mesh} mesh */
  recognized(mesh) {
    return this.#cached(mesh, 'kind', (worker) => worker.recognizeMesh(geometryOf(mesh)));
  }

  /**
   * The sheets of the fitted surface, or of the input where flat faces are found in its noise: these are more exact than a fit.
   * @param {Mesh} surface
   * @param {import('../pkg/types.js').MeshPatternOptions} options
   * @param {Tell} tell
   */
  async pattern(surface, options, tell) {
    const mesh = this.mesh ?? surface;
    const { kind, thickness } = await this.recognized(mesh);
    const laidFlat = kind === 'noisyFaces' ? mesh : surface;
    // A solid of sheet metal has a thickness of its own.
    const { thickness: _thickness, innerRadius: _innerRadius, ...others } = options;
    const own = thickness !== undefined && options.thickness !== undefined ? { ...others, blank: true } : options;
    return this.#cached(laidFlat, `pattern ${JSON.stringify(options)}`, (worker) => worker.patternMesh(geometryOf(laidFlat), { ...own, onProgress: tell }));
  }

  /** @param {import('../pkg/types.js').Drawing} drawing */
  svg(drawing) {
    return this.#cached(drawing, 'svg', (worker) => worker.writeSvg(drawing));
  }

  /**
   * The cached answer to a question, or the answer of a new task.
   * @template T
   * @param {object} subject
   * @param {string} question
   * @param {(worker: Worker) => Promise<T>} task
   * @returns {Promise<T>}
   */
  #cached(subject, question, task) {
    return this.#cache.answer(subject, question, () =>
      this.#runTask(task).then((found) => found ?? Promise.reject(new Error('it was cancelled'))));
  }

  /**
   * @template T
   * @param {(worker: Worker, signal: AbortSignal) => Promise<T>} task
   * @returns {Promise<T | undefined>} undefined if it was cancelled
   */
  async #runTask(task) {
    const abort = new AbortController();
    this.#runningTasks.add(abort);
    try {
      return await runInWorker(this.api, abort.signal, (worker) => task(worker, abort.signal));
    } catch (error) {
      if (abort.signal.aborted) return undefined;
      throw error;
    } finally {
      this.#runningTasks.delete(abort);
    }
  }
}

/** The geometry of a mesh, without its texture. @param {Mesh} mesh */
function geometryOf({ positions, triangles, unit }) {
  return { positions, triangles, unit };
}

/** Sides of the bounding box of a mesh, along x, y and z. @param {Pick<Mesh, 'positions'>} mesh */
export function boundingBoxSides({ positions }) {
  const { low, high } = boxOf(positions);
  return high.map((value, k) => value - low[k]);
}

/** Longest side of the bounding box of a mesh. @param {Pick<Mesh, 'positions'>} mesh */
export function longestSide(mesh) {
  return Math.max(...boundingBoxSides(mesh));
}
