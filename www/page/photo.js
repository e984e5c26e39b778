/** A photo that was opened: its pixels once, and a reduced copy of them to show and to look for edges in. */
import { greyOf } from './grey.js';

/** @import {Api} from '../api.js' */
/** @import {Grey} from './grey.js' */

/** Pixels along the longer side of the reduced copy, at most. */
const SMALL = 1280;

/**
 * @typedef {object} PagePhoto
 * @property {string} name of its file, without its ending
 * @property {number} width
 * @property {number} height
 * @property {Uint8ClampedArray<ArrayBuffer>} data
 * @property {number} [film35] focal length as for a film of 36 by 24 mm, where its file tells it
 * @property {ImageData} small
 * @property {Grey} grey the same, whose `scale` is its pixels for one of the photo
 */

/**
 * @param {InstanceType<Api['DevelopableWorker']>} worker
 * @param {File} file
 * @returns {Promise<PagePhoto>}
 */
export async function openPhoto(worker, file) {
  const photo = await worker.readPhoto(file).catch((/** @type {unknown} */ error) => byBrowser(file, error));
  return photoOf(photo, file.name.replace(/\.[^.]*$/, '') || 'photo');
}

/**
 * @param {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer>, film35?: number }} pixels
 * @param {string} name
 * @returns {Promise<PagePhoto>}
 */
export async function photoOf({ width, height, data, film35 }, name) {
  if (width < 16 || height < 16) throw new Error(`it is ${width} × ${height} pixels, too few to show a page`);
  const scale = Math.min(1, SMALL / Math.max(width, height));
  const bitmap = await createImageBitmap(new ImageData(data, width, height));
  // To the whole pixel of the smaller one, that both directions have the same scale.
  const small = drawn(bitmap, Math.floor(width * scale), Math.floor(height * scale), width * scale, height * scale);
  bitmap.close();
  return { name, width, height, data, film35, small, grey: greyOf(small, scale) };
}

/**
 * Pictures of kinds that the package does not read, or why it could not.
 * @param {File} file
 * @param {unknown} error
 */
async function byBrowser(file, error) {
  const bitmap = await createImageBitmap(file).catch(() => {
    throw error;
  });
  const pixels = drawn(bitmap, bitmap.width, bitmap.height, bitmap.width, bitmap.height);
  bitmap.close();
  return pixels;
}

/**
 * @param {ImageBitmap} bitmap
 * @param {number} width
 * @param {number} height
 * @param {number} wide what the whole picture is drawn to
 * @param {number} high
 */
function drawn(bitmap, width, height, wide, high) {
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) throw new Error('the browser gives no canvas of that size');
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, wide, high);
  return context.getImageData(0, 0, width, height);
}
