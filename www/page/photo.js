/** Opens a photo of a page: its pixels, a reduced copy for display and previews, and the outlines of the pages in it. */
import { stemOf } from '../file-kinds.js';
import { runInWorker } from '../worker-task.js';
import { readPicture } from '../pixels.js';
import { rescaleLine } from './flatten.js';

/** @typedef {import('../../pkg/types.js').PageOutlines} PageOutlines */
/** @typedef {import('../../pkg/types.js').PageOutline} PageOutline */

/** Maximum number of pixels of a photo that the browser decodes because it is too large for the package. */
export const MAX_REDUCED_PHOTO_PIXELS = 16e6;
/** Maximum length of the reduced copy's longer side, in pixels. */
const MAX_REDUCED_SIDE_PIXELS = 1280;

/**
 * @typedef {object} PagePhoto
 * @property {string} name of its file without the extension
 * @property {File} [file] an example has none
 * @property {number} width
 * @property {number} height
 * @property {Uint8ClampedArray<ArrayBuffer>} data
 * @property {number} [film35] focal length for 35 mm film, if the file contains it
 * @property {readonly import('../../pkg/types.js').Assumption[]} [assumptions] what the reader of the file has assumed
 * @property {ImageData} reduced
 * @property {number} scale pixels of the reduced copy per pixel of the photo
 * @property {PageOutlines} outlines of the detected pages, in pixels of the photo
 */

/** Opens a photo and detects the pages in it. @param {Api} api @param {File} file @param {AbortSignal} signal @returns {Promise<PagePhoto>} */
export async function openPhoto(api, file, signal) {
  const photo = await runInWorker(api, signal, (worker) => worker.readPhoto(file)).catch((/** @type {unknown} */ error) => {
    signal.throwIfAborted();
    // Fall back on the browser, which may decode formats that the package cannot, and reduces photos that are too large.
    return readPicture(file, { maxPixels: MAX_REDUCED_PHOTO_PIXELS }).catch(() => {
      throw error;
    });
  });
  signal.throwIfAborted();
  return { ...await preparePhoto(api, photo, stemOf(file) || 'photo', signal), file };
}

/**
 * Reduces decoded pixels and detects the pages in them.
 * @param {Api} api
 * @param {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer>, film35?: number, assumptions?: PagePhoto['assumptions'] }} pixels
 * @param {string} name
 * @param {AbortSignal} signal
 * @returns {Promise<PagePhoto>}
 */
export async function preparePhoto(api, { width, height, data, film35, assumptions }, name, signal) {
  if (width < 16 || height < 16) throw new Error(`it is ${width} × ${height} pixels, too few to show a page`);
  const scale = Math.min(1, MAX_REDUCED_SIDE_PIXELS / Math.max(width, height));
  const reduced = await readPicture({ width, height, data }, { scale });
  const outlines = await runInWorker(api, signal, (worker) => worker.findPage(reduced));
  return { name, width, height, data, film35, assumptions, reduced, scale, outlines: rescaleOutlines(outlines, 1 / scale) };
}

/** Converts outlines to another scale of the photo. @param {PageOutlines} outlines @param {number} scale @returns {PageOutlines} */
function rescaleOutlines({ pages, ...found }, scale) {
  const at = (/** @type {[number, number][]} */ line) => rescaleLine(line, scale);
  return {
    ...found,
    pages: pages.map(({ corners, edges: { top, bottom, left, right }, ...page }) => (
      { ...page, corners: /** @type {PageOutline['corners']} */ (at(corners)), edges: { top: at(top), bottom: at(bottom), left: at(left), right: at(right) } })),
  };
}
