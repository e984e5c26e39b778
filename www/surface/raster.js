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
 * Each pixel split into `factor` by `factor`, between them a smooth curve through the
 * pixels' normals (Catmull and Rom's cubic); holes keep their pixels' outline.
 * @param {Normals} normals
 * @param {number} factor
 * @returns {Raster}
 */
function refined(normals, factor) {
  const { width, height, xy } = normals;
  if (factor === 1) return thinned(normals, 1);
  const [cols, rows] = [width * factor, height * factor];
  const weights = cubicWeights(factor);
  const stretched = stretchRows(normals, factor, weights);
  const index = new Uint32Array(cols * rows);
  for (let row = 0, i = 0; row < rows; row++) {
    const home = Math.floor(row / factor);
    const { first, w } = weights[row % factor];
    const own = 2 * cols * home;
    const lines = w.map((_, k) => 2 * cols * clamp(home + first + k, height));
    for (let col = 0; col < cols; col++, i++) {
      if (xy[2 * (home * width + Math.floor(col / factor))] === HOLE) {
        index[i] = NOTHING;
        continue;
      }
      let nx = 0;
      let ny = 0;
      for (let k = 0; k < 4; k++) {
        // A neighbour in a hole is replaced by the pixel itself, here and below.
        const from = 2 * col + (Number.isNaN(stretched[lines[k] + 2 * col]) ? own : lines[k]);
        nx += w[k] * stretched[from];
        ny += w[k] * stretched[from + 1];
      }
      index[i] = entry(nx, ny, col, row);
    }
  }
  return { width: cols, height: rows, index };
}

/**
 * The rows refined along themselves only; NaN in holes.
 * @param {Normals} normals
 * @param {number} factor
 * @param {Weights[]} weights
 */
function stretchRows({ width, height, xy }, factor, weights) {
  const out = new Float32Array(2 * width * factor * height);
  for (let row = 0, i = 0; row < height; row++) {
    for (let col = 0; col < width; col++) {
      const here = row * width + col;
      for (let part = 0; part < factor; part++, i += 2) {
        if (xy[2 * here] === HOLE) {
          out[i] = NaN;
          continue;
        }
        const { first, w } = weights[part];
        for (let k = 0; k < 4; k++) {
          const there = row * width + clamp(col + first + k, width);
          const from = 2 * (xy[2 * there] === HOLE ? here : there);
          out[i] += w[k] * xy[from];
          out[i + 1] += w[k] * xy[from + 1];
        }
      }
    }
  }
  return out;
}

/** @typedef {{ first: number, w: readonly number[] }} Weights of four pixels, the first relative to the one that is split */

/**
 * For each part of a pixel, by its centre's place between the pixels' centres.
 * @param {number} factor
 * @returns {Weights[]}
 */
function cubicWeights(factor) {
  return Array.from({ length: factor }, (_, part) => {
    const place = (part + 0.5) / factor - 0.5;
    const t = place - Math.floor(place);
    return {
      first: Math.floor(place) - 1,
      w: [
        t * (-0.5 + t * (1 - 0.5 * t)),
        1 + t * t * (-2.5 + 1.5 * t),
        t * (0.5 + t * (2 - 1.5 * t)),
        t * t * (-0.5 + 0.5 * t),
      ],
    };
  });
}

/** @param {number} i @param {number} count */
function clamp(i, count) {
  return Math.min(count - 1, Math.max(0, i));
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
  const x = clamp(Math.floor((nx + UNIT) * scale + dither), SIDE);
  const y = clamp(Math.floor((ny + UNIT) * scale + dither), SIDE);
  return y * SIDE + x;
}
