/** Reads and reduces pictures in the page's worker. */
import { isHeic, stemOf } from './file-kinds.js';
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

/** Photos in HEIC as JPEG, and all other files as they are; so is what cannot be read, which its reader names. @param {readonly File[]} files */
export const withoutHeic = (files) => Promise.all(files.map(async (file) => {
  if (!isHeic(file)) return file;
  const jpeg = await callWorker('jpegOfHeic', file).catch(() => null);
  return jpeg ? new File([jpeg], `${stemOf(file)}.jpg`, { type: 'image/jpeg', lastModified: file.lastModified }) : file;
}));
