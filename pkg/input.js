/**
 * Inputs: checked as far as JS has to, and copied field by field. Sizes and values are checked in
 * Rust, where the messages know the most.
 */
import { asOptions } from './control.js';
import { DevelopableError } from './errors.js';

/**
 * @typedef {import('./types.js').HeightImage} HeightImage
 * @typedef {import('./types.js').Heightfield} Heightfield
 * @typedef {Exclude<import('./types.js').Numbers, readonly number[]>} NumericArray
 * @typedef {{ confidence?: NumericArray, constraints?: NumericArray }} Known
 * @typedef {HeightImage & Known & { kind: 'image', data?: NumericArray }} Image
 * @typedef {Heightfield & Known & { kind: 'lattice', heights?: NumericArray }} Lattice
 */

/** The arrays that an input may have. */
const ARRAYS = [
  'data', 'heights', 'mask', 'confidence', 'constraints', 'occlusions', 'brokenEdges', 'colors', 'uvs', 'texture',
];

const SHAPES =
  'an image ({ width, height, data }) or heights on the lattice ({ rows, cols, spacing, heights }), ' +
  'with constraints in the place of data or heights if there is nothing else';

/**
 * What can be solved: heights, and all that is known about them, or constraints alone.
 * @param {HeightImage | Heightfield} input
 * @returns {Image | Lattice}
 */
export function asInput(input) {
  /** @type {Record<string, unknown>} */
  const given = Object(input);
  /** @param {string} name */
  const has = (name) => given[name] !== undefined;
  const design = has('constraints');
  if (has('heights') || (design && has('rows'))) return latticeInput(/** @type {Heightfield} */ (input));
  if (has('data') || design) return imageInput(/** @type {HeightImage} */ (input));
  throw new DevelopableError('INPUT', `the input must be ${SHAPES}`);
}

/**
 * Heights, without what else may be known about them.
 * @param {HeightImage | Heightfield} input
 * @returns {Image | Lattice}
 */
export function asField(input) {
  /** @type {Record<string, unknown>} */
  const given = Object(input);
  if (given.heights !== undefined) return asLattice(/** @type {Heightfield} */ (input));
  if (given.data !== undefined) return asImage(/** @type {HeightImage} */ (input));
  throw new DevelopableError(
    'INPUT',
    'there must be heights: an image ({ width, height, data }) or a lattice ({ rows, cols, spacing, heights })',
  );
}

/**
 * @param {HeightImage} input
 * @returns {Image}
 */
export function asImage(input) {
  return { ...pixels(input), data: numbers('data', Object(input).data) };
}

/**
 * @param {Heightfield} input
 * @returns {Lattice}
 */
export function asLattice(input) {
  return { ...vertices(input), heights: numbers('heights', Object(input).heights) };
}

/**
 * @param {HeightImage} input
 * @returns {Image}
 */
function imageInput(input) {
  if ('brokenEdges' in input && input.brokenEdges !== undefined) {
    throw new DevelopableError('INPUT', 'brokenEdges are for heights on the lattice: an image has none of its edges');
  }
  const data = input.data === undefined ? undefined : numbers('data', input.data);
  return { ...pixels(input), data, ...known(input, data === undefined) };
}

/**
 * @param {Heightfield} input
 * @returns {Lattice}
 */
function latticeInput(input) {
  const heights = input.heights === undefined ? undefined : numbers('heights', input.heights);
  const brokenEdges = flags('brokenEdges', input.brokenEdges);
  return { ...vertices(input), heights, ...known(input, heights === undefined), brokenEdges };
}

/**
 * An image without what is at its pixels.
 * @param {HeightImage} input
 */
function pixels(input) {
  const { width, height, mask, noData, pixelSize, heightScale } = Object(input);
  return {
    kind: /** @type {const} */ ('image'),
    width: count('width', width),
    height: count('height', height),
    mask: flags('mask', mask),
    noData: optional('noData', noData),
    pixelSize: optional('pixelSize', pixelSize),
    heightScale: optional('heightScale', heightScale),
  };
}

/**
 * A lattice without what is at its vertices.
 * @param {Heightfield} input
 */
function vertices(input) {
  const { rows, cols, spacing, origin, mask, noData, frame, colors, uvs, texture } = Object(input);
  if (origin !== undefined && !(origin?.length === 2 && isNumber(origin[0]) && isNumber(origin[1]))) {
    throw new DevelopableError('INPUT', `origin must be two numbers [x, y], but is ${show(origin)}`);
  }
  return {
    kind: /** @type {const} */ ('lattice'),
    rows: count('rows', rows),
    cols: count('cols', cols),
    spacing: number('spacing', spacing),
    origin: origin && /** @type {[number, number]} */ ([origin[0], origin[1]]),
    mask: flags('mask', mask),
    noData: optional('noData', noData),
    frame: frame === undefined ? undefined : asFrame(frame),
    colors: optionalFloats('colors', colors),
    uvs: optionalFloats('uvs', uvs),
    texture: texture === undefined ? undefined : asBytes(texture),
  };
}

/**
 * @param {unknown} frame
 * @returns {import('./types.js').Frame}
 */
function asFrame(frame) {
  const { right, up, towards } = Object(frame);
  for (const axis of [right, up, towards]) {
    if (!(Array.isArray(axis) && axis.length === 3 && axis.every(Number.isFinite))) {
      throw new DevelopableError('INPUT', 'frame must have three axes of three numbers: right, up and towards');
    }
  }
  /** @param {[number, number, number]} axis @returns {[number, number, number]} */
  const own = ([x, y, z]) => [x, y, z];
  return { right: own(right), up: own(up), towards: own(towards) };
}

/**
 * What a surface has from its input: the axes of a view, colours, texture coordinates and texture.
 * @param {Image | Lattice} field
 * @returns {Partial<Pick<Heightfield, 'frame' | 'colors' | 'uvs' | 'texture'>>}
 */
export function carriedOf(field) {
  if (field.kind === 'image') return {};
  const { frame, colors, uvs, texture } = field;
  return { ...(frame && { frame }), ...(colors && { colors }), ...(uvs && { uvs }), ...(texture && { texture }) };
}

/**
 * What may be known besides the heights.
 * @param {HeightImage | Heightfield} input
 * @param {boolean} design whether there are none
 */
function known({ confidence, constraints, occlusions }, design) {
  if (design && confidence !== undefined) {
    throw new DevelopableError('INPUT', 'confidence is about heights, and there are only constraints');
  }
  return {
    confidence: confidence === undefined ? undefined : numbers('confidence', confidence),
    constraints: constraints === undefined ? undefined : numbers('constraints', constraints),
    occlusions: flags('occlusions', occlusions),
  };
}

/**
 * The same field with arrays of its own, and their buffers, ready to be transferred.
 * @template {Image | Lattice} F
 * @param {F} field
 * @param {import('./index.js').HandOver} [options] whether to take the caller's arrays themselves where that is possible
 * @returns {{ field: F, buffers: ArrayBuffer[] }}
 */
export function detached(field, options) {
  const handOver = asOptions(options).transfer === true;
  /** @type {Set<ArrayBuffer>} */
  const buffers = new Set();
  /** @type {Record<string, unknown>} */
  const own = { ...field };
  for (const name of ARRAYS) {
    const array = /** @type {NumericArray | undefined} */ (own[name]);
    if (array === undefined) continue;
    own[name] = handOver && ownsItsBuffer(array) ? array : copied(array);
    buffers.add(/** @type {NumericArray & { buffer: ArrayBuffer }} */ (own[name]).buffer);
  }
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
 * @returns {Uint8Array}
 */
export function asBytes(bytes) {
  if (bytes instanceof ArrayBuffer) return new Uint8Array(bytes);
  if (ArrayBuffer.isView(bytes)) {
    return new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }
  throw new DevelopableError('INPUT', `the file's bytes must be a Uint8Array or ArrayBuffer, but are ${show(bytes)}`);
}

/**
 * @param {string} name
 * @param {unknown} value
 * @returns {NumericArray}
 */
export function numbers(name, value) {
  if (Array.isArray(value)) {
    const odd = value.findIndex((entry) => typeof entry !== 'number');
    if (odd >= 0) {
      throw new DevelopableError('INPUT', `${name}[${odd}] must be a number, but is ${show(value[odd])}`);
    }
    return Float64Array.from(value);
  }
  if (ArrayBuffer.isView(value) && !(value instanceof DataView) && !/BigU?[Ii]nt/.test(tag(value))) {
    return /** @type {NumericArray} */ (value);
  }
  throw new DevelopableError(
    'INPUT',
    `${name} must be a flat array of numbers or a typed array of them, but is ${show(value)}`,
  );
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
  return value instanceof type ? value : type.from(numbers(name, value));
}

/**
 * @param {string} name
 * @param {unknown} value
 */
export function optionalFloats(name, value) {
  return value === undefined ? undefined : typed(Float32Array, name, value);
}

/**
 * @param {string} name
 * @param {unknown} value
 * @returns {Uint8Array | undefined}
 */
function flags(name, value) {
  if (value === undefined || value instanceof Uint8Array) return value;
  throw new DevelopableError('INPUT', `${name} must be a Uint8Array, but is ${show(value)}`);
}

/**
 * @param {string} name
 * @param {unknown} value
 */
function count(name, value) {
  if (Number.isSafeInteger(value) && Number(value) >= 0) return Number(value);
  throw new DevelopableError('INPUT', `${name} must be a whole number, but is ${show(value)}`);
}

/**
 * @param {string} name
 * @param {unknown} value
 */
function number(name, value) {
  if (isNumber(value)) return value;
  throw new DevelopableError('INPUT', `${name} must be a number, but is ${show(value)}`);
}

/**
 * @param {string} name
 * @param {unknown} value
 */
function optional(name, value) {
  return value === undefined ? undefined : number(name, value);
}

/**
 * @param {unknown} value
 * @returns {value is number}
 */
function isNumber(value) {
  return typeof value === 'number';
}

/** @param {unknown} value */
function tag(value) {
  return Object.prototype.toString.call(value).slice(8, -1);
}

/** @param {unknown} value */
function show(value) {
  if (typeof value === 'string') return JSON.stringify(value);
  if (typeof value === 'bigint') return `${value}n`;
  return typeof value === 'object' && value !== null ? tag(value) : String(value);
}
