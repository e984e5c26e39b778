/** A file of heights as the input: read, and understood in the one way or the other. */
import { coarseningFor, depthsIn, guessedPixel, isHexagonal, isNoDepth, zeroIsNothing } from './guess.js';
import { number } from './format.js';
import { pixelsOf } from './pixels.js';
import { gridOver, interpolated } from './surface/lattice.js';

/** @import {Api} from './api.js' */
/** @import {Beside, Input} from './session.js' */
/** @import {Together} from './together.js' */

/**
 * What a file holds, and how it is understood.
 * @typedef {object} Stored
 * @property {number} width
 * @property {number} height
 * @property {Float64Array} data steps of height
 * @property {number} pixelSize
 * @property {number} heightScale
 * @property {boolean} zeros are “no data”
 * @property {boolean} hexagonal the numbers are at the vertices of a lattice
 * @property {boolean} design few heights are given, and the surface passes through them
 * @property {boolean} levels are whole numbers whose height nobody has said
 * @property {string} told what was guessed
 * @property {number} coarsening that suits its size
 */

/** Share of pixels with a height, below which they are lines and points to pass through. */
const FEW = 0.2;

/** A picture in colour is a photo, and no heights. */
export class InColour extends Error {
  constructor() {
    super('it is in colour, and no heights follow from that. A photo alone is made flat under “A photo of a page”; with its depths, open both together');
  }
}

/**
 * @param {Api} api
 * @param {File} file
 * @param {string} [wanted] array of it
 * @param {Pick<Together, 'photo' | 'confidence' | 'mask'>} [others] that go with it
 * @returns {Promise<Input>}
 */
export async function inputOf(api, file, wanted, { photo: picture, ...others } = {}) {
  const names = await arraysOf(api, file);
  const several = names.length > 1 ? { file, names, name: wanted ?? names[0] } : undefined;
  const options = several && { array: several.name };
  const read = await api.read(file, options).catch((error) => {
    throw error instanceof Error && /colour/.test(error.message) ? new InColour() : error;
  });
  const { format, dataType, width, height, unit } = read;
  const photo = picture && { name: picture.name, image: await pixelsOf(picture) };
  const beside = await besideOf(api, others);
  const depths = depthsIn(file.name, read) ?? undefined;
  const data = depths ? read.data.map((depth) => (isNoDepth(depth) ? NaN : depth)) : read.data;
  if (!data.some(Number.isFinite)) throw new Error('it has no heights, every pixel is “no data” (NaN)');
  if (data.some((value) => Math.abs(value) === Infinity)) throw new Error('it has infinite heights; mark them as NaN, “no data”');
  if (width < 3 || height < 3) throw new Error(`it is ${width} × ${height} pixels; a surface needs at least 3 × 3`);
  const name = file.name.replace(/\.[^.]*$/, '') || 'heights';
  const kind = `${format.toUpperCase()}, ${typeInWords(dataType)}`;
  const stored = guessed({ ...read, data }, depths !== undefined);
  const { pixelSize, heightScale, design } = stored;
  const first = { ...stored, zeros: false, hexagonal: false };
  return understood({ name, kind, dataType, depths, photo, beside, width, height, data, pixelSize, heightScale, unit: unit ?? undefined, array: several, stored: first, design }, stored);
}

/**
 * @param {Awaited<ReturnType<Api['read']>>} read
 * @param {boolean} depths
 * @returns {Stored}
 */
function guessed(read, depths) {
  const { width, height, data, pixelSize, heightScale, dataType } = read;
  const zeros = !depths && zeroIsNothing(data);
  const valid = { ...read, data: zeros ? withoutZeros(data) : data };
  // A photo or a scan has holes; what is nearly all hole has lines and points that were drawn.
  const given = valid.data.reduce((sum, value) => sum + Number(Number.isFinite(value)), 0);
  const design = !depths && given < FEW * data.length;
  const hexagonal = !design && !depths && isHexagonal(valid);
  const pixel = depths || design ? null : guessedPixel(valid);
  const coarsening = hexagonal ? 1 : coarseningFor(read);
  const told = [
    ...(pixel ? [pixel.words] : []),
    ...(design ? ['Few pixels have a height: the surface is made to pass through them, free everywhere else.'] : []),
    ...(zeros ? ['0 is taken for “no data”.'] : []),
    ...(hexagonal ? ['Odd rows seem to lie half a step to the left, as on a hexagonal lattice: that is what it is taken for.'] : []),
    ...(coarsening > 1 ? [`It is large: one vertex for ${coarsening} × ${coarsening} pixels (see “Lattice” under “More options”).`] : []),
  ].join(' ');
  const levels = /^u/.test(dataType);
  return { width, height, data, pixelSize: pixel?.pixelSize ?? pixelSize, heightScale, zeros, hexagonal, design, levels, told, coarsening };
}

/**
 * The same file, understood otherwise.
 * @param {Input} input
 * @param {Partial<Stored>} change
 * @returns {Input}
 */
export function understood(input, change) {
  if (!input.stored) return input;
  const stored = { ...input.stored, ...change };
  const { width, height, pixelSize, heightScale, zeros, hexagonal } = stored;
  // What was changed by hand stays, where only the scale is another.
  const kept = zeros === input.stored.zeros && !hexagonal && !input.stored.hexagonal;
  const data = kept ? input.data : zeros ? withoutZeros(stored.data) : stored.data;
  if (!data.some(Number.isFinite)) throw new Error('nothing else would be left');
  if (!hexagonal) return { ...input, stored, width, height, data, pixelSize, heightScale, lattice: undefined };
  const lattice = { rows: height, cols: width, spacing: pixelSize, heights: data.map((step) => step * heightScale), unit: /** @type {'mm' | 'm' | undefined} */ (input.unit) };
  const grid = gridOver(lattice);
  return { ...input, stored, ...grid, heightScale: 1, data: interpolated(lattice, lattice.heights, grid), lattice };
}

/** @param {Float64Array} data */
function withoutZeros(data) {
  return data.map((value) => (value === 0 ? NaN : value));
}

/** What the lengths come to. @param {Input} input */
export function spanInWords({ data, width, height, pixelSize, heightScale }) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of data) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  const depth = (high - low) * Math.abs(heightScale);
  return `Spans ${number(width * pixelSize)} × ${number(height * pixelSize)}, and ${number(depth)} in height.`;
}

/**
 * The names of the arrays of an NPZ that may be heights; other files have none.
 * @param {Api} api
 * @param {File} file
 */
async function arraysOf(api, file) {
  if (!/\.npz$/i.test(file.name)) return [];
  const arrays = await api.npzArrays(file);
  return arrays.filter(({ shape, dataType }) => shape.length === 2 && /^[uif]\d+$/.test(dataType)).map(({ name }) => name);
}

/**
 * What is known of depths besides, as it is stored.
 * @param {Api} api
 * @param {Pick<Together, 'confidence' | 'mask'>} files
 * @returns {Promise<Beside | undefined>}
 */
async function besideOf(api, { confidence, mask }) {
  /** @param {File} [file] */
  const read = async (file) => {
    if (!file) return undefined;
    try {
      const { width, height, data, dataType } = await api.read(file);
      // Whole numbers are levels, or shares of the largest.
      if (dataType === 'u8') return { width, height, data: Uint8Array.from(data, (value) => value || 0) };
      if (dataType === 'u16') return { width, height, data: Uint16Array.from(data, (value) => value || 0) };
      return { width, height, data };
    } catch (error) {
      throw new Error(`its “${file.name}” could not be read: ${error instanceof Error ? error.message : error}`);
    }
  };
  const names = [confidence, mask].flatMap((file) => (file ? [file.name] : []));
  return names.length === 0 ? undefined : { confidence: await read(confidence), mask: await read(mask), names };
}

/** @param {string} type such as u16 */
function typeInWords(type) {
  const [, letter, bits] = /^([a-z]+)(\d+)$/.exec(type) ?? [];
  /** @type {Record<string, string>} */
  const names = { u: 'integers', i: 'signed integers', f: 'floats' };
  return names[letter] ? `${bits}-bit ${names[letter]}` : type;
}
