/** Data derived from results: images and errors. They are computed once, before panels show the result. */
import { gridOf } from './lattice.js';
import { callWorker } from './worker-client.js';

/** @import {Surface} from '../../pkg/types.js' */
/** @typedef {{ before: number, after: number }} Accuracy errors of the heights of input and result, root mean square */
/** @typedef {{ width: number, height: number, pixelSize: number, data: Float64Array }} Image */

/**
 * The image of a surface at the input's pixels, or at those that show the input's lattice, and the errors against the truth.
 * @param {Input} input
 * @param {Surface} surface
 * @returns {Promise<{ image: Image, accuracy: Accuracy | null }>} `accuracy`: null if the truth is not known
 */
export async function derivedOf(input, { image: given, rows, cols, spacing, origin, heights }) {
  const { truth, heightScale } = input;
  const { width, height, pixelSize, ...place } = gridOf(input);
  const image = given ?? { width, height, pixelSize, data: await callWorker('interpolateToGrid', { rows, cols, spacing, origin }, heights, { width, height, pixelSize, ...place }) };
  if (!truth) return { image, accuracy: null };
  const [before, after] = await Promise.all([callWorker('rmsError', input.data, heightScale, truth, heightScale), callWorker('rmsError', image.data, 1, truth, heightScale)]);
  return { image, accuracy: { before, after } };
}
