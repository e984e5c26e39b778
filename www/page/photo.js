/** A photo that was opened: its pixels once, and a reduced copy of them to show and to look for edges in. */
import { apart } from '../worker-task.js';
import { pixelsOf, reducedPhoto } from '../pixels.js';

/** @import {Api} from '../api.js' */
/** @import {Grey} from './grey.js' */
/** @import {Outline} from './outline.js' */

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
 * @property {{ edges: Outline['edges'], sideways: boolean } | null} outline of a page, if one is beyond doubt
 */

/**
 * @param {Api} api
 * @param {File} file
 * @param {AbortSignal} signal it is given up
 * @returns {Promise<PagePhoto>}
 */
export async function openPhoto(api, file, signal) {
  const photo = await apart(api, signal, (worker) => worker.readPhoto(file)).catch((/** @type {unknown} */ error) => {
    signal.throwIfAborted();
    // The browser may know kinds of pictures that the package does not.
    return pixelsOf(file).catch(() => {
      throw error;
    });
  });
  signal.throwIfAborted();
  return photoOf(photo, file.name.replace(/\.[^.]*$/, '') || 'photo');
}

/**
 * @param {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer>, film35?: number }} pixels
 * @param {string} name
 * @returns {Promise<PagePhoto>}
 */
export async function photoOf({ width, height, data, film35 }, name) {
  if (width < 16 || height < 16) throw new Error(`it is ${width} × ${height} pixels, too few to show a page`);
  const { small, grey, outline } = await reducedPhoto({ width, height, data }, Math.min(1, SMALL / Math.max(width, height)));
  return { name, width, height, data, film35, small, grey, outline };
}
