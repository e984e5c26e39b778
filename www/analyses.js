/**
 * What can be asked about a result, each question once.
 *
 * In a worker of its own: an answer may take seconds, and meanwhile the next run goes on. What is
 * no longer wanted is stopped with the worker.
 */

import { coarse } from './surface/coarse.js';
import { resultImage } from './surface/known.js';
import { gridOf } from './surface/lattice.js';
import { CREASED } from './surface/roundness.js';
import { handOver, work } from './surface/work.js';

/** @import {Api, Surface} from './api.js' */
/** @import {Input, Result} from './session.js' */

/** @typedef {import('../pkg/types.js').Analysis} Analysis */
/** @typedef {ReturnType<typeof import('./surface/roundness.js').curvaturesOf>} Curvatures */
/** @typedef {import('../pkg/types.js').Drawing} Drawing */
/** @typedef {import('../pkg/types.js').PatternOptions} PatternOptions */
/** @typedef {import('../pkg/types.js').Photo} Photo */
/** @typedef {InstanceType<Api['DevelopableWorker']>} Worker */
/**
 * @typedef {object} FlatOptions
 * @property {number} [dots]
 * @property {boolean} trim
 * @property {[number, number][]} [crop]
 */

/**
 * Pixels along the longer side of what is unfolded, whole and in pieces, and of what is cut into sheets: half a millimetre
 * of a piece of 20 cm.
 */
const [UNFOLDED, APART] = [90, 120];
/** The longer side of what is unfolded in pieces, in millimetres. */
const APART_SIDE = 300;
const CUT = 450;

/** Milliseconds without a question after which the worker goes. */
const REST = 2000;

export class Analyses {
  #api;
  /** @type {Worker | null} */
  #worker = null;
  /** Questions without an answer yet. */
  #open = 0;
  #resting = 0;
  /** @type {WeakMap<object, Map<string, Promise<any>>>} */
  #known = new WeakMap();

  /** @param {Api} api */
  constructor(api) {
    this.#api = api;
  }

  /**
   * @template T
   * @param {(worker: Worker) => Promise<T>} question
   */
  async #ask(question) {
    clearTimeout(this.#resting);
    const worker = (this.#worker ??= new this.#api.DevelopableWorker());
    this.#open++;
    try {
      return await question(worker);
    } finally {
      if (worker === this.#worker && --this.#open === 0) this.#rest();
    }
  }

  /**
   * @template T
   * @param {object} about
   * @param {string} name of the question
   * @param {(worker: Worker) => Promise<T>} question
   * @returns {Promise<T>}
   */
  #once(about, name, question) {
    const answers = this.#known.get(about) ?? new Map();
    this.#known.set(about, answers);
    const found = answers.get(name);
    if (found) return found;
    const answer = this.#ask(question);
    answers.set(name, answer);
    // What failed may be asked again.
    answer.catch(() => answers.delete(name));
    return answer;
  }

  /** Gives its memory back when nobody has asked for a while. */
  #rest() {
    this.#resting = window.setTimeout(() => {
      this.#worker?.dispose();
      this.#worker = null;
    }, REST);
  }

  /** Stops what is still being worked out; those who wait for it are told so. */
  stop() {
    if (this.#open === 0) return;
    this.#worker?.dispose();
    this.#worker = null;
    this.#open = 0;
  }

  /**
   * Curvatures before, on the same lattice, and after. Of a design there is no before.
   * @param {Result} result
   * @returns {Promise<{ before: Curvatures | null, after: Curvatures }>}
   */
  async curvatures({ input, surface }) {
    const { spacing } = surface;
    const [before, after] = await Promise.all([
      input.design ? null : this.#once(input, `curvatures ${spacing}`, (worker) =>
        worker.analyze(heightsAlone(input), input.lattice ? {} : { spacing }).then(shown)),
      this.curvature(surface),
    ]);
    return { before, after };
  }

  /** @param {Surface} surface */
  curvature(surface) {
    return this.#once(surface, 'curvatures', (worker) => worker.analyze(surface).then(shown));
  }

  /** @param {Result} result */
  patches({ surface }) {
    return this.#once(surface, 'patches', (worker) => worker.patches(surface));
  }

  /**
   * How many smooth pieces there are, and creases between them: without end where they are too small to be told apart.
   * @param {Result} result
   */
  async pieces(result) {
    const [map, { gaussian }] = await Promise.all([this.patches(result), this.curvature(result.surface)]);
    return { count: await smoothPieces(map, { gaussian }), creases: map.creases.length };
  }

  /** @param {Result} result */
  rulings({ surface }) {
    return this.#once(surface, 'rulings', (worker) => worker.rulings(surface));
  }

  /**
   * A picture of the sheet, and its figures; what they are made of is too much to be kept.
   * @param {Result} result
   */
  unroll({ surface }) {
    return this.#once(surface, 'sheet', async (worker) => {
      const { triangles, places, stretches, report, verdict } = await worker.unroll(surface);
      const picture = await handOver('sheetPixels', [triangles, places, stretches], triangles, places, stretches);
      return { picture, report, verdict };
    });
  }

  /**
   * The surface on its way to the sheet, on a coarser lattice.
   * @param {Result} result
   * @param {number} most strain at the end of the colours
   */
  unfold(result, most) {
    return this.#once(result.surface, 'unfolding', async (worker) => {
      const small = smaller(result, UNFOLDED);
      // Without creases it still unfolds.
      const [sheet, { creases }] = await Promise.all([worker.unroll(small), this.patches(result).catch(() => ({ creases: [] }))]);
      return work('unfolding', sheet, most, cornerOf(result, small), creases.map(({ points }) => points));
    });
  }

  /**
   * The same, cut into sheets that lie beside each other in the end.
   * @param {Result} result
   * @param {number} maxStrain
   * @param {number} most strain at the end of the colours
   */
  unfoldInPieces(result, maxStrain, most) {
    return this.#once(result.surface, `unfolding in pieces ${maxStrain}`, async (worker) => {
      const small = smaller(result, APART);
      // Between sheets there is room for scissors, which is little only beside large ones.
      const scale = APART_SIDE / (Math.max(small.width, small.height) * small.pixelSize);
      const { assembly } = await worker.pattern(small, { scale, maxStrain, assembly: true });
      if (!assembly) throw new Error('nothing is said of how it is put together');
      return work('unfoldingInPieces', assembly.model, scale / 1000, most, cornerOf(result, small));
    });
  }

  /**
   * The surface cut into sheets: a large one as it is on a coarser lattice.
   * @param {Result} result
   * @param {PatternOptions} options
   */
  pattern(result, options) {
    const { surface } = result;
    const cut = this.cutsAsItIs(result) ? surface : smaller(result, CUT);
    return this.#once(surface, `pattern ${JSON.stringify(options)}`, (worker) => worker.pattern(cut, options));
  }

  /** Whether sheets are those of the result's own lattice. @param {Result} result */
  cutsAsItIs(result) {
    const { width, height } = resultImage(result);
    return Math.max(width, height) < 1.2 * CUT;
  }

  /** @param {Drawing} drawing */
  svg(drawing) {
    return this.#once(drawing, 'svg', (worker) => worker.writeSvg(drawing));
  }

  /**
   * An example's true surface with something printed on it, seen from above.
   * @param {Input & { truth: Float64Array }} input
   */
  printOf(input) {
    return this.#once(input.truth, 'print', async (worker) => {
      const { width, height, pixelSize, heightScale, truth } = input;
      const { triangles, positions, places } = await worker.unroll({ ...heightsAlone(input), data: truth });
      const known = { width, height, pixelSize, heightScale, truth };
      return handOver('photographed', [triangles, positions, places], known, { triangles, positions, places });
    });
  }

  /**
   * By one profile for all rulings, where the heights have one.
   * @param {Result} result
   * @param {Photo} photo
   * @param {FlatOptions} options
   */
  dewarp(result, photo, options) {
    const { surface } = result;
    return this.#once(surface, `dewarp ${numberOf(photo)} ${JSON.stringify(options)}`, async (worker) => {
      const cylinder = await this.#cylinder(result);
      return { ...await worker.dewarp(cylinder ?? surface, photo, { ...options, map: false, grid: true }), parallel: cylinder !== undefined };
    });
  }

  /**
   * The cylinder that was seen, if it is one. What is said of the surface is about one that is fitted by its energy.
   * @param {Result} result
   */
  #cylinder({ input: { lattice }, settings: { lambda, energy, occlusionThreshold }, surface }) {
    const asSeen = lattice && lambda === 'auto' && (energy ?? 'huber') === 'huber' && occlusionThreshold === undefined;
    if (!asSeen || lattice.constraints || lattice.occlusions || lattice.brokenEdges) return undefined;
    return this.#once(surface, 'cylinder', async (worker) => {
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
 * The number of smooth pieces; without end where they are creased all over, too finely to be told apart.
 * @param {import('../pkg/types.js').PatchMap} map
 * @param {{ gaussian: ArrayLike<number> }} curvature
 */
export async function smoothPieces({ rows, cols, labels, spacing, patches }, { gaussian }) {
  const round = await work('roundness', { rows, cols, labels, spacing }, { gaussian });
  return round < CREASED ? patches.length : Infinity;
}

/** What is shown of an analysis. @param {Analysis} analysis */
function shown(analysis) {
  const { gaussian, kappa1, kappa2 } = analysis;
  return handOver('curvaturesOf', [gaussian, kappa1, kappa2], analysis);
}

/**
 * A result's pixels on fewer of them.
 * @param {Result} result
 * @param {number} side most along the longer side
 */
function smaller(result, side) {
  const { width, pixelSize, ...image } = resultImage(result);
  const small = coarse({ width, ...image }, side);
  return { ...small, pixelSize: (pixelSize * width) / small.width };
}

/**
 * Where the lower left corner of the plane is that an image is over.
 * @param {Result} result
 * @param {{ height: number, pixelSize: number }} small
 * @returns {[number, number]}
 */
function cornerOf({ input }, { height, pixelSize }) {
  const { left, top } = gridOf(input);
  return [left, top - height * pixelSize];
}

let photos = 0;
/** @type {WeakMap<Photo, number>} */
const numbers = new WeakMap();

/** A number that no other photo has: answers are kept with the surface, and go with it. @param {Photo} photo */
function numberOf(photo) {
  const number = numbers.get(photo) ?? ++photos;
  numbers.set(photo, number);
  return number;
}

/**
 * An input without what else is known of it.
 * @param {Input} input
 */
function heightsAlone({ width, height, data, pixelSize, heightScale, lattice }) {
  return lattice ?? { width, height, data, pixelSize, heightScale };
}
