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
/** @typedef {{ sideways: boolean, lines: [Line[], Line[]] }} Traces for each bent edge those of its pages */
/** @typedef {{ photo: PagePhoto, traces: Traces, text: Line[][], options: Options }} Wish `text`: lines of text that are drawn, by page */

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
   * @param {(done: { wish: Wish, flat: DewarpedPage } | { wish: Wish, error: unknown }) => void} tell of those that were not overtaken
   */
  async preview(wish, tell) {
    this.#next = wish;
    if (this.#busy) return;
    this.#busy = true;
    for (let now = this.#take(); now; now = this.#take()) {
      const { photo: { small, grey: { scale }, film35 }, traces, text, options } = now;
      const { width, height, data } = small;
      try {
        const flat = await this.worker.dewarpPage({ width, height, data, film35 }, edgesOf(traces, text, scale), atScale(options, scale));
        tell({ wish: now, flat });
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
export function whole(worker, { photo, traces, text, options }) {
  const { width, height, data, film35 } = photo;
  return worker.dewarpPage({ width, height, data, film35 }, edgesOf(traces, text, 1), { ...options, map: false });
}

/**
 * @param {Traces} traces
 * @param {Line[][]} text
 * @param {number} scale
 * @returns {PageEdges[]}
 */
function edgesOf({ sideways, lines: [first, second] }, text, scale) {
  /** @param {Line} line */
  const scaled = (line) => line.map(([x, y]) => /** @type {[number, number]} */ ([rescaled(x, scale), rescaled(y, scale)]));
  return first.map((line, i) => {
    const [one, other] = [scaled(line), scaled(second[i])];
    const lines = (text[i] ?? []).map(scaled);
    return sideways ? { left: one, right: other, lines } : { top: one, bottom: other, lines };
  });
}

/** Of what counts in pixels of the photo. @param {Options} options @param {number} scale */
function atScale({ focalLength, dots, ...options }, scale) {
  return focalLength === undefined ? options : { ...options, focalLength: focalLength * scale };
}
