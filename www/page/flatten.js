/** Flattens pages in a worker: the reduced photo for previews while edges are moved, and by its result the whole photo for saving. */
/** @typedef {Pick<import('../../pkg/types.js').DewarpPageOptions, 'page' | 'light' | 'ink'>} Options */
/** @typedef {import('../../pkg/types.js').PageEdges} PageEdges */
/** @typedef {[number, number][]} Line */
/** @typedef {[Line[], Line[], Line[], Line[]]} Traces of the upper, lower, left and right edge, each as one line per page */
/**
 * @typedef {object} FlattenRequest
 * @property {PagePhoto} photo
 * @property {Traces} traces
 * @property {Options} options
 * @property {boolean} isDetected whether the edges are those of the detected outline, with no corner that was moved by hand
 * @property {boolean} moving whether something is being dragged: then neither edges nor lines of text are searched, which would take longer
 */

/**
 * Finds the page of a request in the reduced photo, and flattens it.
 * @param {PackageWorker} worker
 * @param {FlattenRequest} request
 * @param {(fraction: number) => void} [onProgress]
 */
export function flattenReducedPhoto(worker, { photo: { reduced, scale, film35, outlines }, traces, options, moving, isDetected }, onProgress = () => {}) {
  const { width, height, data } = reduced;
  return worker.dewarpPage({ width, height, data, film35 }, toPageEdges(traces, scale), {
    ...options,
    ...(moving && { findLines: false, traceEdges: false }),
    doubtfulOutline: isDetected && outlines.verdict === 'doubtful',
    onProgress: ({ fraction }) => onProgress(fraction),
  });
}

/**
 * Flattens the photo with all its pixels by the page that was found in its reduced copy: what is saved is what was shown.
 * @param {PackageWorker} worker
 * @param {FlattenRequest} request
 * @param {DewarpedPage} found
 * @returns {Promise<FlatPage>}
 */
export const flattenWholePhoto = (worker, { photo: { width, height, data }, options: { light, ink } }, found) => worker.flattenPhoto({ width, height, data }, found, { light, ink });

/**
 * The edges of each page. One page has four; two pages of a book have only upper and lower edges, since no edge is visible at
 * the gutter.
 * @param {Traces} traces
 * @param {number} scale
 * @returns {PageEdges[]}
 */
function toPageEdges([upper, lower, [left], [right]], scale) {
  return upper.map((line, i) => {
    const bent = { top: rescaleLine(line, scale), bottom: rescaleLine(lower[i], scale) };
    return upper.length > 1 ? bent : { ...bent, left: rescaleLine(left, scale), right: rescaleLine(right, scale) };
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
    return Array.isArray(traced) ? rescaleLine(traced, 1 / scale) : line;
  })));
}

/**
 * Converts places in an image to those in the same image at another scale. Coordinate 0 is the centre of the first pixel.
 * @param {Line} line
 * @param {number} scale new pixels per old pixel
 */
export function rescaleLine(line, scale) {
  return line.map((place) => /** @type {[number, number]} */ (place.map((coordinate) => (coordinate + 0.5) * scale - 0.5)));
}
