/** Pictures as pixels: read and reduced in the page's worker. */
import { work } from './surface/work.js';

/** @typedef {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} Pixels RGBA */

/**
 * Whatever pictures the browser knows.
 * @param {File} file
 * @param {number} [times] by which the sides are reduced
 */
export async function pixelsOf(file, times) {
  const { width, height, data } = await work('pictureOf', file, times);
  return new ImageData(data, width, height);
}

/**
 * @param {Pixels} pixels
 * @param {number} scale at most 1
 */
export async function reducedPhoto(pixels, scale) {
  const { width, height, data, grey } = await work('photoAt', pixels, scale);
  return { small: new ImageData(data, width, height), grey: { width, height, scale, data: grey } };
}
