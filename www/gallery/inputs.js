/** Inputs of the gallery: height images with noise or steps. */

import { sidesOf } from '../surface/triangles.js';
import { randomAt } from './shapes.js';

/** @import {Heights} from './shapes.js' */

/**
 * An image of heights, with defects.
 * @param {string} name
 * @param {Heights} heights
 * @param {number} size pixels along a side
 * @param {object} [defects]
 * @param {number} [defects.noise] standard deviation, as a share of the range of heights
 * @param {number} [defects.voxels] voxels along a side, to which heights are rounded
 * @param {boolean} [defects.known] whether the true surface is the one without defects
 * @returns {Input}
 */
export function sampledInput(name, heights, size, { noise = 0, voxels, known = noise > 0 || voxels !== undefined } = {}) {
  const truth = image(heights, size);
  const given = voxels ? image(voxelHeights(heights, voxels), size) : truth;
  const [range] = sidesOf(truth, 1);
  const data = given.map((z, i) => z + noise * range * normalSample(i));
  return { name, width: size, height: size, data, pixelSize: 1 / size, heightScale: 1, ...(known && { truth }) };
}

/** Heights at the centres of all pixels, whose coordinates are from the middle of the square, y up. @param {Heights} heights @param {number} size */
function image(heights, size) {
  return Float64Array.from({ length: size * size }, (_, i) => heights((i % size + 0.5) / size - 0.5, 0.5 - (Math.floor(i / size) + 0.5) / size));
}

/** Heights rounded to voxels. @param {Heights} heights @param {number} count voxels along a side @returns {Heights} */
function voxelHeights(heights, count) {
  const middle = (/** @type {number} */ at) => (Math.floor(at * count) + 0.5) / count;
  return (x, y) => Math.round(heights(middle(x), middle(y)) * count) / count;
}

/** A normally distributed number, by two random ones (Box-Muller transform). @param {number} i which one */
function normalSample(i) {
  return Math.sqrt(-2 * Math.log(1 - randomAt(i, 1))) * Math.cos(2 * Math.PI * randomAt(i, 2));
}
