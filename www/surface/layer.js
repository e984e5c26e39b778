/** Layers over a surface: images of coloured values, and lines. */
import { nearestVertices } from './lattice.js';

/** @import {Lattice} from './lattice.js' */
/** @import {Place, Surface} from './scene.js' */
/** @import {Colours} from '../views/legend.js' */

/**
 * @typedef {object} Line
 * @property {readonly (readonly [number, number, number])[]} points
 * @property {Colour} colour
 * @property {number} width in CSS pixels
 */

/**
 * What a view shows on the input or on the result.
 * @typedef {object} Layer
 * @property {Surface} [surface] in place of the plain one
 * @property {HTMLCanvasElement} [image] colours of the heights' pixels, in place of steel
 * @property {readonly Line[]} [lines]
 * @property {(place: Place) => string} [read] the value at a place, with its name and unit
 */

/**
 * The content of a view.
 * @typedef {object} ViewContent
 * @property {readonly [Layer | undefined, Layer | undefined]} [layers] on the input and on the result
 * @property {Picture} [flat] picture in place of both surfaces
 * @property {string} [said] sentence below the view
 * @property {Colours} [colours]
 * @property {readonly Node[]} [about] further elements below the view
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
