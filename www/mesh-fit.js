/** The fit of a whole mesh, and analyses of the result. */
import { Tasks } from './worker-task.js';
import { Events } from './events.js';
import { withoutFaces } from './pattern.js';
import { sidesOf } from './surface/triangles.js';

/** @typedef {(progress: import('./panels/waiting.js').TaskProgress) => void} Tell gets how far a step is */

/** Number of rulings along the longest side of the mesh, which sets their separation. */
const RULINGS_PER_LONGEST_SIDE = 30;

/**
 * @typedef {object} MeshFitEvents
 * @property {Mesh} start a solve has begun
 * @property {Progress} progress
 * @property {MeshSurface} result
 * @property {boolean} cancelled a solve was cancelled; whether there is a result from before
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
  /** The result of the same mesh before the present solve, and its λ. @type {{ surface: MeshSurface, lambda: number | 'auto' } | null} */
  #previous = null;
  /** Identity of the newest solve; results of older solves are discarded. @type {object | null} */
  #newestSolve = null;
  #tasks;

  /** @param {Api} api */
  constructor(api) {
    super();
    this.#tasks = new Tasks(api.DevelopableWorker);
  }

  /** Fits a mesh, and cancels the solve before. @param {Mesh} mesh @param {number | 'auto'} lambda */
  async solve(mesh, lambda) {
    this.stop();
    const solve = (this.#newestSolve = {});
    if (this.mesh !== mesh) this.#previous = null;
    else if (this.surface) this.#previous = { surface: this.surface, lambda: this.lambda };
    this.mesh = mesh;
    this.lambda = lambda;
    this.surface = null;
    this.emit('start', mesh);
    try {
      const surface = await this.#tasks.run((worker) => worker.fitMesh(mesh, {
        lambda,
        onProgress: (progress) => {
          if (this.#newestSolve === solve) this.emit('progress', progress);
        },
      }));
      if (this.#newestSolve !== solve) return;
      this.surface = surface;
      this.emit('result', surface);
    } catch (error) {
      if (this.#newestSolve === solve) this.emit('failure', error);
    }
  }

  /** Cancels the solve, and restores the result before it. */
  cancel() {
    this.stop();
    if (!this.surface && this.#previous) {
      Object.assign(this, this.#previous);
      this.emit('result', this.#previous.surface);
    }
    this.emit('cancelled', this.surface !== null);
  }

  /** Cancels all running tasks; their promises reject. */
  stop() {
    this.#newestSolve = null;
    this.#tasks.stop();
  }

  /** Closes the mesh and discards its result. */
  leave() {
    this.stop();
    if (!this.mesh) return;
    this.mesh = this.surface = null;
    this.emit('left', null);
  }

  /** @param {Mesh} mesh */
  curvatures(mesh) {
    return this.#tasks.answer(mesh, 'curvatures', (worker) => worker.analyze(geometryOf(mesh)));
  }

  /** @param {Mesh} mesh */
  rulings(mesh) {
    return this.#tasks.answer(mesh, 'rulings', (worker) => worker.rulings(geometryOf(mesh), { separation: Math.max(...sidesOf(mesh.positions)) / RULINGS_PER_LONGEST_SIDE }));
  }

  /** @param {Mesh} mesh */
  patches(mesh) {
    return this.#tasks.answer(mesh, 'patches', (worker) => worker.patches(geometryOf(mesh)));
  }

  /** @param {MeshSurface} surface @param {Tell} tell */
  async unrolled(surface, tell) {
    const { laidFlat, smooth } = await this.#laidFlat(surface);
    return this.#tasks.answer(laidFlat, 'unrolled', (worker) => worker.unroll(geometryOf(laidFlat), { ...smooth, onProgress: ({ fraction }) => tell({ fraction, task: 'unrolling' }) }));
  }

  /** The mesh that is laid flat: the fitted surface, or the input where its faces are known, which is more exact than a fit. @param {MeshSurface} surface */
  async #laidFlat(surface) {
    const { kind, thickness } = await this.recognized(this.mesh ?? surface);
    const isKnown = kind === 'noisyFaces' || ((kind === 'faces' || kind === 'bends') && this.lambda === 'auto');
    const smooth = isKnown || surface.report.stopReason === 'noNoise' ? {} : { exact: false };
    return { laidFlat: isKnown ? (this.mesh ?? surface) : surface, isKnown, kind, thickness, smooth };
  }

  /** Tells what kind of mesh it is, and how thick a solid of sheet metal. @param {Mesh} mesh */
  recognized(mesh) {
    return this.#tasks.answer(mesh, 'kind', (worker) => worker.recognizeMesh(geometryOf(mesh)));
  }

  /** @param {MeshSurface} surface @param {import('../pkg/types.js').MeshPatternOptions} options @param {Tell} tell */
  async pattern(surface, options, tell) {
    const cut = (/** @type {Mesh} */ laidFlat, /** @type {import('../pkg/types.js').MeshPatternOptions} */ wanted) =>
      this.#tasks.answer(laidFlat, `pattern ${JSON.stringify(options)}`, (worker) => worker.pattern(wanted.printed ? laidFlat : geometryOf(laidFlat), { ...wanted, onProgress: tell }));
    if (options.faces) return cut(this.mesh ?? surface, options);
    const { laidFlat, isKnown, kind, thickness, smooth } = await this.#laidFlat(surface);
    // A solid of sheet metal has a thickness of its own.
    const { thickness: sheetThickness, innerRadius, ...others } = isKnown && kind !== 'bends' ? options : withoutFaces(options);
    const own = sheetThickness === undefined ? others : thickness === undefined ? { ...others, thickness: sheetThickness, innerRadius } : { ...others, blank: true };
    // Card shows what the model looks like.
    const printed = kind === 'faces' && laidFlat.textures !== undefined && options.thickness === undefined;
    return cut(laidFlat, { ...own, ...smooth, printed });
  }
}

/** The geometry of a mesh, without its texture. @param {Mesh} mesh */
const geometryOf = ({ positions, triangles, unit }) => ({ positions, triangles, unit });
