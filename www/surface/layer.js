/** What is drawn over a surface: colours for values, and lines. */
import { divergingPixel } from './colours.js';
import { interpolated, nearest } from './lattice.js';

/** @import {Grid, Lattice} from './lattice.js' */
/** @import {Scale} from './colours.js' */

/** @typedef {(x: number, y: number) => readonly [number, number]} Place from the plane to the canvas */

/**
 * @typedef {object} Layer
 * @property {Grid} grid
 * @property {HTMLCanvasElement} [image] colours of the grid's pixels, in the place of steel
 * @property {(context: CanvasRenderingContext2D, place: Place, ratio: number) => void} [draw]
 *   `ratio`: pixels of the screen for one of the page
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
 * Draws lines through points of the plane.
 * @param {CanvasRenderingContext2D} context
 * @param {Place} place
 * @param {readonly (readonly [number, number, number])[]} points
 */
export function drawLine(context, place, points) {
  context.beginPath();
  for (const [x, y] of points) context.lineTo(...place(x, y));
  context.stroke();
}
