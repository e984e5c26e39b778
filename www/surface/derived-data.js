/** Data derived from inputs and results: previews, images and errors. They are computed once, before panels show the input or result. */
import { gridOf } from './lattice.js';
import { reduceForPreview } from './downsampling.js';
import { callWorker } from './worker-client.js';

/** @import {Input, Result} from '../session.js' */
/** @import {Heights} from './downsampling.js' */
/** @typedef {{ before: number, after: number }} Accuracy errors of the heights of input and result, root mean square */
/** @typedef {{ width: number, height: number, pixelSize: number, data: Float64Array }} Image */

/** Reduced heights for previews, by the values of the pixels. @type {WeakMap<ArrayLike<number>, Heights>} */
const previewHeights = new WeakMap();
/** @type {WeakMap<Result, { image: Image, accuracy: Accuracy | null }>} */
const resultData = new WeakMap();

/** Reduces the heights of an input for previews, in the worker. @param {Input} input */
export async function prepareInput({ data, width, height }) {
  if (!previewHeights.has(data)) previewHeights.set(data, await callWorker('reduceForPreview', { width, height, data }));
}

/** Heights reduced for previews. @param {Heights} image */
export function previewHeightsOf(image) {
  const found = previewHeights.get(image.data) ?? reduceForPreview(image);
  previewHeights.set(image.data, found);
  return found;
}

/** Computes the image and errors of a result. @param {Result} result */
export async function prepareResult(result) {
  const image = result.surface.image ?? await rasteriseResult(result);
  resultData.set(result, { image, accuracy: await measureAccuracy(result, image) });
}

/** Interpolates a surface to the pixels that show the input's lattice. @param {Result} result @returns {Promise<Image>} */
async function rasteriseResult({ input, surface: { rows, cols, spacing, origin, heights } }) {
  const grid = gridOf(input);
  const data = await callWorker('interpolateToGrid', { rows, cols, spacing, origin }, heights, grid);
  return { width: grid.width, height: grid.height, pixelSize: grid.pixelSize, data };
}

/** Errors of input and result against the truth; null if the truth is not known. @param {Result} result @param {Image} image @returns {Promise<Accuracy | null>} */
async function measureAccuracy({ input }, image) {
  const { truth, heightScale, data } = input;
  if (!truth) return null;
  const [before, after] = await Promise.all([[data, heightScale], [image.data, 1]].map(([heights, scale]) =>
    callWorker('rmsError', /** @type {Float64Array} */ (heights), /** @type {number} */ (scale), truth, heightScale)));
  return { before, after };
}

/** The heights of a result at the input's pixels, or at the pixels that show the input's lattice. @param {Result} result */
export function resultImage(result) {
  return cachedValue(resultData, result).image;
}

/**
 * Errors of input and result against the truth; null if that is not known.
 * @param {Result} result
 */
export function accuracyOf(result) {
  return cachedValue(resultData, result).accuracy;
}

/**
 * The value of a key in a cache.
 * @template {object} K
 * @template V
 * @param {WeakMap<K, V>} known
 * @param {K} key
 */
function cachedValue(known, key) {
  const found = known.get(key);
  if (!found) throw new Error('it has not been looked at yet');
  return found;
}
