/** Photographs a printed page on the true surface of an example, from above. */
import { samplePage } from '../sample-page.js';
import { normalsOf, NORMAL_SCALE } from '../surface/normals.js';
import { extentOf, fillTriangles } from '../surface/triangles.js';

/** @import {Input} from '../session.js' */
/** @typedef {Pick<Input, 'width' | 'height' | 'pixelSize' | 'heightScale'> & { truth: Float64Array }} InputWithTruth */
/** @typedef {Pick<import('../../pkg/types.js').Unrolling, 'triangles' | 'positions' | 'places'>} Unrolling */

/** Length of the photo's longer side, about. */
const PHOTO_SIDE_PIXELS = 1000;
/** Vector to the light, y up. */
const LIGHT_DIRECTION = [-0.45, 0.4, 0.8];

/**
 * Renders the photo.
 * @param {InputWithTruth} input
 * @param {Unrolling} sheet the true surface, laid flat
 * @returns {ImageData}
 */
export function photographExample(input, { triangles, positions, places }) {
  const { width, height, pixelSize, heightScale, truth } = input;
  const scale = Math.max(1, Math.round(PHOTO_SIDE_PIXELS / Math.max(width, height)));
  const photo = new ImageData(width * scale, height * scale);
  const out = new Uint32Array(photo.data.buffer);

  const extent = extentOf(places);
  const page = samplePage(extent.width, extent.height);
  const ink = new Uint32Array(page.data.buffer);
  const dots = (page.width - 1) / extent.width;
  const photoPlaces = new Float64Array(places.length);
  for (let i = 0; 2 * i < photoPlaces.length; i++) {
    photoPlaces[2 * i] = (positions[3 * i] / pixelSize) * scale;
    photoPlaces[2 * i + 1] = (height - positions[3 * i + 1] / pixelSize) * scale;
  }
  const { xy } = normalsOf(truth, width, height, heightScale / pixelSize);
  fillTriangles(photo, triangles, photoPlaces, (pixel, t, a, b, c) => {
    const [i, j, k] = [2 * triangles[3 * t], 2 * triangles[3 * t + 1], 2 * triangles[3 * t + 2]];
    const x = a * places[i] + b * places[j] + c * places[k] - extent.left;
    const y = extent.top - (a * places[i + 1] + b * places[j + 1] + c * places[k + 1]);
    const colour = ink[Math.round(y * dots) * page.width + Math.round(x * dots)];
    const [col, row] = [Math.floor((pixel % photo.width) / scale), Math.floor(pixel / photo.width / scale)];
    out[pixel] = dim(colour, brightnessAt(xy, row * width + col));
  });
  return photo;
}

/** The brightness of a pixel by its normal, 0.5 to 1. @param {Int16Array} xy normals @param {number} i index of the pixel */
function brightnessAt(xy, i) {
  const [x, y] = [xy[2 * i] / NORMAL_SCALE, xy[2 * i + 1] / NORMAL_SCALE];
  const cosine = x * LIGHT_DIRECTION[0] + y * LIGHT_DIRECTION[1] + Math.sqrt(Math.max(0, 1 - x * x - y * y)) * LIGHT_DIRECTION[2];
  return 0.5 + 0.5 * Math.min(1, Math.max(0, cosine));
}

/** A pixel dimmed by the light. @param {number} colour @param {number} light 0 to 1 */
function dim(colour, light) {
  /** @param {number} shift */
  const part = (shift) => Math.round(((colour >>> shift) & 255) * light) << shift;
  return (0xff000000 | part(16) | part(8) | part(0)) >>> 0;
}
