/** A printed page on an example's true surface, photographed from above: something to make flat. */
import { printed } from '../sample-page.js';
import { normalsOf, UNIT } from '../surface/normals.js';
import { extentOf, fillTriangles } from '../surface/triangles.js';

/** @import {Input} from '../session.js' */
/** @typedef {Pick<Input, 'width' | 'height' | 'pixelSize' | 'heightScale'> & { truth: Float64Array }} Known */
/** @typedef {Pick<import('../../pkg/types.js').Unrolling, 'triangles' | 'positions' | 'places'>} Unrolling */

/** Pixels along the longer side of the photo, about. */
const PHOTO = 1000;
const LIGHT = [-0.45, 0.4, 0.8];

/**
 * @param {Known} input
 * @param {Unrolling} sheet the true surface, laid flat
 * @returns {ImageData}
 */
export function photographed(input, { triangles, positions, places }) {
  const { width, height, pixelSize, heightScale, truth } = input;
  const scale = Math.max(1, Math.round(PHOTO / Math.max(width, height)));
  const photo = new ImageData(width * scale, height * scale);
  const out = new Uint32Array(photo.data.buffer);

  const extent = extentOf(places);
  const page = printed(extent.width, extent.height);
  const ink = new Uint32Array(page.data.buffer);
  const dots = (page.width - 1) / extent.width;
  const seen = new Float64Array(places.length);
  for (let i = 0; 2 * i < seen.length; i++) {
    seen[2 * i] = (positions[3 * i] / pixelSize) * scale;
    seen[2 * i + 1] = (height - positions[3 * i + 1] / pixelSize) * scale;
  }
  const { xy } = normalsOf(truth, width, height, heightScale / pixelSize);
  fillTriangles(photo, triangles, seen, (pixel, t, a, b, c) => {
    const [i, j, k] = [2 * triangles[3 * t], 2 * triangles[3 * t + 1], 2 * triangles[3 * t + 2]];
    const x = a * places[i] + b * places[j] + c * places[k] - extent.left;
    const y = extent.top - (a * places[i + 1] + b * places[j + 1] + c * places[k + 1]);
    const colour = ink[Math.round(y * dots) * page.width + Math.round(x * dots)];
    const [col, row] = [Math.floor((pixel % photo.width) / scale), Math.floor(pixel / photo.width / scale)];
    out[pixel] = dimmed(colour, lit(xy, row * width + col));
  });
  return photo;
}

/** @param {Int16Array} xy @param {number} i */
function lit(xy, i) {
  const [x, y] = [xy[2 * i] / UNIT, xy[2 * i + 1] / UNIT];
  const cosine = x * LIGHT[0] + y * LIGHT[1] + Math.sqrt(Math.max(0, 1 - x * x - y * y)) * LIGHT[2];
  return 0.5 + 0.5 * Math.min(1, Math.max(0, cosine));
}

/** @param {number} colour as the canvas' bytes @param {number} light */
function dimmed(colour, light) {
  /** @param {number} shift */
  const part = (shift) => Math.round(((colour >>> shift) & 255) * light) << shift;
  return (0xff000000 | part(16) | part(8) | part(0)) >>> 0;
}
