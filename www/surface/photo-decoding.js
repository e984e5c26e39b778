/** Decodes and reduces pictures by the browser, in a worker. */

/** @import {Pixels} from '../pixels.js' */

/**
 * The pixels of a picture. Their numbers are rounded down, but not the scale, so that both directions have the same scale.
 * @param {File | Pixels} picture
 * @param {{ scale?: number, maxPixels?: number }} [size] factor of its sides, at most 1; maximum number of pixels
 * @returns {Promise<Pixels>}
 */
export async function decodePicture(picture, { scale = 1, maxPixels = Infinity } = {}) {
  const bitmap = await createImageBitmap(picture instanceof File ? picture : new ImageData(picture.data, picture.width, picture.height)).catch(() => {
    throw new Error('it is no picture that this browser can read');
  });
  const factor = Math.min(scale, Math.sqrt(maxPixels / (bitmap.width * bitmap.height)));
  const [wide, high] = [bitmap.width * factor, bitmap.height * factor];
  const [width, height] = [Math.floor(wide), Math.floor(high)];
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (!context) throw new Error('the browser gives no canvas of that size');
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, wide, high);
  bitmap.close();
  return { width, height, data: context.getImageData(0, 0, width, height).data };
}
