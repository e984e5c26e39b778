/** Decodes and reduces photos by the browser, in a worker. */

/** @import {Pixels} from '../pixels.js' */

/**
 * Decodes a picture.
 * @param {File} file
 * @param {number} [maxPixels] maximum number of pixels; a larger picture is reduced
 * @returns {Promise<Pixels>}
 */
export async function decodePicture(file, maxPixels = Infinity) {
  const bitmap = await createImageBitmap(file).catch(() => {
    throw new Error('it is no picture that this browser can read');
  });
  const scale = Math.min(1, Math.sqrt(maxPixels / (bitmap.width * bitmap.height)));
  const pixels = drawPixels(bitmap, bitmap.width * scale, bitmap.height * scale);
  bitmap.close();
  return pixels;
}

/**
 * Reduces a photo.
 * @param {Pixels} pixels
 * @param {number} scale
 */
export async function reducePhoto({ width, height, data }, scale) {
  const bitmap = await createImageBitmap(new ImageData(data, width, height));
  const small = drawPixels(bitmap, width * scale, height * scale);
  bitmap.close();
  return small;
}

/**
 * Draws a bitmap at a size and returns its pixels. The size is rounded down, but not the scale, so that both directions have the
 * same scale.
 * @param {ImageBitmap} bitmap
 * @param {number} wide
 * @param {number} high
 * @returns {Pixels}
 */
function drawPixels(bitmap, wide, high) {
  const [width, height] = [Math.floor(wide), Math.floor(high)];
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (!context) throw new Error('the browser gives no canvas of that size');
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, wide, high);
  return { width, height, data: context.getImageData(0, 0, width, height).data };
}
