/** Colours for values and for patches, and the scales that lead there. */
import { number, superscript } from '../format.js';

/** @typedef {readonly [number, number, number]} Colour */

/** Blue, nothing, red: ColorBrewer's RdBu, whose ends are told apart also by the colour-blind. @type {readonly Colour[]} */
const DIVERGING = [
  [5, 48, 97], [33, 102, 172], [67, 147, 195], [146, 197, 222], [209, 229, 240], [247, 247, 247],
  [253, 219, 199], [244, 165, 130], [214, 96, 77], [178, 24, 43], [103, 0, 31],
];

/** Lines on a surface: creases, or what is cut, and folds as drawings for paper have them. @type {Colour} */
export const CREASE = [20, 24, 28];
/** @type {{ mountain: Colour, valley: Colour }} */
export const FOLDS = { mountain: [178, 24, 43], valley: [33, 102, 172] };

const STEPS = 512;
const table = new Uint32Array(Array.from({ length: STEPS + 1 }, (_, i) => bytes(diverging((2 * i) / STEPS - 1))));

/**
 * @param {number} t from -1 to 1
 * @returns {Colour}
 */
export function diverging(t) {
  const place = ((Math.min(1, Math.max(-1, t)) + 1) / 2) * (DIVERGING.length - 1);
  const i = Math.min(DIVERGING.length - 2, Math.floor(place));
  /** @param {0 | 1 | 2} k */
  const mix = (k) => DIVERGING[i][k] + (place - i) * (DIVERGING[i + 1][k] - DIVERGING[i][k]);
  return [mix(0), mix(1), mix(2)];
}

/** The same as a pixel. @param {number} t */
export function divergingPixel(t) {
  return table[Math.round(((Math.min(1, Math.max(-1, t)) + 1) / 2) * STEPS)];
}

/** Told apart by hue and lightness, then again from the start. @type {readonly Colour[]} */
const PATCHES = [
  [86, 148, 206], [240, 160, 75], [107, 178, 106], [214, 108, 120], [160, 134, 204], [222, 200, 88],
  [92, 184, 184], [198, 122, 176], [164, 140, 110], [140, 196, 240], [246, 190, 170], [172, 210, 130],
];

/** @param {number} patch */
export function patchColour(patch) {
  return PATCHES[patch % PATCHES.length];
}

/** @param {Colour} colour */
export function css([r, g, b]) {
  return `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)})`;
}

/** As the canvas' bytes, opaque. @param {Colour} colour */
export function bytes([r, g, b]) {
  return new Uint32Array(Uint8ClampedArray.of(r, g, b, 255).buffer)[0];
}

/**
 * @typedef {object} Scale of values around 0
 * @property {(value: number) => number} place from -1 to 1
 * @property {readonly { value: number, label: string }[]} ticks
 */

/**
 * Linear about 0 and logarithmic beyond, so that noise and what is left of it are both seen.
 * @param {number} knee where one becomes the other
 * @param {number} most
 * @returns {Scale}
 */
export function logarithmic(knee, most) {
  const end = Math.asinh(Math.max(most, 10 * knee) / knee);
  const [low, high] = [Math.ceil(Math.log10(knee)), Math.floor(Math.log10(Math.max(most, 10 * knee)) + 1e-9)];
  const every = Math.max(1, Math.ceil((high - low + 1) / 3));
  const powers = [];
  for (let power = high; power >= low; power -= every) powers.push(power);
  return {
    place: (value) => Math.asinh(value / knee) / end,
    ticks: [
      ...powers.map((power) => ({ value: -(10 ** power), label: `−${tenTo(power)}` })),
      { value: 0, label: '0' },
      ...[...powers].reverse().map((power) => ({ value: 10 ** power, label: tenTo(power) })),
    ],
  };
}

/** @param {number} power */
function tenTo(power) {
  return power >= -2 && power <= 3 ? number(10 ** power) : `10${superscript(power)}`;
}

/**
 * @param {number} most
 * @param {(value: number) => string} label
 * @returns {Scale}
 */
export function linear(most, label) {
  return {
    place: (value) => value / most,
    ticks: [-most, -most / 2, 0, most / 2, most].map((value) => ({ value, label: label(value) })),
  };
}

/**
 * The magnitude that a share of the values does not exceed; NaN is none.
 * @param {readonly ArrayLike<number>[]} fields
 * @param {number} share
 */
export function magnitude(fields, share) {
  /** More than this are not worth sorting. */
  const enough = 30_000;
  const total = fields.reduce((sum, { length }) => sum + length, 0);
  const step = Math.max(1, Math.floor(total / enough));
  const found = [];
  for (const values of fields) {
    for (let i = 0; i < values.length; i += step) {
      if (!Number.isNaN(values[i])) found.push(Math.abs(values[i]));
    }
  }
  const sorted = Float64Array.from(found).sort();
  return sorted[Math.floor(share * (sorted.length - 1))] ?? 0;
}
