/** Interpretation of a file of numbers as heights: guessed when it is opened, and changed by the user afterwards. */
import { number, numberIn } from './format.js';
import { GUESS_WORDS } from './messages.js';
import { sidesOf } from './surface/triangles.js';

/** @typedef {Awaited<ReturnType<Api['read']>>} Read */
/** @typedef {number | 'none'} NoData value that is no data, or that none but NaN is */

/**
 * Contents of a file, and how they are interpreted.
 * @typedef {object} StoredHeights
 * @property {number} width pixels
 * @property {number} height pixels
 * @property {Float64Array} data heights in steps of `heightScale`
 * @property {number} range difference between the highest and the lowest value
 * @property {number} pixelSize
 * @property {number} heightScale
 * @property {NoData} [noData] what was given as no data when the file was read
 * @property {boolean} levels whether the values are integers whose height scale is not in the file
 * @property {string} guesses message that says what was guessed
 * @property {number} coarsening lattice spacing in pixels that suits the size of the image
 */

/** Maximum number of vertices of a solve that takes less than a few minutes. */
const MAX_QUICK_VERTICES = 1.2e6;
/** Minimum share of pixels with a height in measured data; fewer are told of. */
const MIN_MEASURED_SHARE = 0.2;

/**
 * Guesses the interpretation of a file. This takes long for a large file, so it runs in the page's worker.
 * @param {Read} read
 * @param {NoData} [noData] what was given as no data
 * @returns {InterpretedHeights}
 */
export function interpretFile(read, noData) {
  const { width, height, data, pixelSize, heightScale, dataType, unit, depths, depthUnit, georeference } = read;
  if (!data.some(Number.isFinite)) throw new Error('it has no heights, every pixel is “no data” (NaN)');
  if (data.some((value) => Math.abs(value) === Infinity)) throw new Error('it has infinite heights; mark them as NaN, “no data”');
  if (width < 3 || height < 3) throw new Error(`it is ${width} × ${height} pixels; a surface needs at least 3 × 3`);
  const given = data.reduce((sum, value) => sum + Number(Number.isFinite(value)), 0);
  const areFew = depths === 'none' && given < MIN_MEASURED_SHARE * data.length;
  const coarsening = coarseningFor(read);
  const guesses = [areFew ? GUESS_WORDS.few : '', coarsening > 1 ? GUESS_WORDS.coarse(coarsening) : ''].filter(Boolean).join(' ');
  const stored = { width, height, data, range: sidesOf(data, 1)[0], pixelSize, heightScale, levels: /^u/.test(dataType), guesses, coarsening, noData };
  return { width, height, data, pixelSize, heightScale, unit: unit ?? undefined, depths: depths === 'none' ? undefined : depths, depthUnit, georeference, stored };
}

/** The lattice spacing in pixels that keeps the solve of a large image short. @param {{ width: number, height: number }} size */
export const coarseningFor = ({ width, height }) => [1, 2, 4].find((step) => width * height <= MAX_QUICK_VERTICES * step * step) ?? 4;

/** @typedef {Omit<Input, 'name'>} InterpretedHeights */

/**
 * Changes the interpretation of a file's contents. What it decides is no longer assumed.
 * @template {InterpretedHeights} I
 * @param {I} input
 * @param {Partial<StoredHeights>} change
 * @returns {I}
 */
export function reinterpret(input, change) {
  if (!input.stored) return input;
  const stored = { ...input.stored, ...change };
  const assumptions = input.assumptions?.filter(({ option = '' }) => stored[/** @type {'pixelSize'} */ (option)] === input.stored?.[/** @type {'pixelSize'} */ (option)]);
  const { pixelSize, heightScale } = stored;
  return { ...input, stored, assumptions, pixelSize, heightScale };
}

/** The width, depth and height of an input as a sentence. @param {Input} input */
export function spanInWords({ stored, width, height, pixelSize, heightScale, unit }) {
  const sides = [width * pixelSize, height * pixelSize];
  const isMap = unit === 'm' && Math.max(...sides) >= 1e4;
  const [wide, deep] = sides.map((side) => number(isMap ? side / 1000 : side));
  return `${wide} × ${deep} ${isMap ? 'km' : unit ?? 'units'}, ${number((stored?.range ?? NaN) * Math.abs(heightScale))} ${unit ?? 'units'} high.`;
}

/** What a text gives as no data; nothing where it is no number. @param {string} text @returns {NoData | undefined} */
export function noDataOf(text) {
  const [word, value] = [text.trim(), numberIn(text)];
  return word === 'none' ? word : Number.isNaN(value) ? undefined : value;
}

/** The options of `read` that say what is no data: without them, the reader decides. @param {NoData} [noData] */
export function noDataOptions(noData) {
  return noData === undefined ? {} : { assumeNoData: false, ...(noData !== 'none' && { noData }) };
}
