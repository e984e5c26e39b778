/** What is drawn over a surface: colours for values, and lines. */
import { css } from './colours.js';
import { nearest } from './lattice.js';

/** @import {Grid, Lattice} from './lattice.js' */
/** @import {Colour} from './colours.js' */

/** @typedef {(x: number, y: number) => readonly [number, number]} Place from the plane to the canvas */

/**
 * @typedef {object} Line
 * @property {readonly (readonly [number, number, number])[]} points
 * @property {Colour} colour
 * @property {number} width in pixels of the page
 */

/**
 * @typedef {object} Layer
 * @property {Grid} grid
 * @property {HTMLCanvasElement} [image] colours of the grid's pixels, in the place of steel
 * @property {readonly Line[]} [lines]
 * @property {(x: number, y: number) => string} [read] the value at a place of the plane, with its name and unit
 */

/**
 * Pixels as what can be drawn.
 * @param {{ width: number, height: number }} size
 * @param {Uint32Array} pixels as the canvas' bytes
 */
export function canvasOf({ width, height }, pixels) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const image = new ImageData(new Uint8ClampedArray(/** @type {ArrayBuffer} */ (pixels.buffer)), width, height);
  canvas.getContext('2d')?.putImageData(image, 0, 0);
  return canvas;
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Place} place
 * @param {readonly Line[]} lines
 * @param {number} ratio pixels of the screen for one of the page
 */
export function drawLines(context, place, lines, ratio) {
  context.lineJoin = 'round';
  for (const { points, colour, width } of lines) {
    context.strokeStyle = css(colour);
    context.lineWidth = width * ratio;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(...place(x, y));
    context.stroke();
  }
}

/**
 * The value at the vertex nearest to a place, NaN beyond the lattice.
 * @param {Lattice & { values: ArrayLike<number> }} field
 * @param {number} x
 * @param {number} y
 */
export function valueAt({ values, ...lattice }, x, y) {
  const vertex = nearest(lattice, { width: 1, height: 1, pixelSize: 1, left: x - 0.5, top: y + 0.5 })[0];
  return vertex < 0 ? NaN : values[vertex];
}
