/** Heights in space: their surface, bounding box, height at a place, and marked pixels as points. */
import { gridOf } from './lattice.js';
import { extentOf } from './triangles.js';

/** @import {Pin} from '../design.js' */
/** @import {Input} from '../session.js' */
/** @import {Box} from './camera.js' */
/** @import {Line} from './layer.js' */
/** @import {PixelMarks} from './marks.js' */
/** @import {SurfaceTextures} from './textures.js' */
/** @import {Normals} from './normals.js' */
/** @import {Relief, MorphingMesh} from './surface-renderer.js' */

/** Quantile of the heights at the top of the box; the bottom is at the opposite quantile. */
const BOX_HEIGHT_SHARE = 0.998;
/** Side of a mark on the surface, in CSS pixels. */
const MARK_SIDE_PIXELS = 5;
/** Number of heights from which the box is computed, about. */
const BOX_SAMPLE_HEIGHTS = 20_000;

/** The position of a pin in space. @param {Input} input @param {Pin} pin @returns {[number, number, number]} */
export function pinPosition(input, { x, y, z }) {
  const { left, top, pixelSize, width, height } = gridOf(input);
  return [
    left + (0.5 + x * (width - 1)) * pixelSize,
    top - (0.5 + (1 - y) * (height - 1)) * pixelSize,
    z * width * pixelSize,
  ];
}

/** The value clamped to 0 to 1. @param {number} value */
export function clampToUnit(value) {
  return Math.min(1, Math.max(0, value));
}

/**
 * The surface of heights on the grid of an input.
 * @param {Input} input
 * @param {Normals} normals
 * @param {ArrayLike<number>} heights
 * @param {number} heightScale
 * @param {SurfaceTextures} [textures]
 * @returns {Relief}
 */
export function reliefOf(input, normals, heights, heightScale, textures) {
  const { width, height, pixelSize, left, top } = gridOf(input);
  return { normals, heights, heightScale, textures, extent: { left, top, width: width * pixelSize, height: height * pixelSize } };
}

/** The height at a place of the plane, NaN outside. @param {Relief} relief @param {number} x @param {number} y */
export function heightAt({ normals: { width, height }, heights, heightScale, extent }, x, y) {
  const col = Math.floor(((x - extent.left) / extent.width) * width);
  const row = Math.floor(((extent.top - y) / extent.height) * height);
  if (col < 0 || row < 0 || col >= width || row >= height) return NaN;
  return heights[row * width + col] * heightScale;
}

/**
 * The bounding box of the heights without outliers, which would make the rest small.
 * @param {Input} input
 */
export function heightfieldBox(input) {
  const { width, height, pixelSize, left, top } = gridOf(input);
  const step = Math.max(1, Math.floor(input.data.length / BOX_SAMPLE_HEIGHTS));
  const found = [];
  for (let i = 0; i < input.data.length; i += input.design ? 1 : step) {
    const z = input.data[i] * input.heightScale;
    if (!Number.isNaN(z)) found.push(z);
  }
  const sorted = Float64Array.from(found).sort();
  const most = sorted.length - 1;
  const [low, high] = [sorted[Math.ceil((1 - BOX_HEIGHT_SHARE) * most)] ?? 0, sorted[Math.floor(BOX_HEIGHT_SHARE * most)] ?? 0];
  return { left, top, width: width * pixelSize, height: height * pixelSize, low, high };
}

/**
 * The box expanded so that it contains the flat form of a morphing mesh.
 * @param {MorphingMesh} sheet
 * @param {Box} box
 * @returns {Box}
 */
export function expandBox({ forms }, { left, top, width, height, low, high }) {
  const flat = extentOf(forms[forms.length - 1], 3);
  const right = Math.max(left + width, flat.left + flat.width);
  const bottom = Math.min(top - height, flat.top - flat.height);
  left = Math.min(left, flat.left);
  top = Math.max(top, flat.top);
  return { left, top, width: right - left, height: top - bottom, low, high };
}

/**
 * Marked pixels as points on the surface.
 * @param {readonly PixelMarks[]} marks
 * @param {Input} input
 * @returns {Line[]}
 */
export function markPoints(marks, input) {
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
      points.push({ points: [place], colour: rgb, width: MARK_SIDE_PIXELS });
    }
  }
  return points;
}
