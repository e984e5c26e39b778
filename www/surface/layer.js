/** What is drawn over a surface: colours for values, and lines. */
import { css, divergingPixel } from './colours.js';
import { interpolated, nearest } from './lattice.js';

/** @import {Grid, Lattice} from './lattice.js' */
/** @import {Colour, Scale} from './colours.js' */

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
 * Values by colour.
 * @param {Lattice & { values: ArrayLike<number> }} field
 * @param {Grid} grid
 * @param {Scale} scale
 */
export function valueImage({ values, ...lattice }, grid, scale) {
  const found = interpolated(lattice, values, grid);
  return imageOf(grid, (i) => (Number.isNaN(found[i]) ? 0 : divergingPixel(scale.place(found[i]))));
}

/**
 * Labels by colour.
 * @param {Lattice & { labels: ArrayLike<number> }} field
 * @param {Grid} grid
 * @param {(label: number) => number} pixel
 */
export function labelImage({ labels, ...lattice }, grid, pixel) {
  const vertices = nearest(lattice, grid);
  return imageOf(grid, (i) => {
    const vertex = vertices[i];
    if (vertex < 0) return 0;
    // At the border the nearest vertex may lie beyond it, and one beside it does not.
    const near = labels[vertex] >= 0 ? vertex : labels[vertex - 1] >= 0 ? vertex - 1 : vertex + 1;
    return labels[near] >= 0 ? pixel(labels[near]) : 0;
  });
}

/**
 * @param {{ width: number, height: number }} size
 * @param {(pixel: number) => number} colour as the canvas' bytes; 0 is nothing
 */
export function imageOf({ width, height }, colour) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d');
  if (!context) return canvas;
  const image = context.createImageData(width, height);
  const out = new Uint32Array(image.data.buffer);
  for (let i = 0; i < out.length; i++) out[i] = colour(i);
  context.putImageData(image, 0, 0);
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
