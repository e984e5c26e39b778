/** Pictures as pixels, in a worker. */
import { greyOf } from '../page/grey.js';

/** @import {Pixels} from '../pixels.js' */

/**
 * @param {File} file
 * @param {number} [times] by which the sides are reduced
 * @returns {Promise<Pixels>}
 */
export async function pictureOf(file, times = 1) {
  const bitmap = await createImageBitmap(file).catch(() => {
    throw new Error('it is no picture that this browser can read');
  });
  const pixels = drawn(bitmap, bitmap.width / times, bitmap.height / times);
  bitmap.close();
  return pixels;
}

/**
 * A photo on fewer pixels, in colour and in grey.
 * @param {Pixels} pixels
 * @param {number} scale
 */
export async function photoAt({ width, height, data }, scale) {
  const bitmap = await createImageBitmap(new ImageData(data, width, height));
  const small = drawn(bitmap, width * scale, height * scale);
  bitmap.close();
  return { ...small, grey: greyOf(small, scale).data };
}

/**
 * @param {ImageBitmap} bitmap
 * @param {number} wide what the whole picture is drawn to
 * @param {number} high
 * @returns {Pixels} whole pixels, so that both directions have the same scale
 */
function drawn(bitmap, wide, high) {
  const [width, height] = [Math.floor(wide), Math.floor(high)];
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (!context) throw new Error('the browser gives no canvas of that size');
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, wide, high);
  return { width, height, data: context.getImageData(0, 0, width, height).data };
}
