/** Reads and reduces pictures in the page's worker. */
import { callWorker } from './surface/worker-client.js';

/** @typedef {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} Pixels RGBA */

/**
 * Reads a picture of any format that the browser supports.
 * @param {File} file
 * @param {number} [maxPixels] maximum number of pixels; a larger picture is reduced
 */
export async function readPicture(file, maxPixels) {
  const { width, height, data } = await callWorker('decodePicture', file, maxPixels);
  return new ImageData(data, width, height);
}

/**
 * Reduces a photo.
 * @param {Pixels} pixels
 * @param {number} scale factor of its sides, at most 1
 */
export async function reducedPhoto(pixels, scale) {
  const { width, height, data } = await callWorker('reducePhoto', pixels, scale);
  return new ImageData(data, width, height);
}
