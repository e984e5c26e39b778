/** Paper sizes of flat pages: the most similar size, and the pictures of a PDF's pages, turned by right angles. */

import { linesIn } from './text.js';

/** @import {Pixels} from '../pixels.js' */
/** @typedef {keyof typeof PAPERS} PaperName */

/** Width and height of paper sizes in millimetres. */
export const PAPERS = /** @type {const} */ ({
  a4: [210, 297], letter: [215.9, 279.4], a5: [148, 210], a3: [297, 420], 'a4-wide': [297, 210], 'letter-wide': [279.4, 215.9],
});
/** Maximum difference between the logarithms of two similar aspect ratios. */
const MAX_RATIO_DIFFERENCE = 0.03;

/**
 * The paper size whose aspect ratio is that of a page; null if none is similar.
 * @param {number} width width of one page, in any unit
 * @param {number} height
 * @returns {PaperName | null}
 */
export function similarPaper(width, height) {
  const ratioDifference = (/** @type {PaperName} */ name) => Math.abs(Math.log((width / height) * (PAPERS[name][1] / PAPERS[name][0])));
  const names = /** @type {PaperName[]} */ (['a4', 'letter', 'a4-wide', 'letter-wide']);
  const nearest = names.reduce((best, name) => (ratioDifference(name) < ratioDifference(best) ? name : best));
  return ratioDifference(nearest) < MAX_RATIO_DIFFERENCE ? nearest : null;
}

/**
 * Encodes each page of a flat photo as a picture for a PDF.
 * @param {PackageWorker} worker
 * @param {FlatPage} flat
 * @param {number} pages number of pages side by side
 * @param {number} quarters clockwise quarter turns of each page
 * @param {readonly [number, number] | null} paper size in millimetres, upright or not as each picture; null for true size
 * @param {{ ink?: boolean, text?: boolean }} options whether the flat photo is black and white; whether its text is recognised
 */
export async function pictureFiles(worker, flat, pages, quarters, paper, { ink = false, text = false }) {
  const columns = Array.from({ length: pages }, (_, i) => [Math.round((i * flat.width) / pages), Math.round(((i + 1) * flat.width) / pages)]);
  const pictures = [];
  for (const [from, to] of columns) {
    const { width, height, data } = turnPicture(columnsOf(flat, from, to), quarters);
    const words = text ? await linesIn(new ImageData(data, width, height)) : [];
    const picture = await worker.writePhoto({ width, height, data }, { format: ink ? 'png' : 'jpeg' });
    const size = paper ? [...paper].sort((a, b) => (width < height ? a - b : b - a)) : [width / flat.resolution, height / flat.resolution];
    pictures.push({ picture, size: /** @type {[number, number]} */ (size), words, ending: ink ? 'png' : 'jpg' });
  }
  return pictures;
}

/** The columns `from` to `to` of a picture. @param {Pixels} picture @param {number} from @param {number} to */
function columnsOf({ width, height, data }, from, to) {
  if (to - from === width) return { width, height, data };
  const part = new Uint8ClampedArray(4 * (to - from) * height);
  for (let row = 0; row < height; row++) part.set(data.subarray(4 * (row * width + from), 4 * (row * width + to)), 4 * row * (to - from));
  return { width: to - from, height, data: part };
}

/** A picture turned clockwise. @param {Pixels} picture @param {number} quarters number of quarter turns @returns {Pixels} */
export function turnPicture(picture, quarters) {
  if (quarters % 4 === 0) return picture;
  const { width, height, data } = picture;
  const from = new Uint32Array(data.buffer, data.byteOffset, width * height);
  const to = new Uint32Array(width * height);
  // One quarter turn moves the lower left pixel to the upper left.
  for (let row = 0; row < height; row++) {
    for (let col = 0; col < width; col++) to[col * height + height - 1 - row] = from[row * width + col];
  }
  return turnPicture({ width: height, height: width, data: new Uint8ClampedArray(to.buffer) }, quarters - 1);
}
