/** Inputs of the gallery: heights at pixels, with noise, steps, holes or only where they are held. */

/** @import {Input} from '../session.js' */
/** @import {Heights} from './shapes.js' */

/**
 * @param {string} name
 * @param {Heights} heights over the unit square
 * @param {number} size pixels along a side
 * @param {object} [spoils]
 * @param {number} [spoils.noise] standard deviation, as a share of the height range
 * @param {number} [spoils.voxels] heights and pixels come in steps of one of so many along a side
 * @param {number} [spoils.facets] linear between so many points along a side, as on a coarse mesh
 * @param {(x: number, y: number) => boolean} [spoils.hole] where there is no data
 * @param {number} [spoils.dropouts] share of pixels without data
 * @param {boolean} [spoils.known] whether it is the surface without these that is looked for
 * @returns {Input}
 */
export function sampled(name, heights, size, { noise = 0, voxels, facets, hole, dropouts = 0, known = noise > 0 || voxels !== undefined } = {}) {
  const truth = image(heights, size);
  const given = voxels ? image(inVoxels(heights, voxels), size) : facets ? image(inFacets(heights, facets), size) : truth;
  const random = generator(17);
  const range = rangeOf(truth);
  const data = given.map((z, i) => {
    const noisy = z + noise * range * gauss(random);
    const [x, y] = placeOf(i, size);
    return hole?.(x, y) || random() < dropouts ? NaN : noisy;
  });
  return { name, width: size, height: size, data, pixelSize: 1 / size, heightScale: 1, ...(known && { truth }) };
}

/**
 * A design: the surface passes through what is held, and is free elsewhere.
 * @param {string} name
 * @param {Heights} heights
 * @param {number} size
 * @param {(x: number, y: number) => boolean} held
 * @returns {Input}
 */
export function designed(name, heights, size, held) {
  const data = image(heights, size).map((z, i) => (held(...placeOf(i, size)) ? z : NaN));
  return { name, width: size, height: size, data, pixelSize: 1 / size, heightScale: 1, design: true };
}

/** @param {Heights} heights @param {number} size */
function image(heights, size) {
  return Float64Array.from({ length: size * size }, (_, i) => heights(...placeOf(i, size)));
}

/** From the middle, y up. @param {number} i @param {number} size @returns {[number, number]} */
function placeOf(i, size) {
  return [(i % size + 0.5) / size - 0.5, 0.5 - (Math.floor(i / size) + 0.5) / size];
}

/** @param {Heights} heights @param {number} count @returns {Heights} */
function inVoxels(heights, count) {
  const middle = (/** @type {number} */ at) => (Math.floor(at * count) + 0.5) / count;
  return (x, y) => Math.round(heights(middle(x), middle(y)) * count) / count;
}

/** @param {Heights} heights @param {number} count @returns {Heights} */
function inFacets(heights, count) {
  return (x, y) => {
    const [u, v] = [(x + 0.5) * count, (y + 0.5) * count];
    const [i, j] = [Math.floor(u), Math.floor(v)];
    const [s, t] = [u - i, v - j];
    const at = (/** @type {number} */ a, /** @type {number} */ b) => heights(a / count - 0.5, b / count - 0.5);
    return s + t < 1
      ? at(i, j) + s * (at(i + 1, j) - at(i, j)) + t * (at(i, j + 1) - at(i, j))
      : at(i + 1, j + 1) + (1 - s) * (at(i, j + 1) - at(i + 1, j + 1)) + (1 - t) * (at(i + 1, j) - at(i + 1, j + 1));
  };
}

/** @param {Float64Array} values */
function rangeOf(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return high - low;
}

/** Numbers between 0 and 1, the same for the same seed. @param {number} seed */
function generator(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Normally distributed, by Box and Muller. @param {() => number} random */
function gauss(random) {
  return Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
}
