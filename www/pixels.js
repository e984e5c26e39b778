/** Reads and reduces pictures in the page's worker. */
import { callWorker } from './surface/worker-client.js';

/** @typedef {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} Pixels RGBA */

/**
 * The pixels of a picture, which may be a file of any format that the browser supports.
 * @param {File | Pixels} picture
 * @param {{ scale?: number, maxPixels?: number }} [size] factor of its sides, at most 1; maximum number of pixels
 */
export async function readPicture(picture, size) {
  const { width, height, data } = await callWorker('decodePicture', picture, size);
  return new ImageData(data, width, height);
}
