/** Layers over a surface: images of coloured values, and lines. */
import { nearestVertices } from './lattice.js';

/** @import {Grid, Lattice} from './lattice.js' */
/** @import {Colour} from './colours.js' */

/**
 * @typedef {object} Line
 * @property {readonly (readonly [number, number, number])[]} points
 * @property {Colour} colour
 * @property {number} width in CSS pixels
 */

/**
 * @typedef {object} Layer
 * @property {Grid} grid
 * @property {HTMLCanvasElement} [image] colours of the grid's pixels, in place of steel
 * @property {readonly Line[]} [lines]
 * @property {(x: number, y: number) => string} [read] the value at a place of the plane, with its name and unit
 */

/** A canvas with an image. @param {ImageData} image */
export function canvasFromImage(image) {
  const canvas = document.createElement('canvas');
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext('2d')?.putImageData(image, 0, 0);
  return canvas;
}

/**
 * A canvas with pixels.
 * @param {{ width: number, height: number }} size
 * @param {Uint32Array} pixels in the byte order of a canvas
 */
export function canvasFromPixels({ width, height }, pixels) {
  return canvasFromImage(new ImageData(new Uint8ClampedArray(/** @type {ArrayBuffer} */ (pixels.buffer)), width, height));
}

/**
 * The value at the vertex nearest to a place; NaN outside the lattice.
 * @param {Lattice & { values: ArrayLike<number> }} field
 * @param {number} x
 * @param {number} y
 */
export function valueAt({ values, ...lattice }, x, y) {
  const vertex = nearestVertices(lattice, { width: 1, height: 1, pixelSize: 1, left: x - 0.5, top: y + 0.5 })[0];
  return vertex < 0 ? NaN : values[vertex];
}
