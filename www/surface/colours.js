/** Colours of values and of patches, and the colour scales. */
import { number, superscript } from '../format.js';

/** @typedef {readonly [number, number, number]} Colour */

/** Diverging colour map from blue to red: ColorBrewer's RdBu, which is safe for colour-blind readers. @type {readonly Colour[]} */
const DIVERGING = [
  [5, 48, 97], [33, 102, 172], [67, 147, 195], [146, 197, 222], [209, 229, 240], [247, 247, 247],
  [253, 219, 199], [244, 165, 130], [214, 96, 77], [178, 24, 43], [103, 0, 31],
];

/** Colour of creases and cuts on a surface. @type {Colour} */
export const CREASE_COLOUR = [20, 24, 28];
/** Colours of folds, as in drawings. @type {{ mountain: Colour, valley: Colour }} */
export const FOLD_COLOURS = { mountain: [178, 24, 43], valley: [33, 102, 172] };

/** Share of the absolute values that a colour scale spans; outliers beyond have the colour of its end. */
export const COLOUR_SCALE_QUANTILE = 0.99;

/** Number of values that are sorted for a quantile, about. */
const QUANTILE_SAMPLE_VALUES = 30_000;

/** The colour of a value in the diverging colour map. @param {number} t from -1 to 1 @returns {Colour} */
export function divergingColour(t) {
  const place = ((Math.min(1, Math.max(-1, t)) + 1) / 2) * (DIVERGING.length - 1);
  const i = Math.min(DIVERGING.length - 2, Math.floor(place));
  /** @param {0 | 1 | 2} k */
  const mix = (k) => DIVERGING[i][k] + (place - i) * (DIVERGING[i + 1][k] - DIVERGING[i][k]);
  return [mix(0), mix(1), mix(2)];
}

/** Colours of patches, distinct in hue and lightness; further patches repeat them. @type {readonly Colour[]} */
export const PATCH_COLOURS = [
  [86, 148, 206], [240, 160, 75], [107, 178, 106], [214, 108, 120], [160, 134, 204], [222, 200, 88],
  [92, 184, 184], [198, 122, 176], [164, 140, 110], [140, 196, 240], [246, 190, 170], [172, 210, 130],
];

/** The colour of a patch. @param {number} patch its index */
export const patchColour = (patch) => PATCH_COLOURS[patch % PATCH_COLOURS.length];

/** A colour in CSS notation. @param {Colour} colour */
export const toCss = ([r, g, b]) => `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)})`;

/** A colour as an opaque pixel of a canvas. @param {Colour} colour */
export const toPixel = ([r, g, b]) => new Uint32Array(Uint8ClampedArray.of(r, g, b, 255).buffer)[0];

/**
 * @typedef {object} Scale colour scale of values around 0
 * @property {(value: number) => number} place position of a value on the scale, -1 to 1
 * @property {readonly { value: number, label: string }[]} ticks
 */

/**
 * A scale that is linear around 0 and logarithmic beyond, so that the noise of the input and that of the result are both visible.
 * @param {number} linearLimit value at which the linear part ends
 * @param {number} maximum value at the end of the scale
 * @returns {Scale}
 */
export function logarithmicScale(linearLimit, maximum) {
  const end = Math.asinh(Math.max(maximum, 10 * linearLimit) / linearLimit);
  const [low, high] = [Math.ceil(Math.log10(linearLimit)), Math.floor(Math.log10(Math.max(maximum, 10 * linearLimit)) + 1e-9)];
  const every = Math.max(1, Math.ceil((high - low + 1) / 3));
  const powers = [];
  for (let power = high; power >= low; power -= every) powers.push(power);
  return {
    place: (value) => Math.asinh(value / linearLimit) / end,
    ticks: [
      ...powers.map((power) => ({ value: -(10 ** power), label: `−${powerOfTen(power)}` })),
      { value: 0, label: '0' },
      ...[...powers].reverse().map((power) => ({ value: 10 ** power, label: powerOfTen(power) })),
    ],
  };
}

/** The label of a power of ten. @param {number} power */
function powerOfTen(power) {
  return power >= -2 && power <= 3 ? number(10 ** power) : `10${superscript(power)}`;
}

/** A linear scale with five ticks. @param {number} maximum value at the end of the scale @param {(value: number) => string} label @returns {Scale} */
export function linearScale(maximum, label) {
  return {
    place: (value) => value / maximum,
    ticks: [-maximum, -maximum / 2, 0, maximum / 2, maximum].map((value) => ({ value, label: label(value) })),
  };
}

/** Values without NaN in ascending order. Long fields are sampled. @param {readonly ArrayLike<number>[]} fields @param {(value: number) => number} [measure] */
export function sortedSample(fields, measure = (value) => value) {
  const total = fields.reduce((sum, { length }) => sum + length, 0);
  const step = Math.max(1, Math.floor(total / QUANTILE_SAMPLE_VALUES));
  const found = [];
  for (const values of fields) {
    for (let i = 0; i < values.length; i += step) {
      if (!Number.isNaN(values[i])) found.push(measure(values[i]));
    }
  }
  return Float64Array.from(found).sort();
}

/** A quantile of the absolute values. @param {readonly ArrayLike<number>[]} fields @param {number} share of the values below the quantile */
export function magnitudeQuantile(fields, share) {
  const sorted = sortedSample(fields, Math.abs);
  return sorted[Math.floor(share * (sorted.length - 1))] ?? 0;
}
