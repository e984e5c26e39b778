/** Paper sizes for a flat page: which one it looks like, and the pages of a PDF in that size. */

import { turnedPicture } from './quarter-turn.js';

/** @import {Worker} from '../worker-task.js' */
/** @import {DewarpedPage} from './flatten.js' */

/** @typedef {keyof typeof PAPERS} PaperName */

/** Width and height of paper in millimetres. */
export const PAPERS = /** @type {const} */ ({
  a4: [210, 297], letter: [215.9, 279.4], a5: [148, 210], a3: [297, 420], 'a4-wide': [297, 210], 'letter-wide': [279.4, 215.9],
});
/** Largest difference of a page's proportions from those of a paper size, as a share, for the page to look like it. */
const MAX_RATIO_DIFFERENCE = 0.03;
/**
 * The paper size with a page's proportions, if there is one.
 * @param {number} width of one page, in any unit
 * @param {number} height
 * @returns {PaperName | null}
 */
export function similarPaper(width, height) {
  const off = (/** @type {PaperName} */ name) => Math.abs(Math.log((width / height) * (PAPERS[name][1] / PAPERS[name][0])));
  const names = /** @type {PaperName[]} */ (['a4', 'letter', 'a4-wide', 'letter-wide']);
  const nearest = names.reduce((best, name) => (off(name) < off(best) ? name : best));
  return off(nearest) < MAX_RATIO_DIFFERENCE ? nearest : null;
}

/**
 * The pages of a PDF of a flat photo, one for each page that it shows, in a paper size or in true size without one.
 * @param {Worker} worker
 * @param {DewarpedPage} flat
 * @param {number} pages that it shows side by side
 * @param {number} quarters by which each is turned clockwise
 * @param {readonly [number, number] | null} paper in millimetres
 * @param {boolean} [ink] whether it is black and white
 */
export async function pictureFiles(worker, flat, pages, quarters, paper, ink = false) {
  const columns = Array.from({ length: pages }, (_, i) => [Math.round((i * flat.width) / pages), Math.round(((i + 1) * flat.width) / pages)]);
  const made = [];
  for (const [from, to] of columns) {
    const { width, height, data } = turnedPicture(columnsOf(flat, from, to), quarters);
    const picture = await worker.writePhoto({ width, height, data }, { format: ink ? 'png' : 'jpeg' });
    const size = /** @type {[number, number]} */ (paper ? [...paper] : [width / flat.resolution, height / flat.resolution]);
    made.push({ picture, size });
  }
  return made;
}

/**
 * A part of a picture, from one column to another.
 * @param {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} picture RGBA
 * @param {number} from
 * @param {number} to
 */
function columnsOf({ width, height, data }, from, to) {
  if (to - from === width) return { width, height, data };
  const part = new Uint8ClampedArray(4 * (to - from) * height);
  for (let row = 0; row < height; row++) part.set(data.subarray(4 * (row * width + from), 4 * (row * width + to)), 4 * row * (to - from));
  return { width: to - from, height, data: part };
}
