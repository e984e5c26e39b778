/**
 * Flattens pages in a worker: the reduced photo for previews while edges are moved, where only the newest request counts, and
 * by its result the whole photo for saving.
 */
/** @import {PagePhoto} from './photo.js' */
/** @import {Worker} from '../worker-task.js' */
/** @typedef {import('../../pkg/types.js').DewarpedPage} DewarpedPage */
/** @typedef {import('../../pkg/types.js').FlatPage} FlatPage */
/** @typedef {import('../../pkg/types.js').DewarpPageOptions} Options */
/** @typedef {import('../../pkg/types.js').PageEdges} PageEdges */
/** @typedef {[number, number][]} Line */
/** @typedef {[Line[], Line[], Line[], Line[]]} Traces of the upper, lower, left and right edge, each as one line per page */
/**
 * @typedef {object} FlattenRequest
 * @property {PagePhoto} photo
 * @property {Traces} traces
 * @property {Options} options
 * @property {boolean} moving whether something is being dragged: then neither edges nor lines of text are searched, which would take longer
 */

export class PageFlattener {
  /** @type {FlattenRequest | null} */
  #waiting = null;
  #busy = false;

  /** @param {Worker} worker */
  constructor(worker) {
    this.worker = worker;
  }

  /**
   * Flattens the reduced photo. A request that waits is replaced by a newer one.
   * @param {FlattenRequest} request
   * @param {(fraction: number) => void} onProgress gets the share of the present flattening that is done
   * @param {(done: { request: FlattenRequest } & ({ flat: DewarpedPage } | { error: unknown })) => void} onResult gets each result, and an error unless a newer request waits
   */
  async preview(request, onProgress, onResult) {
    this.#waiting = request;
    if (this.#busy) return;
    this.#busy = true;
    for (let current = this.#takeWaiting(); current; current = this.#takeWaiting()) {
      try {
        onResult({ request: current, flat: await flattenReducedPhoto(this.worker, current, onProgress) });
      } catch (error) {
        if (!this.#waiting) onResult({ request: current, error });
      }
    }
    this.#busy = false;
  }

  #takeWaiting() {
    const next = this.#waiting;
    this.#waiting = null;
    return next;
  }
}

/**
 * Finds the page of a request in the reduced photo, and flattens it.
 * @param {Worker} worker
 * @param {FlattenRequest} request
 * @param {(fraction: number) => void} [onProgress]
 */
export function flattenReducedPhoto(worker, { photo: { reduced, scale, film35 }, traces, options, moving }, onProgress = () => {}) {
  const { width, height, data } = reduced;
  return worker.dewarpPage({ width, height, data, film35 }, toPageEdges(traces, scale), { ...scaleOptions(options, scale), ...(moving && { findLines: false, traceEdges: false }), onProgress: ({ fraction }) => onProgress(fraction) });
}

/**
 * Flattens the photo with all its pixels by the page that was found in its reduced copy: what is saved is what was shown.
 * @param {Worker} worker
 * @param {FlattenRequest} request
 * @param {DewarpedPage} found
 * @returns {Promise<FlatPage>}
 */
export function flattenWholePhoto(worker, { photo: { width, height, data }, options: { light, ink } }, found) {
  return worker.flattenPhoto({ width, height, data }, found, { light, ink });
}

/**
 * The edges of each page. One page has four; two pages of a book have only upper and lower edges, since no edge is visible at
 * the gutter.
 * @param {Traces} traces
 * @param {number} scale
 * @returns {PageEdges[]}
 */
function toPageEdges([upper, lower, [left], [right]], scale) {
  /** @param {Line} line */
  const scaled = (line) => line.map(([x, y]) => /** @type {[number, number]} */ ([rescalePixel(x, scale), rescalePixel(y, scale)]));
  return upper.map((line, i) => {
    const bent = { top: scaled(line), bottom: scaled(lower[i]) };
    return upper.length > 1 ? bent : { ...bent, left: scaled(left), right: scaled(right) };
  });
}

/**
 * The edges by which a flat page was found, in pixels of the photo.
 * @param {DewarpedPage} flat
 * @param {Traces} given the edges of the request, for those that the library was not given
 * @param {number} scale
 * @returns {Traces}
 */
export function tracedEdges({ edges }, given, scale) {
  const names = /** @type {const} */ (['top', 'bottom', 'left', 'right']);
  return /** @type {Traces} */ (names.map((name, edge) => given[edge].map((line, page) => {
    const traced = edges[page]?.[name];
    return Array.isArray(traced) ? traced.map(([x, y]) => [rescalePixel(x, 1 / scale), rescalePixel(y, 1 / scale)]) : line;
  })));
}

/** Converts options in pixels of the photo to the reduced photo. @param {Options} options @param {number} scale */
function scaleOptions({ focalLength, dots, ...options }, scale) {
  return focalLength === undefined ? options : { ...options, focalLength: focalLength * scale };
}

/**
 * Converts a pixel coordinate to that of the same image at another scale. Coordinate 0 is the centre of the first pixel.
 * @param {number} coordinate
 * @param {number} scale new pixels per old pixel
 */
export function rescalePixel(coordinate, scale) {
  return (coordinate + 0.5) * scale - 0.5;
}
