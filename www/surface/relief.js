/** Heights as they lie in space: their frame, the box around them, what is at a place, and marked pixels as points. */
import { gridOf } from './lattice.js';
import { extentOf } from './triangles.js';

/** @import {Pin} from '../design.js' */
/** @import {Input} from '../session.js' */
/** @import {Box} from './camera.js' */
/** @import {Line} from './layer.js' */
/** @import {Marks} from './marks.js' */
/** @import {Texels} from './look.js' */
/** @import {Normals} from './normals.js' */
/** @import {Relief, Sheet} from './space.js' */

/** The share of the heights that lie within the box. */
const WITHIN = 0.998;
/** Pixels of the page of a mark on the surface. */
const MARK = 5;

/** @param {Input} input @param {Pin} pin @returns {[number, number, number]} */
export function lengthsOf(input, { x, y, z }) {
  const { left, top, pixelSize, width, height } = gridOf(input);
  return [
    left + (0.5 + x * (width - 1)) * pixelSize,
    top - (0.5 + (1 - y) * (height - 1)) * pixelSize,
    z * width * pixelSize,
  ];
}

/** @param {number} value */
export function clamp(value) {
  return Math.min(1, Math.max(0, value));
}

/**
 * @param {Input} input
 * @param {Normals} normals
 * @param {ArrayLike<number>} heights
 * @param {number} heightScale
 * @param {Texels} [texels]
 * @returns {Relief}
 */
export function reliefOf(input, normals, heights, heightScale, texels) {
  const { width, height, pixelSize, left, top } = gridOf(input);
  return { normals, heights, heightScale, texels, extent: { left, top, width: width * pixelSize, height: height * pixelSize } };
}

/** @param {Relief} relief @param {number} x @param {number} y */
export function heightOn({ normals: { width, height }, heights, heightScale, extent }, x, y) {
  const col = Math.floor(((x - extent.left) / extent.width) * width);
  const row = Math.floor(((extent.top - y) / extent.height) * height);
  if (col < 0 || row < 0 || col >= width || row >= height) return NaN;
  return heights[row * width + col] * heightScale;
}

/**
 * Around nearly all heights: what noise has thrown far off is no reason to look at the rest from afar.
 * @param {Input} input
 */
export function boxOf(input) {
  const { width, height, pixelSize, left, top } = gridOf(input);
  const step = Math.max(1, Math.floor(input.data.length / 20_000));
  const found = [];
  for (let i = 0; i < input.data.length; i += input.design ? 1 : step) {
    const z = input.data[i] * input.heightScale;
    if (!Number.isNaN(z)) found.push(z);
  }
  const sorted = Float64Array.from(found).sort();
  const most = sorted.length - 1;
  const [low, high] = [sorted[Math.ceil((1 - WITHIN) * most)] ?? 0, sorted[Math.floor(WITHIN * most)] ?? 0];
  return { left, top, width: width * pixelSize, height: height * pixelSize, low, high };
}

/**
 * Around a mesh on its whole way, too.
 * @param {Sheet} sheet
 * @param {Box} box
 * @returns {Box}
 */
export function boxAround({ forms }, { left, top, width, height, low, high }) {
  const flat = extentOf(forms[forms.length - 1], 3);
  const right = Math.max(left + width, flat.left + flat.width);
  const bottom = Math.min(top - height, flat.top - flat.height);
  left = Math.min(left, flat.left);
  top = Math.max(top, flat.top);
  return { left, top, width: right - left, height: top - bottom, low, high };
}

/**
 * Marked pixels as points on the surface.
 * @param {readonly Marks[]} marks
 * @param {Input} input
 * @returns {Line[]}
 */
export function pointsOf(marks, input) {
  const { left, top, pixelSize } = gridOf(input);
  /** @type {Line[]} */
  const points = [];
  for (const { width, pixels, colour } of marks) {
    /** @param {number} at */
    const byte = (at) => Number.parseInt(colour.slice(at, at + 2), 16);
    const rgb = /** @type {const} */ ([byte(1), byte(3), byte(5)]);
    for (const i of pixels) {
      const z = input.data[i] * input.heightScale;
      if (Number.isNaN(z)) continue;
      const place = /** @type {const} */ ([left + (i % width + 0.5) * pixelSize, top - (Math.floor(i / width) + 0.5) * pixelSize, z]);
      points.push({ points: [place], colour: rgb, width: MARK });
    }
  }
  return points;
}
