/**
 * Pages made flat in a worker of their own: of a reduced photo while edges are moved, where the newest wish wins, and of
 * the whole one to be saved.
 */
import { rescaled } from './grey.js';

/** @import {Api} from '../api.js' */
/** @import {PagePhoto} from './photo.js' */
/** @typedef {import('../../pkg/types.js').DewarpedPage} DewarpedPage */
/** @typedef {import('../../pkg/types.js').DewarpPageOptions} Options */
/** @typedef {import('../../pkg/types.js').PageEdges} PageEdges */
/** @typedef {[number, number][]} Line */
/** @typedef {[Line[], Line[], Line[], Line[]]} Traces for the upper, lower, left and right edge those of each page */
/**
 * @typedef {object} Wish
 * @property {PagePhoto} photo
 * @property {Traces} traces
 * @property {Line[][]} text lines of text that are drawn, by page
 * @property {Options} options
 * @property {boolean} moving whether something is being dragged: then lines of text are not looked for, which takes longer
 */
/** @typedef {{ flat: DewarpedPage, assumed: boolean }} Flat `assumed`: the focal length is a guess */

/** Field of view of a phone's main camera along the photo's longer side, in degrees, where nothing tells it. */
export const ASSUMED_FIELD_OF_VIEW = 65;

export class Flattening {
  /** @type {Wish | null} */
  #next = null;
  #busy = false;

  /** @param {InstanceType<Api['DevelopableWorker']>} worker */
  constructor(worker) {
    this.worker = worker;
  }

  /**
   * @param {Wish} wish
   * @param {(done: { wish: Wish } & (Flat | { error: unknown })) => void} tell of those that were not overtaken
   */
  async preview(wish, tell) {
    this.#next = wish;
    if (this.#busy) return;
    this.#busy = true;
    for (let now = this.#take(); now; now = this.#take()) {
      const { photo: { small, grey: { scale }, film35 }, traces, text, options, moving } = now;
      const { width, height, data } = small;
      try {
        const own = { ...atScale(options, scale), ...(moving && { findLines: false }) };
        tell({ wish: now, ...await dewarped(this.worker, { width, height, data, film35 }, edgesOf(traces, text, scale), own) });
      } catch (error) {
        if (!this.#next) tell({ wish: now, error });
      }
    }
    this.#busy = false;
  }

  #take() {
    const next = this.#next;
    this.#next = null;
    return next;
  }
}

/**
 * All pixels of the photo.
 * @param {InstanceType<Api['DevelopableWorker']>} worker
 * @param {Wish} wish
 */
export async function whole(worker, { photo, traces, text, options }) {
  const { width, height, data, film35 } = photo;
  return (await dewarped(worker, { width, height, data, film35 }, edgesOf(traces, text, 1), { ...options, map: false })).flat;
}

/**
 * The flat page, by a usual focal length where the edges do not tell it.
 * @param {InstanceType<Api['DevelopableWorker']>} worker
 * @param {Parameters<Api['dewarpPage']>[0]} photo
 * @param {PageEdges[]} edges
 * @param {Options} options
 * @returns {Promise<Flat>}
 */
async function dewarped(worker, photo, edges, options) {
  try {
    return { flat: await worker.dewarpPage(photo, edges, options), assumed: false };
  } catch (error) {
    if (!(error instanceof Error && 'code' in error && error.code === 'FOCAL_LENGTH')) throw error;
    return { flat: await worker.dewarpPage(photo, edges, { ...options, fieldOfView: ASSUMED_FIELD_OF_VIEW }), assumed: true };
  }
}

/**
 * Of one page all four edges; of two pages those that both have, for a gutter is no edge that can be seen.
 * @param {Traces} traces
 * @param {Line[][]} text
 * @param {number} scale
 * @returns {PageEdges[]}
 */
function edgesOf([upper, lower, [left], [right]], text, scale) {
  /** @param {Line} line */
  const scaled = (line) => line.map(([x, y]) => /** @type {[number, number]} */ ([rescaled(x, scale), rescaled(y, scale)]));
  return upper.map((line, i) => {
    const bent = { top: scaled(line), bottom: scaled(lower[i]), lines: (text[i] ?? []).map(scaled) };
    return upper.length > 1 ? bent : { ...bent, left: scaled(left), right: scaled(right) };
  });
}

/** Of what counts in pixels of the photo. @param {Options} options @param {number} scale */
function atScale({ focalLength, dots, ...options }, scale) {
  return focalLength === undefined ? options : { ...options, focalLength: focalLength * scale };
}
