/**
 * Inputs: checked as far as JS has to, and copied field by field, but for the numbers in typed arrays, which are read in
 * place. Shapes and values are checked in Rust, where the messages know the most.
 */
import { DevelopableError } from './errors.js';
import { optionsOf } from './options.js';
import { isRecord, plainCopy, reading, record, refuseMisspelled, show, typeOf, viewOf } from './values.js';

/**
 * @typedef {import('./types.js').HeightImage} HeightImage
 * @typedef {import('./types.js').Heightfield} Heightfield
 * @typedef {import('./values.js').NumericArray} NumericArray
 * @typedef {{ confidence?: NumericArray, constraints?: NumericArray }} Known
 * @typedef {HeightImage & Known & { kind: 'image', data?: NumericArray }} Image
 * @typedef {Heightfield & Known & { kind: 'lattice', heights?: NumericArray }} Lattice
 */

/** The arrays that an input may have. */
const ARRAYS = [
  'data', 'heights', 'mask', 'confidence', 'constraints', 'occlusions', 'brokenEdges', 'colors', 'uvs', 'texture',
];

/** What an image and heights on the lattice may both have; `kind` is what tells them apart once they are checked. */
const COMMON = /** @type {const} */ (['kind', 'mask', 'noData', 'confidence', 'constraints', 'occlusions', 'unit']);

const IMAGE = /** @type {const} */ ([...COMMON, 'width', 'height', 'data', 'pixelSize', 'heightScale', 'georeference']);

const LATTICE = /** @type {const} */ ([
  ...COMMON, 'rows', 'cols', 'spacing', 'origin', 'heights', 'brokenEdges', 'frame', 'camera', 'colors', 'uvs', 'texture',
]);

/** What results have that are inputs in turn: of `read`, and of `fit`. */
const RESULTS = { image: ['format', 'dataType', 'assumptions'], lattice: ['image', 'georeference', 'pixelDistance', 'report', 'hidden', 'noNoise'] };

const SHAPES =
  'an image ({ width, height, data }) or heights on the lattice ({ rows, cols, spacing, heights }), ' +
  'with constraints in the place of data or heights if there is nothing else';

/**
 * What an image or a lattice says, each property read once.
 * @param {unknown} input
 */
function read(input) {
  const said = record('INPUT', 'the input', isRecord(input) ? input : {}, [...IMAGE, ...LATTICE, 'image']);
  const lattice = said.heights !== undefined || (said.data === undefined && said.rows !== undefined);
  const known = lattice ? [...LATTICE, ...RESULTS.lattice] : [...IMAGE, ...RESULTS.image, 'brokenEdges'];
  refuseMisspelled(lattice ? 'the heights on the lattice' : 'the image', input, known, [...IMAGE, ...LATTICE]);
  return { said, lattice };
}

/** @typedef {ReturnType<typeof read>['said']} Said */

/**
 * What can be solved: heights, and all that is known about them, or constraints alone.
 * @param {HeightImage | Heightfield} input
 * @returns {Image | Lattice}
 */
export function asInput(input) {
  const { said, lattice } = read(input);
  if (said.data === undefined && said.heights === undefined && said.constraints === undefined) {
    throw new DevelopableError('INPUT', `the input must be ${SHAPES}`);
  }
  return lattice ? latticeInput(said) : imageInput(said);
}

/**
 * Heights, without what else may be known about them.
 * @param {HeightImage | Heightfield} input
 * @param {string} [others] what else it may be, in words
 * @returns {Image | Lattice}
 */
export function asField(input, others = '') {
  const { said } = read(input);
  if (said.heights !== undefined) return latticeHeights(said);
  if (said.data !== undefined) return imageHeights(said);
  throw new DevelopableError(
    'INPUT',
    `there must be heights: an image ({ width, height, data }) or a lattice ({ rows, cols, spacing, heights })${others}`,
  );
}

/**
 * @param {HeightImage} input
 * @returns {Image}
 */
export function asImage(input) {
  const { said, lattice } = read(input);
  if (!lattice) return imageHeights(said);
  throw new DevelopableError('INPUT', 'there must be an image ({ width, height, data }), and these are heights on the lattice');
}

/**
 * An image that is to be written, or the one that a surface has. An array takes heights on the lattice as well.
 * @param {HeightImage | Heightfield | import('./types.js').Surface} input
 * @param {import('./schema/image-files.js').ImageFile} format
 * @returns {Image}
 */
export function asPixels(input, format) {
  const { said, lattice } = read(input);
  if (!lattice) return imageHeights(said);
  if (said.image !== undefined) return { ...asImage(/** @type {HeightImage} */ (said.image)), georeference: mapOf(said) };
  if (format === 'npy') {
    const { rows: height, cols: width, heights: data, mask, noData } = latticeHeights(said);
    return { kind: 'image', width, height, data, mask, noData };
  }
  throw new DevelopableError(
    'INPUT',
    'there must be pixels, and these are heights on the lattice that were no image: NPY and the meshes take them; ' +
      'or pass { width: cols, height: rows, data: heights, pixelSize: spacing } to write its rows as they are',
  );
}

/**
 * @param {Heightfield} input
 * @returns {Lattice}
 */
export function asLattice(input) {
  const { said, lattice } = read(input);
  if (lattice) return latticeHeights(said);
  throw new DevelopableError(
    'INPUT',
    'there must be heights on the lattice ({ rows, cols, spacing, heights }), as `fit` gives them',
  );
}

/**
 * Heights and how far they are to be trusted, and nothing that a surface would have to keep to besides.
 * @param {Heightfield} input
 * @returns {Lattice}
 */
export function asHeights(input) {
  const { said, lattice } = read(input);
  const beyond = ['constraints', 'occlusions', 'brokenEdges'].find((name) => said[/** @type {keyof Said} */ (name)] !== undefined);
  if (lattice && said.heights !== undefined && beyond === undefined) return latticeInput(said);
  throw new DevelopableError(
    'INPUT',
    beyond === undefined ? 'there must be heights on the lattice ({ rows, cols, spacing, heights }), as `sampleMesh` gives them'
      : `a cylinder cannot keep to ${beyond}: leave them out, or use \`fit\``,
  );
}

/** @param {Said} said @returns {Image} */
function imageHeights(said) {
  return { ...pixels(said), data: numbers('data', said.data), georeference: mapOf(said) };
}

/** Where pixels lie on a map, if that is known. @param {Said} said */
function mapOf({ georeference }) {
  return georeference == null ? undefined : /** @type {import('./types.js').Georeference} */ (plainCopy('georeference', georeference));
}

/** @param {Said} said @returns {Lattice} */
function latticeHeights(said) {
  return { ...vertices(said), heights: numbers('heights', said.heights) };
}

/** @param {Said} said @returns {Image} */
function imageInput(said) {
  if (said.brokenEdges !== undefined) {
    throw new DevelopableError('INPUT', 'brokenEdges are for heights on the lattice: an image has none of its edges');
  }
  const data = said.data === undefined ? undefined : numbers('data', said.data);
  return { ...pixels(said), data, georeference: mapOf(said), ...known(said, data === undefined) };
}

/** @param {Said} said @returns {Lattice} */
function latticeInput(said) {
  const heights = said.heights === undefined ? undefined : numbers('heights', said.heights);
  const brokenEdges = flags('brokenEdges', said.brokenEdges);
  return { ...vertices(said), heights, ...known(said, heights === undefined), brokenEdges };
}

/** An image without what is at its pixels. @param {Said} said */
function pixels({ width, height, mask, noData, pixelSize, heightScale, unit }) {
  const size = { width: count('width', width), height: count('height', height) };
  cells('the image', size.width, size.height);
  return {
    kind: /** @type {const} */ ('image'),
    ...size,
    mask: flags('mask', mask),
    noData: optional('noData', noData),
    pixelSize: optional('pixelSize', pixelSize),
    heightScale: optional('heightScale', heightScale),
    unit: unitOf(unit),
  };
}

/** A lattice without what is at its vertices. @param {Said} said */
function vertices({ rows, cols, spacing, origin, mask, noData, unit, frame, camera, colors, uvs, texture }) {
  const size = { rows: count('rows', rows), cols: count('cols', cols) };
  const total = cells('the lattice', size.rows, size.cols);
  return {
    kind: /** @type {const} */ ('lattice'),
    ...size,
    spacing: number('spacing', spacing),
    origin: origin === undefined ? undefined : /** @type {[number, number]} */ (tuple('origin', 2, origin)),
    mask: flags('mask', mask),
    noData: optional('noData', noData),
    unit: unitOf(unit),
    frame: frame === undefined ? undefined : asFrame(frame),
    camera: camera === undefined ? undefined : asCamera(camera),
    colors: each('colors', 3, total, optionalFloats('colors', colors)),
    uvs: each('uvs', 2, total, optionalFloats('uvs', uvs)),
    texture: texture === undefined ? undefined : asBytes(texture),
  };
}

/**
 * @param {unknown} given
 * @returns {import('./types.js').Frame}
 */
function asFrame(given) {
  const { right, up, towards } = record('INPUT', 'the frame', given, ['right', 'up', 'towards']);
  /** @param {string} name @param {unknown} axis */
  const own = (name, axis) => /** @type {[number, number, number]} */ (tuple(`${name} of the frame`, 3, axis));
  return { right: own('right', right), up: own('up', up), towards: own('towards', towards) };
}

/**
 * The unit of all lengths, if it is known.
 * @param {unknown} given
 * @returns {import('./types.js').Unit | undefined}
 */
export function unitOf(given) {
  if (given === undefined || given === null) return undefined;
  if (given === 'mm' || given === 'm') return given;
  throw new DevelopableError('INPUT', `unit must be 'mm' or 'm', or left out where it is not known, but is ${show(given)}`);
}

/**
 * What took a photo. It may be the intrinsics of depths.
 * @param {unknown} given
 * @returns {import('./types.js').PhotoCamera}
 */
export function asCamera(given) {
  return /** @type {import('./types.js').PhotoCamera} */ (optionsOf('photoCamera', /** @type {object} */ (given)));
}

/**
 * A list of so many finite numbers.
 * @param {string} name
 * @param {number} length
 * @param {unknown} given
 */
export function tuple(name, length, given) {
  const list = reading('INPUT', name, () => {
    const found = /** @type {ArrayLike<unknown>} */ (Object(given));
    return found.length === length ? Array.from({ length }, (_, i) => found[i]) : [];
  });
  if (list.length === length && list.every(Number.isFinite)) return list;
  throw new DevelopableError('INPUT', `${name} must be ${length} numbers, but is ${show(given)}`);
}

/**
 * What a surface has from its input: the unit, the place on a map, the axes of a view, the camera, colours, texture coordinates and texture.
 * @param {Image | Lattice} field
 * @returns {Partial<Pick<import('./types.js').Surface, 'unit' | 'georeference' | 'frame' | 'camera' | 'colors' | 'uvs' | 'texture'>>}
 */
export function carriedOf(field) {
  const unit = unitOf(field.unit);
  if (field.kind === 'image') return { ...(unit && { unit }), georeference: field.georeference };
  const { frame, camera, colors, uvs, texture } = field;
  return {
    ...(unit && { unit }),
    ...(frame && { frame }),
    ...(camera && { camera }),
    ...(colors && { colors }),
    ...(uvs && { uvs }),
    ...(texture && { texture }),
  };
}

/**
 * What may be known besides the heights.
 * @param {Said} said
 * @param {boolean} design whether there are none
 */
function known({ confidence, constraints, occlusions }, design) {
  if (design && confidence !== undefined) {
    throw new DevelopableError('INPUT', 'confidence is about heights, and there are only constraints');
  }
  return {
    confidence: confidence === undefined ? undefined : weights(confidence),
    constraints: constraints === undefined ? undefined : numbers('constraints', constraints),
    occlusions: flags('occlusions', occlusions),
  };
}

/**
 * Factors of the fidelity: as they are, or of an image that `read` has read, whose whole numbers are shares of the largest of
 * their type, so that white is 1, and where no data is no confidence.
 * @param {unknown} confidence
 */
function weights(confidence) {
  if (!isImage(confidence)) return numbers('confidence', confidence);
  const { data, dataType } = record('INPUT', 'the confidence', confidence, ['data', 'dataType']);
  const white = largestOf(dataType) ?? 1;
  return Float64Array.from(numbers('data of the confidence', data), (value) => (Number.isNaN(value) ? 0 : value / white));
}

/** Whether it is an object such as an image, and no array. @param {unknown} value */
function isImage(value) {
  return isRecord(value) && typeOf(value) === undefined;
}

/** Largest number of a type of integers, as `read` names those of a file; of others `undefined`. @param {unknown} dataType */
export function largestOf(dataType) {
  const [, sign, bits] = /^([ui])(\d+)$/.exec(String(dataType)) ?? [];
  return bits === undefined ? undefined : 2 ** (Number(bits) - (sign === 'i' ? 1 : 0)) - 1;
}

/** Arrays with a value for each pixel or vertex. */
const VALUES = ['data', 'heights', 'mask', 'confidence', 'constraints', 'occlusions', 'brokenEdges'];

/**
 * Refuses arrays that do not match the shape: before they are handed over.
 * @param {Image | Lattice} field
 */
export function checkLengths(field) {
  const [rows, cols] = field.kind === 'image' ? [field.height, field.width] : [field.rows, field.cols];
  for (const name of VALUES) {
    const array = /** @type {Record<string, any>} */ (field)[name];
    if (array === undefined || array.length === rows * cols) continue;
    throw new DevelopableError(
      'SHAPE',
      `${name}: there are ${array.length} values, and its shape of ${rows} × ${cols} (rows × columns) needs ${rows * cols}; `
        + 'every row must be equally long and the shape must match the data',
    );
  }
}

/**
 * The same field with arrays of its own, and their buffers, ready to be transferred.
 * @template {Image | Lattice} F
 * @param {F} field
 * @param {import('./index.js').HandOver} [options] whether to take the caller's arrays themselves where that is possible
 * @returns {{ field: F, buffers: ArrayBuffer[] }}
 */
export function detached(field, options) {
  const handOver = optionsOf('handOver', options).transfer === true;
  /** @type {Set<ArrayBuffer>} */
  const buffers = new Set();
  /** @type {Record<string, unknown>} */
  const own = { ...field };
  for (const name of ARRAYS) {
    const array = /** @type {NumericArray | undefined} */ (own[name]);
    if (array === undefined) continue;
    // Looked at again: it may have been handed over to another call in the meantime.
    own[name] = handOver && ownsItsBuffer(array) ? viewOf(name, array) : copied(array);
    buffers.add(/** @type {NumericArray & { buffer: ArrayBuffer }} */ (own[name]).buffer);
  }
  if (handOver) checkLengths(/** @type {F} */ (own));
  return { field: /** @type {F} */ (own), buffers: [...buffers] };
}

/**
 * Whether the array can be handed over without taking other arrays' memory along.
 * @param {ArrayBufferView} array
 */
function ownsItsBuffer({ buffer, byteLength }) {
  return buffer instanceof ArrayBuffer && buffer.byteLength === byteLength;
}

/**
 * A copy in memory of its own. (`slice` of a Node `Buffer` would be a view.)
 * @param {NumericArray} array
 */
export function copied(array) {
  return array instanceof Uint8Array ? new Uint8Array(array) : array.slice();
}

/**
 * Bytes of a file, as a view of its own.
 * @param {unknown} bytes
 * @param {string} [must] what is said of anything else, which follows
 * @returns {Uint8Array}
 */
export function asBytes(bytes, must = "the file's bytes must be a Uint8Array or ArrayBuffer, but are") {
  const what = "the file's bytes";
  return reading('INPUT', what, () => {
    if (bytes instanceof ArrayBuffer || bytes instanceof DataView) return bytesOf(what, bytes);
    if (typeOf(bytes) !== undefined) {
      const { buffer, byteOffset, byteLength } = viewOf(what, bytes);
      return new Uint8Array(buffer, byteOffset, byteLength);
    }
    throw new DevelopableError('INPUT', `${must} ${show(bytes)}`);
  });
}

/**
 * The bytes of a buffer or of a part of one.
 * @param {string} what
 * @param {ArrayBuffer | DataView} bytes
 */
function bytesOf(what, bytes) {
  try {
    return bytes instanceof DataView ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength) : new Uint8Array(bytes);
  } catch {
    throw new DevelopableError('INPUT', `${what} have no memory any more: their buffer was handed over, or made smaller`);
  }
}

/**
 * @param {string} name
 * @param {unknown} value
 * @returns {NumericArray}
 */
export function numbers(name, value) {
  return reading('INPUT', name, () => {
    const type = typeOf(value);
    if (type !== undefined && !/BigU?[Ii]nt/.test(type)) return viewOf(name, value);
    if (!Array.isArray(value)) {
      throw new DevelopableError(
        'INPUT',
        `${name} must be a flat array of numbers or a typed array of them, but is ${show(value)}`,
      );
    }
    return Float64Array.from({ length: value.length }, (_, i) => {
      const entry = value[i];
      if (typeof entry === 'number') return entry;
      throw new DevelopableError('INPUT', `${name}[${i}] must be a number, but is ${show(entry)}`);
    });
  });
}

/**
 * Numbers in an array of the type that Rust reads.
 * @template {Float32Array | Float64Array} A
 * @param {{ new (length: number): A, from(values: Iterable<number>): A }} type
 * @param {string} name
 * @param {unknown} value
 * @returns {A}
 */
export function typed(type, name, value) {
  const values = numbers(name, value);
  return values instanceof type ? values : type.from(values);
}

/**
 * @param {string} name
 * @param {unknown} value
 */
export function optionalFloats(name, value) {
  return value === undefined ? undefined : typed(Float32Array, name, value);
}

/**
 * So many values for each vertex, and no others.
 * @template {NumericArray | undefined} A
 * @param {string} name
 * @param {number} size
 * @param {number} vertices
 * @param {A} array
 * @returns {A}
 */
function each(name, size, vertices, array) {
  if (array === undefined || array.length === size * vertices) return array;
  throw new DevelopableError(
    'SHAPE',
    `${name} has ${array.length} values where ${vertices} vertices with ${size} each need ${size * vertices}`,
  );
}

/**
 * @param {string} name
 * @param {unknown} value
 * @returns {Uint8Array | undefined}
 */
function flags(name, value) {
  if (value === undefined) return undefined;
  if (typeOf(value) === 'Uint8Array') return /** @type {Uint8Array} */ (viewOf(name, value));
  if (isImage(value)) return flags(name, record('INPUT', name, value, ['data']).data ?? null);
  return reading('INPUT', name, () => {
    const list = Array.isArray(value) && value.every((flag) => typeof flag === 'boolean') ? value.map(Number) : numbers(name, value);
    // What is not a number is no flag.
    return Uint8Array.from(list, (flag) => (flag ? 1 : 0));
  });
}

/**
 * @param {string} name
 * @param {unknown} value
 */
export function count(name, value) {
  if (Number.isSafeInteger(value) && Number(value) >= 0) return Number(value);
  throw new DevelopableError('INPUT', `${name} must be a whole number, but is ${show(value)}`);
}

/**
 * The number of cells, within what wasm can count: how many there may be is Rust's to say.
 * @param {string} what
 * @param {number} a
 * @param {number} b
 */
export function cells(what, a, b) {
  if (Math.max(a, b, a * b) < 2 ** 32) return a * b;
  throw new DevelopableError('TOO_LARGE', `${what} has ${a} × ${b} values, more than there may be`);
}

/**
 * @param {string} name
 * @param {unknown} value
 */
function number(name, value) {
  if (typeof value === 'number') return value;
  throw new DevelopableError('INPUT', `${name} must be a number, but is ${show(value)}`);
}

/**
 * @param {string} name
 * @param {unknown} value
 */
function optional(name, value) {
  return value === undefined ? undefined : number(name, value);
}
