/** How a file of numbers is understood: what is guessed of it at first, and the one way or the other afterwards. */
import { coarseningFor, depthsIn, guessedPixel, isHexagonal, isNoDepth, zeroIsNothing } from './metadata-guess.js';
import { number } from './format.js';
import { GUESS_WORDS } from './messages.js';
import { gridOver, interpolated } from './surface/lattice.js';
import { firstLook, small } from './surface/look.js';

/** @import {Api} from './api.js' */
/** @import {Input} from './session.js' */
/** @typedef {Awaited<ReturnType<Api['read']>>} Read */

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

/** Distance of the rows of a hexagonal lattice, in spacings of its vertices. */
const HEXAGONAL_ROW_SPACING = Math.sqrt(3) / 2;
/** Share of pixels with a height, below which they are lines and points to pass through. */
const FEW = 0.2;

/**
 * What was read, as it is understood at first. Takes a while for a large file.
 * @param {Read} read
 * @param {string} name of the file
 * @returns {Understood}
 */
function understoodFirst(read, name) {
  const { width, height, unit } = read;
  const depths = depthsIn(name, read) ?? undefined;
  const data = depths ? read.data.map((depth) => (isNoDepth(depth) ? NaN : depth)) : read.data;
  if (!data.some(Number.isFinite)) throw new Error('it has no heights, every pixel is “no data” (NaN)');
  if (data.some((value) => Math.abs(value) === Infinity)) throw new Error('it has infinite heights; mark them as NaN, “no data”');
  if (width < 3 || height < 3) throw new Error(`it is ${width} × ${height} pixels; a surface needs at least 3 × 3`);
  const stored = guessed({ ...read, data }, depths !== undefined);
  const { pixelSize, heightScale, design } = stored;
  const first = { ...stored, zeros: false, hexagonal: false };
  return understood({ width, height, data, pixelSize, heightScale, unit: unit ?? undefined, depths, stored: first, design }, stored);
}

/** The same with what else takes a while to find of it, in the page's worker. @param {Parameters<typeof understoodFirst>} read */
export function lookedThrough(...read) {
  const input = understoodFirst(...read);
  const { data, width, height, heightScale, pixelSize } = input;
  return { ...input, reach: reachOf(data), look: firstLook(data, width, height, heightScale, pixelSize) };
}

/** What the worker has found. @param {Omit<ReturnType<typeof lookedThrough>, 'look'>} found @returns {Understood} */
export function takenOver({ reach, ...input }) {
  reaches.set(input.data, reach);
  return input;
}

/**
 * @param {Read} read
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
  const pixel = depths || design ? null : guessedPixel({ ...valid, rowSpacing: hexagonal ? HEXAGONAL_ROW_SPACING : 1 });
  const coarsening = hexagonal ? 1 : coarseningFor(read);
  const told = [
    ...(pixel ? [pixel.words] : []),
    ...(design ? [GUESS_WORDS.few] : []),
    ...(zeros ? [GUESS_WORDS.zeros] : []),
    ...(hexagonal ? [GUESS_WORDS.hexagonal] : []),
    ...(coarsening > 1 ? [GUESS_WORDS.coarse(coarsening)] : []),
  ].join(' ');
  const levels = /^u/.test(dataType);
  return { width, height, data, pixelSize: pixel?.pixelSize ?? pixelSize, heightScale, zeros, hexagonal, design, levels, told, coarsening };
}

/** @typedef {Omit<Input, 'name'>} Understood */

/**
 * The same file, understood otherwise.
 * @template {Understood} I
 * @param {I} input
 * @param {Partial<Stored>} change
 * @returns {I}
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

/** Differences of the highest and the lowest, which take a while for large inputs. @type {WeakMap<Float64Array, number>} */
const reaches = new WeakMap();

/** @param {Float64Array} data */
export function reachOf(data) {
  const known = reaches.get(data);
  if (known !== undefined) return known;
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < data.length; i++) {
    if (data[i] < low) low = data[i];
    if (data[i] > high) high = data[i];
  }
  reaches.set(data, high - low);
  return high - low;
}

/** What the lengths come to. @param {Input} input */
export function spanInWords({ data, width, height, pixelSize, heightScale }) {
  const depth = reachOf(data) * Math.abs(heightScale);
  return `Spans ${number(width * pixelSize)} × ${number(height * pixelSize)}, and ${number(depth)} in height.`;
}

/** An image of confidence: white is 1; other numbers than whole ones are taken as they are. @param {Read} image */
export function confidenceOf({ width, height, data, dataType }) {
  const [, bits] = /^u(\d+)$/.exec(dataType) ?? [];
  const largest = bits ? 2 ** Number(bits) - 1 : 1;
  // No more digits are needed.
  const confidence = Float32Array.from(data, (value) => (Number.isNaN(value) ? 0 : value / largest));
  if (confidence.some((value) => value < 0)) throw new Error('it has values below 0');
  return { values: confidence, small: small({ width, height, data: confidence }) };
}

/** An image of heights to be met. @param {Read} image */
export function constraintsOf({ width, height, data }) {
  const constraints = data.map((value) => (value === 0 ? NaN : value));
  if (constraints.every(Number.isNaN)) throw new Error('it holds nothing: every pixel is 0 or “no data”');
  return { values: constraints, small: small({ width, height, data: constraints }) };
}
