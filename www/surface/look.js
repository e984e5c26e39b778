/** What the page needs of heights to show them, made in one go, in a worker where there are many. */
import { coarse } from './coarse.js';
import { HOLE, normalsOf, UNIT } from './normals.js';
import { NO_HEIGHT } from './shaders.js';

/** @import {Normals} from './normals.js' */

/**
 * Heights and normals as textures, at most so fine as any screen shows.
 * @typedef {object} Texels
 * @property {number} width
 * @property {number} height
 * @property {Float32Array} heights in lengths, or none
 * @property {Float32Array} slopes x and y of normals
 */

/** Texels along the longer side of a surface. A larger texture may be refused, too. */
const MOST = 2048;
/** Pixels along the longer side of the finest preview. */
export const PREVIEW = 384;

/** @typedef {{ normals: Normals, texels: Texels }} Look */

/**
 * @param {ArrayLike<number>} heights
 * @param {number} width
 * @param {number} height
 * @param {number} heightScale
 * @param {number} pixelSize
 * @returns {Look}
 */
export function lookedAt(heights, width, height, heightScale, pixelSize) {
  const normals = normalsOf(heights, width, height, heightScale / pixelSize);
  return { normals, texels: texelsOf(normals, heights, heightScale) };
}

/**
 * The same of an input, and its coarser picture.
 * @param {Parameters<typeof lookedAt>} args
 */
export function firstLook(...args) {
  const [data, width, height] = args;
  return { ...lookedAt(...args), small: small({ width, height, data }) };
}

/** What previews are made of. @param {import('./coarse.js').Heights} heights */
export function small(heights) {
  return coarse(heights, PREVIEW);
}

/**
 * @param {Normals} normals
 * @param {ArrayLike<number>} heights of the same pixels, NaN for none
 * @param {number} heightScale
 * @returns {Texels}
 */
export function texelsOf(normals, heights, heightScale) {
  const step = Math.ceil(Math.max(normals.width, normals.height) / MOST);
  const [width, height] = [Math.floor(normals.width / step), Math.floor(normals.height / step)];
  const { xy } = normals;
  const values = new Float32Array(width * height);
  const slopes = new Float32Array(2 * width * height);
  for (let i = 0; i < values.length; i++) {
    const from = step === 1 ? i : Math.floor(i / width) * step * normals.width + (i % width) * step;
    const hole = xy[2 * from] === HOLE;
    values[i] = hole ? NO_HEIGHT : heights[from] * heightScale;
    if (hole) continue;
    slopes[2 * i] = xy[2 * from] / UNIT;
    slopes[2 * i + 1] = xy[2 * from + 1] / UNIT;
  }
  return { width, height, heights: values, slopes };
}
