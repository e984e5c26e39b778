/**
 * Inputs: checked as far as JS has to, and copied field by field. Sizes and values are checked in
 * Rust, where the messages know the most.
 */
import { DevelopableError } from './errors.js';

/**
 * @typedef {import('./types.js').HeightImage} HeightImage
 * @typedef {import('./types.js').Heightfield} Heightfield
 * @typedef {Exclude<import('./types.js').Numbers, readonly number[]>} NumericArray
 * @typedef {HeightImage & { kind: 'image', data: NumericArray }} Image
 * @typedef {Heightfield & { kind: 'lattice', heights: NumericArray }} Lattice
 */

/**
 * @param {HeightImage | Heightfield} input
 * @returns {Image | Lattice}
 */
export function asField(input) {
  if (input !== null && typeof input === 'object') {
    if ('heights' in input) return asLattice(input);
    if ('data' in input) return asImage(input);
  }
  throw new DevelopableError(
    'INPUT',
    'the input must be an image ({ width, height, data }) or heights on the lattice ' +
      '({ rows, cols, spacing, heights })',
  );
}

/**
 * @param {HeightImage} input
 * @returns {Image}
 */
export function asImage(input) {
  const { width, height, data, mask, noData, pixelSize, heightScale } = Object(input);
  return {
    kind: 'image',
    width: count('width', width),
    height: count('height', height),
    data: numbers('data', data),
    mask: asMask(mask),
    noData: sentinel(noData, data),
    pixelSize: optional('pixelSize', pixelSize),
    heightScale: optional('heightScale', heightScale),
  };
}

/**
 * @param {Heightfield} input
 * @returns {Lattice}
 */
export function asLattice(input) {
  const { rows, cols, spacing, heights, origin, mask, noData } = Object(input);
  if (origin !== undefined && !(origin?.length === 2 && isNumber(origin[0]) && isNumber(origin[1]))) {
    throw new DevelopableError('INPUT', `origin must be two numbers [x, y], but is ${show(origin)}`);
  }
  return {
    kind: 'lattice',
    rows: count('rows', rows),
    cols: count('cols', cols),
    spacing: number('spacing', spacing),
    heights: numbers('heights', heights),
    origin: origin && [origin[0], origin[1]],
    mask: asMask(mask),
    noData: sentinel(noData, heights),
  };
}

/**
 * The same field with arrays of its own, and their buffers, ready to be transferred.
 * @template {Image | Lattice} F
 * @param {F} field
 * @param {boolean} handOver take the caller's arrays themselves where that is possible
 * @returns {{ field: F, buffers: ArrayBuffer[] }}
 */
export function detached(field, handOver) {
  /** @type {Set<ArrayBuffer>} */
  const buffers = new Set();
  /** @type {Record<string, unknown>} */
  const own = { ...field };
  for (const name of ['data', 'heights', 'mask']) {
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
function numbers(name, value) {
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
 * @param {unknown} mask
 * @returns {Uint8Array | undefined}
 */
function asMask(mask) {
  if (mask === undefined || mask instanceof Uint8Array) return mask;
  throw new DevelopableError('INPUT', `mask must be a Uint8Array, but is ${show(mask)}`);
}

/**
 * The no-data value as the array can hold it: -9999.9 is another number in 32 bits.
 * @param {unknown} value
 * @param {unknown} data
 */
function sentinel(value, data) {
  const noData = optional('noData', value);
  return noData !== undefined && data instanceof Float32Array ? Math.fround(noData) : noData;
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
