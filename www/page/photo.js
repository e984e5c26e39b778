/** A photo that was opened: its pixels once, and a reduced copy of them to show and to look for edges in. */
import { apart } from '../worker-task.js';
import { pixelsOf, reducedPhoto } from '../pixels.js';
import { rescaled } from './grey.js';

/** @import {Api} from '../api.js' */
/** @import {Grey} from './grey.js' */
/** @typedef {import('../../pkg/types.js').PageOutlines} PageOutlines */

/** Pixels along the longer side of the reduced copy, at most. */
const SMALL = 1280;

/**
 * @typedef {object} PagePhoto
 * @property {string} name of its file, without its ending
 * @property {number} width
 * @property {number} height
 * @property {Uint8ClampedArray<ArrayBuffer>} data
 * @property {number} [film35] focal length as for a film of 36 by 24 mm, where its file tells it
 * @property {ImageData} small
 * @property {Grey} grey the same, whose `scale` is its pixels for one of the photo
 * @property {PageOutlines} outlines of the pages that were found, in its pixels
 */

/**
 * @param {Api} api
 * @param {File} file
 * @param {AbortSignal} signal it is given up
 * @param {boolean} [half] whether its sides are halved, as it has too many pixels
 * @returns {Promise<PagePhoto>}
 */
export async function openPhoto(api, file, signal, half = false) {
  const photo = half ? await pixelsOf(file, 2) : await apart(api, signal, (worker) => worker.readPhoto(file)).catch((/** @type {unknown} */ error) => {
    signal.throwIfAborted();
    if (isTooLarge(error)) throw error;
    // The browser may know kinds of pictures that the package does not.
    return pixelsOf(file).catch(() => {
      throw error;
    });
  });
  signal.throwIfAborted();
  return photoOf(api, photo, file.name.replace(/\.[^.]*$/, '') || 'photo', signal);
}

/**
 * @param {Api} api
 * @param {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer>, film35?: number }} pixels
 * @param {string} name
 * @param {AbortSignal} signal it is given up
 * @returns {Promise<PagePhoto>}
 */
export async function photoOf(api, { width, height, data, film35 }, name, signal) {
  if (width < 16 || height < 16) throw new Error(`it is ${width} × ${height} pixels, too few to show a page`);
  const { small, grey } = await reducedPhoto({ width, height, data }, Math.min(1, SMALL / Math.max(width, height)));
  const outlines = await apart(api, signal, (worker) => worker.findPage(small));
  return { name, width, height, data, film35, small, grey, outlines: enlarged(outlines, 1 / grey.scale) };
}

/** Whether a file has more pixels than the package takes. @param {unknown} error */
export function isTooLarge(error) {
  return error instanceof Error && 'code' in error && error.code === 'TOO_LARGE';
}

/** @param {PageOutlines} outlines @param {number} scale @returns {PageOutlines} */
function enlarged({ pages, ...found }, scale) {
  /** @param {[number, number][]} line */
  const at = (line) => line.map(([x, y]) => /** @type {[number, number]} */ ([rescaled(x, scale), rescaled(y, scale)]));
  return {
    ...found,
    pages: pages.map(({ corners, edges: { top, bottom, left, right }, ...page }) => (
      { ...page, corners: at(corners), edges: { top: at(top), bottom: at(bottom), left: at(left), right: at(right) } })),
  };
}
