/** What is laid flat, and photos of it: checked as far as JS has to. */
import { DevelopableError } from './errors.js';
import { cells, count } from './input.js';
import { optionsOf } from './options.js';
import { record, typeOf, viewOf } from './values.js';

/**
 * @typedef {import('./types.js').HeightImage | import('./types.js').Heightfield} Heights
 * @typedef {{ width: number, height: number, data: Uint8Array }} Pixels
 */

/**
 * A photo, such as an `ImageData`, with its bytes as a view of their own. Other things that it says are its own matter:
 * photos come from many libraries.
 * @param {unknown} photo
 * @returns {Pixels}
 */
export function asPhoto(photo) {
  const said = record('INPUT', 'the photo', photo, ['width', 'height', 'data']);
  if (!['Uint8Array', 'Uint8ClampedArray'].includes(typeOf(said.data) ?? '')) {
    throw new DevelopableError(
      'INPUT',
      'the photo must be { width, height, data } with RGBA bytes in a Uint8ClampedArray or Uint8Array, as an ImageData',
    );
  }
  const [width, height] = [count('width of the photo', said.width), count('height of the photo', said.height)];
  const { buffer, byteOffset, length } = viewOf('data of the photo', said.data);
  const expected = 4 * cells('the photo', width, height);
  if (length !== expected) {
    throw new DevelopableError('SHAPE', `the photo has ${length} bytes where ${width} × ${height} pixels need ${expected}`);
  }
  return { width, height, data: new Uint8Array(buffer, byteOffset, length) };
}

/**
 * The options of a call about photos or pictures, with the part of the plane that they show where the surface knows the
 * image it was made from.
 * @template {{ extent?: import('./types.js').DewarpOptions['extent'] }} T
 * @param {'dewarp' | 'picture'} call
 * @param {Heights} input
 * @param {T | undefined} given
 * @returns {Partial<T>}
 */
export function placedOptions(call, input, given) {
  const options = optionsOf(call, given);
  return options.extent === undefined ? { ...options, extent: extentOf(input) } : options;
}

/**
 * The part of the plane that a surface's image shows, if it has one.
 * @param {Heights} input
 * @returns {[number, number, number, number] | undefined}
 */
export function extentOf(input) {
  const { heights, image } = record('INPUT', 'the input', input, ['heights', 'image']);
  if (heights === undefined || image === undefined) return undefined;
  const { width, height, pixelSize = 1 } = record('INPUT', 'the image', image, ['width', 'height', 'pixelSize']);
  const size = [count('width', width), count('height', height), Number(pixelSize)];
  return [0, 0, size[0] * size[2], size[1] * size[2]];
}
