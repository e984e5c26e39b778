/** What is known of depths besides: checked as far as JS has to, in arrays of the types that Rust reads. */
import { DevelopableError } from './errors.js';
import { cells, count, largestOf, numbers } from './input.js';
import { optionsOf } from './options.js';
import { record, show } from './values.js';

/** The levels that a phone's sensor tells (ARKit): not to be trusted, a little, and fully. */
const LEVELS = [0, 0.25, 1];

/**
 * @param {import('./types.js').DepthOptions | undefined} given
 * @returns {import('./types.js').DepthOptions}
 */
export function asDepthOptions(given) {
  const { confidence, mask, crop, photo, ...rest } = optionsOf('depths', given);
  if (crop !== undefined && photo === undefined) {
    throw new DevelopableError('OPTION', 'option `crop` is about a photo: pass its size as `photo`, or the photo itself');
  }
  return {
    ...rest,
    ...(crop && { crop }),
    ...(photo !== undefined && { photo: sizeOf('the photo', photo) }),
    ...(mask !== undefined && { mask: asFlags(mask) }),
    ...(confidence !== undefined && { confidence: asConfidence(confidence) }),
  };
}

/** @param {string} what @param {unknown} image */
function sizeOf(what, image) {
  const { width, height } = record('INPUT', what, image, ['width', 'height']);
  return { width: count(`width of ${what}`, width), height: count(`height of ${what}`, height) };
}

/** The types of arrays of integers, as `read` names those of a file. @type {Record<string, string>} */
const TYPES = {
  Uint8Array: 'u8', Uint8ClampedArray: 'u8', Int8Array: 'i8', Uint16Array: 'u16', Int16Array: 'i16', Uint32Array: 'u32', Int32Array: 'i32',
};

/** An image of any numbers, and their type in its file, if they are integers or that is known. @param {string} what @param {unknown} image */
function imageOf(what, image) {
  const size = sizeOf(what, image);
  const { data, dataType } = record('INPUT', what, image, ['data', 'dataType']);
  const values = numbers(`data of ${what}`, data);
  const expected = cells(what, size.width, size.height);
  if (values.length === expected) return { size, data: values, dataType: typeof dataType === 'string' ? dataType : TYPES[values.constructor.name] };
  throw new DevelopableError(
    'SHAPE',
    `${what} has ${values.length} values where ${size.width} × ${size.height} pixels need ${expected}`,
  );
}

/** @param {unknown} image */
function asFlags(image) {
  const { size, data } = imageOf('the mask', image);
  return { ...size, data: Uint8Array.from(data, (value) => (value === 0 || Number.isNaN(value) ? 0 : 1)) };
}

/**
 * Levels 0, 1 and 2, or shares of the largest value of their type, as factors of the fidelity; floats are these already.
 * @param {unknown} image
 */
function asConfidence(image) {
  const { size, data, dataType } = imageOf('the confidence', image);
  const white = largestOf(dataType);
  let largest = 0;
  for (const value of data) if (value > largest) largest = value;
  const levels = white !== undefined && largest < LEVELS.length;
  const weights = Float32Array.from(data, (value) => (levels ? LEVELS[value] ?? 0 : value / (white ?? 1)) || 0);
  const odd = weights.findIndex((weight) => weight < 0 || weight > 1);
  if (odd < 0) return { ...size, data: weights };
  throw new DevelopableError(
    'INPUT',
    `the confidence is ${show(data[odd])} at row ${Math.floor(odd / size.width)}, column ${odd % size.width}, but floats must be from 0 to 1`,
  );
}
