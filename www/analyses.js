/**
 * Analyses of a result: curvatures, patches, rulings, unrolling, patterns and dewarping. Each is computed once.
 *
 * They run in a worker of their own, in parallel to the next run. Disposing of the worker cancels those that are no
 * longer needed.
 */

import { TASK_WORDS } from './messages.js';
import { downsample } from './surface/downsampling.js';
import { resultImage } from './surface/derived-data.js';
import { gridOf } from './surface/lattice.js';
import { MAX_SHEET_CURVATURE_RADIANS } from './surface/gaussian-curvature.js';
import { transferToWorker, callWorker } from './surface/worker-client.js';
import { AnswerCache } from './worker-task.js';
import { heightsOf } from './session.js';

/** @import {Api, Surface} from './api.js' */
/** @import {Result} from './session.js' */

/** @import {Tell} from './mesh-fit.js' */
/** @typedef {import('../pkg/types.js').Analysis} Analysis */
/** @typedef {ReturnType<typeof import('./surface/gaussian-curvature.js').curvaturesOf>} Curvatures */
/** @typedef {import('../pkg/types.js').Drawing} Drawing */
/** @typedef {import('../pkg/types.js').PatternOptions} PatternOptions */
/** @typedef {import('../pkg/types.js').Photo} Photo */
/** @typedef {InstanceType<Api['DevelopableWorker']>} Worker */
/**
 * @typedef {object} FlatOptions
 * @property {boolean} trim
 */

/** Longer side of the lattice of an unfolding in one piece, in pixels. */
const UNFOLDING_SIDE_PIXELS = 90;
/** Longer side of the lattice of an unfolding in sheets, in pixels. */
const SHEETS_UNFOLDING_SIDE_PIXELS = 120;
/** Longer side of the surface that is unfolded in sheets, in millimetres. The pattern's gap between sheets is small only for a large surface. */
const SHEETS_UNFOLDING_SIDE_MM = 300;
/** Longer side of the lattice that is cut into sheets, in pixels: a pixel is half a millimetre for a piece of 20 cm. */
const PATTERN_SIDE_PIXELS = 450;
/** Largest ratio of a lattice's longer side to `PATTERN_SIDE_PIXELS` for which the lattice is not reduced. */
const MAX_UNREDUCED_RATIO = 1.2;

/** Idle time after which the worker is disposed of, in milliseconds. */
const WORKER_IDLE_MS = 2000;

export class Analyses {
  #api;
  /** @type {Worker | null} */
  #worker = null;
  /** Number of running tasks. */
  #runningTasks = 0;
  /** Timer that disposes of the idle worker. */
  #idleTimer = 0;
  #cache = new AnswerCache();

  /** @param {Api} api */
  constructor(api) {
    this.#api = api;
  }

  /**
   * @template T
   * @param {(worker: Worker) => Promise<T>} task
   */
  async #runTask(task) {
    clearTimeout(this.#idleTimer);
    const worker = (this.#worker ??= new this.#api.DevelopableWorker());
    this.#runningTasks++;
    try {
      return await task(worker);
    } finally {
      if (worker === this.#worker && --this.#runningTasks === 0) this.#disposeWhenIdle();
    }
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
    return this.#cache.answer(subject, question, () => this.#runTask(task));
  }

  /** Disposes of the worker, and frees its memory, after it has been idle for a while. */
  #disposeWhenIdle() {
    this.#idleTimer = window.setTimeout(() => {
      this.#worker?.dispose();
      this.#worker = null;
    }, WORKER_IDLE_MS);
  }

  /** Cancels all running tasks; their promises reject. */
  stop() {
    if (this.#runningTasks === 0) return;
    this.#worker?.dispose();
    this.#worker = null;
    this.#runningTasks = 0;
  }

  /**
   * Curvatures of the input and of the result, on the same lattice; those of a design's input are null.
   * @param {Result} result
   * @returns {Promise<{ before: Curvatures | null, after: Curvatures }>}
   */
  async curvatures({ input, surface }) {
    const { spacing } = surface;
    const [before, after] = await Promise.all([
      input.design ? null : this.#cached(input, `curvatures ${spacing}`, (worker) =>
        worker.analyze(heightsOf(input), input.lattice ? {} : { spacing }).then(shownCurvatures)),
      this.curvature(surface),
    ]);
    return { before, after };
  }

  /** @param {Surface} surface */
  curvature(surface) {
    return this.#cached(surface, 'curvatures', (worker) => worker.analyze(surface).then(shownCurvatures));
  }

  /** @param {Result} result */
  patches({ surface }) {
    return this.#cached(surface, 'patches', (worker) => worker.patches(surface));
  }

  /**
   * The number of smooth patches, infinite if the surface is creased all over, and the number of creases between them.
   * @param {Result} result
   */
  async patchCount(result) {
    const [map, { gaussian }] = await Promise.all([this.patches(result), this.curvature(result.surface)]);
    return { count: await smoothPatchCount(map, { gaussian }), creases: map.creases.length };
  }

  /** @param {Result} result */
  rulings({ surface }) {
    return this.#cached(surface, 'rulings', (worker) => worker.rulings(surface));
  }

  /**
   * A picture of the unrolled sheet, and its figures. The mesh of the sheet is not kept, because it is large.
   * @param {Result} result
   * @param {Tell} tell
   */
  unroll({ surface }, tell) {
    return this.#cached(surface, 'sheet', async (worker) => {
      const { triangles, places, stretches, report, verdict } = await worker.unroll(surface, { onProgress: ({ fraction }) => tell({ fraction, label: TASK_WORDS.unrolling }) });
      const picture = await transferToWorker('sheetStrainImage', [triangles, places, stretches], triangles, places, stretches);
      return { picture, report, verdict };
    });
  }

  /**
   * An animation of the surface that is unrolled, on a coarser lattice.
   * @param {Result} result
   * @param {number} maxStrain strain at the end of the colour scale
   */
  unfold(result, maxStrain) {
    return this.#cached(result.surface, 'unfolding', async (worker) => {
      const small = reducedImage(result, UNFOLDING_SIDE_PIXELS);
      return callWorker('computeUnfolding', await worker.unroll(small), maxStrain, lowerLeftCorner(result, small));
    });
  }

  /**
   * An animation of the surface that is cut into sheets and laid flat, on a coarser lattice.
   * @param {Result} result
   * @param {number} maxStrain strain limit of the sheets
   * @param {number} maxShownStrain strain at the end of the colour scale
   */
  unfoldInSheets(result, maxStrain, maxShownStrain) {
    return this.#cached(result.surface, `unfolding in sheets ${maxStrain}`, async (worker) => {
      const small = reducedImage(result, SHEETS_UNFOLDING_SIDE_PIXELS);
      const scale = SHEETS_UNFOLDING_SIDE_MM / (Math.max(small.width, small.height) * small.pixelSize);
      const { assembly } = await worker.pattern(small, { scale, maxStrain, assembly: true });
      if (!assembly) throw new Error('nothing is said of how it is put together');
      return callWorker('computeUnfoldingInPieces', assembly.model, scale / 1000, maxShownStrain, lowerLeftCorner(result, small));
    });
  }

  /**
   * A pattern of the surface; a large surface is reduced to a coarser lattice first.
   * @param {Result} result
   * @param {PatternOptions} options
   * @param {Tell} tell
   */
  pattern(result, options, tell) {
    const { surface } = result;
    const source = this.isUnreducedInPattern(result) ? surface : reducedImage(result, PATTERN_SIDE_PIXELS);
    return this.#cached(surface, `pattern ${JSON.stringify(options)}`, (worker) => worker.pattern(source, { ...options, onProgress: ({ fraction }) => tell({ fraction, label: TASK_WORDS.cutting }) }));
  }

  /** Whether a pattern is made from the result's own lattice. @param {Result} result */
  isUnreducedInPattern(result) {
    const { width, height } = resultImage(result);
    return Math.max(width, height) < MAX_UNREDUCED_RATIO * PATTERN_SIDE_PIXELS;
  }

  /** @param {Drawing} drawing */
  svg(drawing) {
    return this.#cached(drawing, 'svg', (worker) => worker.writeSvg(drawing));
  }

  /**
   * The photo made flat by the surface, or by a cylinder if the heights are those of one.
   * @param {Result} result
   * @param {Photo} photo
   * @param {FlatOptions} options
   */
  dewarp(result, photo, options) {
    const { surface } = result;
    return this.#cached(surface, `dewarp ${photoId(photo)} ${JSON.stringify(options)}`, async (worker) => {
      const cylinder = await this.#cylinder(result);
      return { ...await worker.dewarp(cylinder ?? surface, photo, { ...options, map: false, grid: true }), parallel: cylinder !== undefined };
    });
  }

  /**
   * The cylinder that fits the heights of a lattice, or undefined if they are not those of a cylinder, or if the
   * settings ask for another surface.
   * @param {Result} result
   */
  #cylinder({ input: { lattice }, settings: { lambda, energy, occlusionThreshold }, surface }) {
    const hasDefaultSettings = lattice && lambda === 'auto' && (energy ?? 'huber') === 'huber' && occlusionThreshold === undefined;
    if (!hasDefaultSettings || lattice.constraints || lattice.occlusions || lattice.brokenEdges) return undefined;
    return this.#cached(surface, 'cylinder', async (worker) => {
      try {
        const found = await worker.fitCylinder(lattice);
        return found.report.verdict === 'cylinder' ? found : undefined;
      } catch (error) {
        if (error instanceof this.#api.DevelopableError && error.code === 'UNSUPPORTED') return undefined; // too small
        throw error;
      }
    });
  }
}

/**
 * The number of smooth patches; infinite if the surface is creased all over, so that no patch is smooth.
 * @param {import('../pkg/types.js').PatchMap} map
 * @param {{ gaussian: ArrayLike<number> }} curvature
 */
export async function smoothPatchCount({ rows, cols, labels, spacing, patches }, { gaussian }) {
  const roundness = await callWorker('totalGaussianCurvature', { rows, cols, labels, spacing }, { gaussian });
  return roundness < MAX_SHEET_CURVATURE_RADIANS ? patches.length : Infinity;
}

/** The curvatures of an analysis, for display. @param {Analysis} analysis */
function shownCurvatures(analysis) {
  const { gaussian, kappa1, kappa2 } = analysis;
  return transferToWorker('curvaturesOf', [gaussian, kappa1, kappa2], analysis);
}

/**
 * The image of a result, reduced to fewer pixels.
 * @param {Result} result
 * @param {number} side maximum number of pixels along the longer side
 */
function reducedImage(result, side) {
  const { width, pixelSize, ...image } = resultImage(result);
  const small = downsample({ width, ...image }, side);
  return { ...small, pixelSize: (pixelSize * width) / small.width };
}

/**
 * The lower left corner of an image in the coordinates of the surface.
 * @param {Result} result
 * @param {{ height: number, pixelSize: number }} small
 * @returns {[number, number]}
 */
function lowerLeftCorner({ input }, { height, pixelSize }) {
  const { left, top } = gridOf(input);
  return [left, top - height * pixelSize];
}

let lastPhotoId = 0;
/** @type {WeakMap<Photo, number>} */
const photoIds = new WeakMap();

/** An id of a photo, which makes it a part of a question in the cache. @param {Photo} photo */
function photoId(photo) {
  const id = photoIds.get(photo) ?? ++lastPhotoId;
  photoIds.set(photo, id);
  return id;
}
