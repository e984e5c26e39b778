/** What is laid flat, and photos of it: checked as far as JS has to. */
import { DevelopableError } from './errors.js';
import { asBytes, cells, count } from './input.js';
import { optionsOf } from './options.js';
import { asText, reading, record, show, typeOf, viewOf } from './values.js';

/**
 * @typedef {import('./types.js').HeightImage | import('./types.js').Heightfield} Heights
 * @typedef {{ width: number, height: number, data: Uint8Array }} Pixels
 */

/** Largest number of pages of one PDF, and of words of one page. */
const MAX_BOOK_ITEMS = 100_000;

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
  if (options.extent !== undefined) return options;
  const extent = extentOf(input);
  return extent === undefined ? options : { ...options, extent };
}

/**
 * The options of writing a photo, with the resolution that it states itself, as a flat image does.
 * @param {import('./types.js').SizedPhoto} photo
 * @param {(import('./types.js').WritePhotoOptions & import('./index.js').HandOver) | undefined} given
 */
export function printOptions(photo, given) {
  const options = optionsOf('writePhoto', given);
  if (options.dotsPerMillimetre !== undefined) return options;
  const { resolution, unit } = record('INPUT', 'the photo', photo, ['resolution', 'unit']);
  const millimetres = { mm: 1, m: 1000 }[String(unit)];
  if (typeof resolution === 'number' && millimetres !== undefined) {
    return { ...options, dotsPerMillimetre: resolution / millimetres };
  }
  if (options.format !== 'pdf') return options;
  throw new DevelopableError(
    'INPUT',
    'a PDF has its true size, and nothing says how large this picture is: pass `dotsPerMillimetre`, or a picture that was ' +
      'made flat where the unit of lengths is known (`unit` of depths and heights, `page` or `ruler` of a page by its edges)',
  );
}

/**
 * The pages of a book, each a picture's file, the size of its page in millimetres, and the words in its picture.
 * @param {unknown} given
 */
export function asBook(given) {
  return listOf('the pages', '{ picture, size }', given, (page, i) => {
    const name = `page ${i + 1}`;
    const { picture, size, words = [] } = record('INPUT', name, page, ['picture', 'size', 'words']);
    const sides = tuple(size, 2);
    if (!sides?.every((side) => side > 0)) {
      throw new DevelopableError('INPUT', `the size of ${name} must be its width and height in millimetres, but is ${show(size)}`);
    }
    return {
      picture: asBytes(/** @type {Uint8Array} */ (picture)),
      size: /** @type {[number, number]} */ (sides),
      words: listOf(`the words of ${name}`, '{ text, box }', words, (word, k) => asWord(`word ${k + 1} of ${name}`, word)),
    };
  });
}

/** A word with its box in a picture. @param {string} name @param {unknown} given */
function asWord(name, given) {
  const { text, box } = record('INPUT', name, given, ['text', 'box']);
  const bounds = tuple(box, 4);
  if (bounds === undefined) {
    throw new DevelopableError('INPUT', `the box of ${name} must be its left, top, width and height in pixels of the picture, but is ${show(box)}`);
  }
  return { text: asText('INPUT', `the text of ${name}`, text), box: bounds };
}

/**
 * The items of a list of pages or words, each read by a function of it and its index.
 * @template T
 * @param {string} what
 * @param {string} item what its items must be
 * @param {unknown} given
 * @param {(item: unknown, index: number) => T} read
 */
function listOf(what, item, given, read) {
  return reading('INPUT', what, () => {
    if (!Array.isArray(given)) throw new DevelopableError('INPUT', `${what} must be a list of ${item}`);
    if (given.length > MAX_BOOK_ITEMS) throw new DevelopableError('TOO_LARGE', `${what} are more than ${MAX_BOOK_ITEMS}, which is the limit`);
    return Array.from(given, read);
  });
}

/** A list of so many finite numbers; undefined if it is another thing. @param {unknown} given @param {number} count */
function tuple(given, count) {
  if (!Array.isArray(given) || given.length !== count) return undefined;
  const values = Array.from(given);
  return values.length === count && values.every(Number.isFinite) ? values : undefined;
}

/**
 * What says where in a photo the points of a field are: a camera, texture coordinates or a part of the plane.
 * @param {import('./input.js').Image | import('./input.js').Lattice} field
 * @param {import('./types.js').DewarpOptions} options
 */
export function placeOf(field, { camera, extent }) {
  if (camera !== undefined && extent !== undefined) {
    throw new DevelopableError('OPTION', 'option `extent` is for photos taken straight from above: leave it or `camera` out');
  }
  if (field.kind === 'image') {
    if (camera === undefined) return {};
    throw new DevelopableError(
      'OPTION',
      'option `camera` is for what a camera has seen, and the heights are those of an image: make a mesh of its depths ' +
        'with `backProject`, and heights of that with `sampleMesh`',
    );
  }
  const { frame, uvs, camera: own } = field;
  if (extent !== undefined) return {};
  const seen = camera ?? own;
  if (seen !== undefined) return { camera: seen, frame };
  if (uvs !== undefined) return { uvs };
  if (frame === undefined) return {};
  throw new DevelopableError(
    'INPUT',
    'nothing says where in the photo the points of this mesh are: pass the `camera` that took it, a mesh with texture ' +
      'coordinates, or the `extent` that a photo taken straight from above shows',
  );
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
