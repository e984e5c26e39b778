/** Inputs of the gallery: height images with noise or steps. */

import { sidesOf } from '../surface/triangles.js';

/** @import {Heights} from './shapes.js' */

/** Seed of the noise. */
const NOISE_SEED = 17;

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
  const random = randomGenerator(NOISE_SEED);
  const [range] = sidesOf(truth, 1);
  const data = given.map((z) => z + noise * range * normalSample(random));
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

/** A pseudo-random generator of numbers between 0 and 1. @param {number} seed */
function randomGenerator(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** A normally distributed number (Box-Muller transform). @param {() => number} random */
function normalSample(random) {
  return Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
}
