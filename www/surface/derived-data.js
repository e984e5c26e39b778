/** Data derived from results: images and errors. They are computed once, before panels show the result. */
import { gridOf } from './lattice.js';
import { callWorker } from './worker-client.js';

/** @import {Surface} from '../api.js' */
/** @import {Input} from '../session.js' */
/** @typedef {{ before: number, after: number }} Accuracy errors of the heights of input and result, root mean square */
/** @typedef {{ width: number, height: number, pixelSize: number, data: Float64Array }} Image */
/** @typedef {{ input: Input, surface: Surface }} Solved */

/** The image of a surface at the input's pixels, or at those that show the input's lattice, and its errors. @param {Solved} solved */
export async function derivedOf(solved) {
  const image = solved.surface.image ?? await rasterise(solved);
  return { image, accuracy: await measureAccuracy(solved.input, image) };
}

/** Interpolates a surface to the pixels that show the input's lattice. @param {Solved} solved @returns {Promise<Image>} */
async function rasterise({ input, surface: { rows, cols, spacing, origin, heights } }) {
  const grid = gridOf(input);
  const data = await callWorker('interpolateToGrid', { rows, cols, spacing, origin }, heights, grid);
  return { width: grid.width, height: grid.height, pixelSize: grid.pixelSize, data };
}

/** Errors of input and result against the truth; null if the truth is not known. @param {Input} input @param {Image} image @returns {Promise<Accuracy | null>} */
async function measureAccuracy({ truth, heightScale, data }, image) {
  if (!truth) return null;
  const [before, after] = await Promise.all([[data, heightScale], [image.data, 1]].map(([heights, scale]) =>
    callWorker('rmsError', /** @type {Float64Array} */ (heights), /** @type {number} */ (scale), truth, heightScale)));
  return { before, after };
}
