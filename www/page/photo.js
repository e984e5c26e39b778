/** Opens a photo of a page: its pixels, a reduced copy for display and edge tracing, and the outlines of the pages in it. */
import { runInWorker } from '../worker-task.js';
import { readPicture, reducedPhoto } from '../pixels.js';
import { rescalePixel } from './grey.js';

/** @import {Api} from '../api.js' */
/** @import {GreyImage} from './grey.js' */
/** @typedef {import('../../pkg/types.js').PageOutlines} PageOutlines */

/** Maximum length of the reduced copy's longer side, in pixels. */
const MAX_REDUCED_SIDE_PIXELS = 1280;

/**
 * @typedef {object} PagePhoto
 * @property {string} name of its file without the extension
 * @property {number} width
 * @property {number} height
 * @property {Uint8ClampedArray<ArrayBuffer>} data
 * @property {number} [film35] focal length for 35 mm film, if the file contains it
 * @property {ImageData} reduced
 * @property {GreyImage} grey the reduced copy in grey
 * @property {PageOutlines} outlines of the detected pages, in pixels of the photo
 */

/**
 * Opens a photo and detects the pages in it.
 * @param {Api} api
 * @param {File} file
 * @param {AbortSignal} signal
 * @param {boolean} [half] whether the photo is read at half its width and height
 * @returns {Promise<PagePhoto>}
 */
export async function openPhoto(api, file, signal, half = false) {
  const photo = half ? await readPicture(file, 2) : await runInWorker(api, signal, (worker) => worker.readPhoto(file)).catch((/** @type {unknown} */ error) => {
    signal.throwIfAborted();
    if (isTooLarge(error)) throw error;
    // Fall back on the browser, which may decode formats that the package cannot.
    return readPicture(file).catch(() => {
      throw error;
    });
  });
  signal.throwIfAborted();
  return preparePhoto(api, photo, file.name.replace(/\.[^.]*$/, '') || 'photo', signal);
}

/**
 * Reduces decoded pixels and detects the pages in them.
 * @param {Api} api
 * @param {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer>, film35?: number }} pixels
 * @param {string} name
 * @param {AbortSignal} signal
 * @returns {Promise<PagePhoto>}
 */
export async function preparePhoto(api, { width, height, data, film35 }, name, signal) {
  if (width < 16 || height < 16) throw new Error(`it is ${width} × ${height} pixels, too few to show a page`);
  const { small: reduced, grey } = await reducedPhoto({ width, height, data }, Math.min(1, MAX_REDUCED_SIDE_PIXELS / Math.max(width, height)));
  const outlines = await runInWorker(api, signal, (worker) => worker.findPage(reduced));
  return { name, width, height, data, film35, reduced, grey, outlines: rescaleOutlines(outlines, 1 / grey.scale) };
}

/** Whether an error says that a photo has too many pixels for the package. @param {unknown} error */
export function isTooLarge(error) {
  return error instanceof Error && 'code' in error && error.code === 'TOO_LARGE';
}

/** Converts outlines to another scale of the photo. @param {PageOutlines} outlines @param {number} scale @returns {PageOutlines} */
function rescaleOutlines({ pages, ...found }, scale) {
  /** @param {[number, number][]} line */
  const at = (line) => line.map(([x, y]) => /** @type {[number, number]} */ ([rescalePixel(x, scale), rescalePixel(y, scale)]));
  return {
    ...found,
    pages: pages.map(({ corners, edges: { top, bottom, left, right }, ...page }) => (
      { ...page, corners: at(corners), edges: { top: at(top), bottom: at(bottom), left: at(left), right: at(right) } })),
  };
}
