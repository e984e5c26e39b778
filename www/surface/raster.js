/**
 * Normals as indices into a table of colours, at about the screen's resolution.
 *
 * An image smaller than its place on the screen is refined by interpolating *normals*, not
 * colours, so that highlights stay sharp; a much larger one is thinned out first. What is left
 * of the way to the screen is a reduction by less than a factor of four.
 */
import { HOLE, UNIT } from './normals.js';

/** @import {Normals} from './normals.js' */

/**
 * @typedef {object} Raster
 * @property {number} width
 * @property {number} height
 * @property {Uint32Array} index
 */

/** Entries of the table along x and y of the normal. */
export const SIDE = 512;
/** The entry after the last one: no surface. */
export const NOTHING = SIDE * SIDE;

const MAX_REFINEMENT = 8;
/** More pixels than this are never shaded, however large the screen. */
const MAX_PIXELS = 4e6;

/**
 * @param {Normals} normals
 * @param {number} density pixels of the screen for each pixel of the image
 * @returns {Raster}
 */
export function rasterOf(normals, density) {
  const pixels = normals.width * normals.height;
  if (density <= 1) {
    const enough = Math.max(1, Math.floor(1 / (2 * density)));
    return thinned(normals, Math.max(enough, Math.ceil(Math.sqrt(pixels / MAX_PIXELS))));
  }
  const most = Math.max(1, Math.floor(Math.sqrt(MAX_PIXELS / pixels)));
  return refined(normals, Math.min(Math.ceil(density), most, MAX_REFINEMENT));
}

/**
 * Every `step`-th pixel of every `step`-th row.
 * @param {Normals} normals
 * @param {number} step
 * @returns {Raster}
 */
function thinned({ width, height, xy }, step) {
  const cols = Math.ceil(width / step);
  const rows = Math.ceil(height / step);
  const index = new Uint32Array(cols * rows);
  for (let row = 0, i = 0; row < rows; row++) {
    for (let col = 0; col < cols; col++, i++) {
      const at = 2 * (row * step * width + col * step);
      index[i] = xy[at] === HOLE ? NOTHING : entry(xy[at], xy[at + 1], col, row);
    }
  }
  return { width: cols, height: rows, index };
}

/**
 * Each pixel split into `factor` by `factor`; holes keep their pixels' outline.
 * @param {Normals} normals
 * @param {number} factor
 * @returns {Raster}
 */
function refined(normals, factor) {
  const { width, height, xy } = normals;
  if (factor === 1) return thinned(normals, 1);
  const cols = width * factor;
  const rows = height * factor;
  const index = new Uint32Array(cols * rows);
  for (let row = 0, i = 0; row < rows; row++) {
    const y = (row + 0.5) / factor - 0.5;
    const home = Math.floor(row / factor) * width;
    const top = Math.max(0, Math.floor(y)) * width;
    const bottom = Math.min(height - 1, Math.floor(y) + 1) * width;
    const down = y - Math.floor(y);
    for (let col = 0; col < cols; col++, i++) {
      const here = home + Math.floor(col / factor);
      if (xy[2 * here] === HOLE) {
        index[i] = NOTHING;
        continue;
      }
      const x = (col + 0.5) / factor - 0.5;
      const left = Math.max(0, Math.floor(x));
      const right = Math.min(width - 1, Math.floor(x) + 1);
      const across = x - Math.floor(x);
      // A neighbour in a hole is replaced by the pixel itself.
      const a = valid(xy, top + left, here);
      const b = valid(xy, top + right, here);
      const c = valid(xy, bottom + left, here);
      const d = valid(xy, bottom + right, here);
      const nx = mix(mix(xy[a], xy[b], across), mix(xy[c], xy[d], across), down);
      const ny = mix(mix(xy[a + 1], xy[b + 1], across), mix(xy[c + 1], xy[d + 1], across), down);
      index[i] = entry(nx, ny, col, row);
    }
  }
  return { width: cols, height: rows, index };
}

/** @param {Int16Array} xy @param {number} pixel @param {number} otherwise */
function valid(xy, pixel, otherwise) {
  return 2 * (xy[2 * pixel] === HOLE ? otherwise : pixel);
}

/** @param {number} a @param {number} b @param {number} t */
function mix(a, b, t) {
  return a + t * (b - a);
}

/**
 * The table's entry for a normal. Rounded up or down by a pattern of the position,
 * so that slow changes of the normal do not show as bands.
 * @param {number} nx
 * @param {number} ny
 * @param {number} col
 * @param {number} row
 */
function entry(nx, ny, col, row) {
  const p = 0.06711056 * col + 0.00583715 * row;
  const noise = 52.9829189 * (p - Math.floor(p));
  const dither = noise - Math.floor(noise);
  const scale = (SIDE - 1) / (2 * UNIT);
  const x = Math.min(SIDE - 1, Math.floor((nx + UNIT) * scale + dither));
  const y = Math.min(SIDE - 1, Math.floor((ny + UNIT) * scale + dither));
  return y * SIDE + x;
}
