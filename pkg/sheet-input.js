/** What is laid flat, and photos of it: checked as far as JS has to. */
import { asOptions } from './control.js';
import { DevelopableError } from './errors.js';

/**
 * @typedef {import('./types.js').HeightImage | import('./types.js').Heightfield} Heights
 * @typedef {{ width: number, height: number, data: Uint8Array }} Pixels
 */

/**
 * A photo, such as an `ImageData`, with its bytes as a view of their own.
 * @param {import('./types.js').Photo} photo
 * @returns {Pixels}
 */
export function asPhoto(photo) {
  const { width, height, data } = Object(photo);
  const sound = Number.isSafeInteger(width) && Number.isSafeInteger(height) && width >= 0 && height >= 0;
  if (!sound || !(data instanceof Uint8Array || data instanceof Uint8ClampedArray)) {
    throw new DevelopableError(
      'INPUT',
      'the photo must be { width, height, data } with RGBA bytes in a Uint8ClampedArray or Uint8Array, as an ImageData',
    );
  }
  return { width, height, data: new Uint8Array(data.buffer, data.byteOffset, data.byteLength) };
}

/**
 * The options of a dewarping, with the part of the plane that the photo shows where the surface
 * knows the image it was made from.
 * @param {Heights} input
 * @param {import('./types.js').DewarpOptions} [given]
 * @returns {import('./types.js').DewarpOptions}
 */
export function dewarpOptions(input, given) {
  const options = asOptions(given);
  const { heights, image } = /** @type {Partial<import('./types.js').Surface>} */ (Object(input));
  if (options.extent !== undefined || heights === undefined || image === undefined) return options;
  const { width, height, pixelSize = 1 } = image;
  return { ...options, extent: [0, 0, width * pixelSize, height * pixelSize] };
}
