/** Normals, textures and reduced heights with which a surface is shown. */
import { downsample } from './downsampling.js';
import { NO_NORMAL, normalsOf, NORMAL_SCALE } from './normals.js';
import { NO_HEIGHT } from './shaders.js';

/** @import {Normals} from './normals.js' */

/**
 * Heights and normals as textures, with at most {@link MAX_TEXTURE_SIDE_TEXELS} along a side.
 * @typedef {object} SurfaceTextures
 * @property {number} width
 * @property {number} height
 * @property {Float32Array} heights in the unit of length; `NO_HEIGHT` where there is none
 * @property {Float32Array} slopes x and y of the unit normals
 */

/** Maximum length of a texture's longer side: about the pixels of a screen, and a size that every graphics card accepts. */
const MAX_TEXTURE_SIDE_TEXELS = 2048;
/** Length of the longer side of the finest preview. */
export const PREVIEW_SIDE_PIXELS = 384;

/** @typedef {{ normals: Normals, textures: SurfaceTextures }} SurfaceData */

/**
 * Computes the normals and textures of heights.
 * @param {ArrayLike<number>} heights
 * @param {number} width
 * @param {number} height
 * @param {number} heightScale unit of length per unit of the heights
 * @param {number} pixelSize
 * @returns {SurfaceData}
 */
export function computeSurfaceData(heights, width, height, heightScale, pixelSize) {
  const normals = normalsOf(heights, width, height, heightScale / pixelSize);
  return { normals, textures: toTextures(normals, heights, heightScale) };
}

/**
 * Computes normals, textures and reduced heights for previews.
 * @param {Parameters<typeof computeSurfaceData>} args
 */
export function computeSurfaceDataAndPreview(...args) {
  const [data, width, height] = args;
  return { ...computeSurfaceData(...args), small: reduceForPreview({ width, height, data }) };
}

/** Reduces heights for previews. @param {import('./downsampling.js').Heights} heights */
export function reduceForPreview(heights) {
  return downsample(heights, PREVIEW_SIDE_PIXELS);
}

/**
 * Converts normals and heights to textures: every `step`-th pixel if there are too many.
 * @param {Normals} normals
 * @param {ArrayLike<number>} heights of the same pixels, NaN for no data
 * @param {number} heightScale
 * @returns {SurfaceTextures}
 */
export function toTextures(normals, heights, heightScale) {
  const step = Math.ceil(Math.max(normals.width, normals.height) / MAX_TEXTURE_SIDE_TEXELS);
  const [width, height] = [Math.floor(normals.width / step), Math.floor(normals.height / step)];
  const { xy } = normals;
  const values = new Float32Array(width * height);
  const slopes = new Float32Array(2 * width * height);
  for (let i = 0; i < values.length; i++) {
    const from = step === 1 ? i : Math.floor(i / width) * step * normals.width + (i % width) * step;
    const hole = xy[2 * from] === NO_NORMAL;
    values[i] = hole ? NO_HEIGHT : heights[from] * heightScale;
    if (hole) continue;
    slopes[2 * i] = xy[2 * from] / NORMAL_SCALE;
    slopes[2 * i + 1] = xy[2 * from + 1] / NORMAL_SCALE;
  }
  return { width, height, heights: values, slopes };
}
