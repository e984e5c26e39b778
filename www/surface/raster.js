/**
 * Normals as indices into a table of colours, at about the screen's resolution.
 *
 * An image smaller than its place on the screen is refined by interpolating *normals*, not
 * colours, so that highlights stay sharp; a much larger one is subsampled first. The browser
 * then reduces the raster to the screen by a factor below four.
 */
import { NO_NORMAL, NORMAL_SCALE } from './normals.js';

/** @import {Normals} from './normals.js' */

/**
 * @typedef {object} NormalRaster
 * @property {number} width
 * @property {number} height
 * @property {Uint32Array} index
 */

/** Number of entries of the table along x and along y of the normal. */
export const TABLE_SIDE = 512;
/** Index of the entry for pixels without a surface, after the last normal. */
export const EMPTY_ENTRY = TABLE_SIDE * TABLE_SIDE;

/** Maximum number of raster pixels per image pixel, along a side. */
const MAX_REFINEMENT_FACTOR = 8;
/** Maximum number of shaded pixels, however large the screen. */
const MAX_PIXELS = 4e6;

/**
 * Rasterises normals at about the resolution of the screen.
 * @param {Normals} normals
 * @param {number} density device pixels per pixel of the image
 * @returns {NormalRaster}
 */
export function rasteriseNormals(normals, density) {
  const pixels = normals.width * normals.height;
  if (density <= 1) {
    const displayStep = Math.max(1, Math.floor(1 / (2 * density)));
    return subsampleNormals(normals, Math.max(displayStep, Math.ceil(Math.sqrt(pixels / MAX_PIXELS))));
  }
  const maxFactor = Math.max(1, Math.floor(Math.sqrt(MAX_PIXELS / pixels)));
  return refineNormals(normals, Math.min(Math.ceil(density), maxFactor, MAX_REFINEMENT_FACTOR));
}

/**
 * Takes every `step`-th pixel of every `step`-th row.
 * @param {Normals} normals
 * @param {number} step
 * @returns {NormalRaster}
 */
function subsampleNormals({ width, height, xy }, step) {
  const cols = Math.ceil(width / step);
  const rows = Math.ceil(height / step);
  const index = new Uint32Array(cols * rows);
  for (let row = 0, i = 0; row < rows; row++) {
    for (let col = 0; col < cols; col++, i++) {
      const at = 2 * (row * step * width + col * step);
      index[i] = xy[at] === NO_NORMAL ? EMPTY_ENTRY : tableEntry(xy[at], xy[at + 1], col, row);
    }
  }
  return { width: cols, height: rows, index };
}

/**
 * Splits each pixel into `factor` by `factor` and interpolates the normals by Catmull-Rom cubics. Holes keep the outline of
 * their pixels.
 * @param {Normals} normals
 * @param {number} factor
 * @returns {NormalRaster}
 */
function refineNormals(normals, factor) {
  const { width, height, xy } = normals;
  if (factor === 1) return subsampleNormals(normals, 1);
  const [cols, rows] = [width * factor, height * factor];
  const weights = cubicWeights(factor);
  const stretched = stretchRows(normals, factor, weights);
  const index = new Uint32Array(cols * rows);
  for (let row = 0, i = 0; row < rows; row++) {
    const home = Math.floor(row / factor);
    const { first, w } = weights[row % factor];
    const own = 2 * cols * home;
    const lines = w.map((_, k) => 2 * cols * clampIndex(home + first + k, height));
    for (let col = 0; col < cols; col++, i++) {
      if (xy[2 * (home * width + Math.floor(col / factor))] === NO_NORMAL) {
        index[i] = EMPTY_ENTRY;
        continue;
      }
      let nx = 0;
      let ny = 0;
      for (let k = 0; k < 4; k++) {
        // The pixel itself replaces a neighbour in a hole, here and in `stretchRows`.
        const from = 2 * col + (Number.isNaN(stretched[lines[k] + 2 * col]) ? own : lines[k]);
        nx += w[k] * stretched[from];
        ny += w[k] * stretched[from + 1];
      }
      index[i] = tableEntry(nx, ny, col, row);
    }
  }
  return { width: cols, height: rows, index };
}

/**
 * Refines each row along itself; NaN in holes.
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
        if (xy[2 * here] === NO_NORMAL) {
          out[i] = NaN;
          continue;
        }
        const { first, w } = weights[part];
        for (let k = 0; k < 4; k++) {
          const there = row * width + clampIndex(col + first + k, width);
          const from = 2 * (xy[2 * there] === NO_NORMAL ? here : there);
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
 * The interpolation weights for each part of a split pixel.
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
function clampIndex(i, count) {
  return Math.min(count - 1, Math.max(0, i));
}

/**
 * The table's entry for a normal, rounded with a dither pattern that hides banding (interleaved gradient noise).
 * @param {number} nx
 * @param {number} ny
 * @param {number} col
 * @param {number} row
 */
function tableEntry(nx, ny, col, row) {
  const p = 0.06711056 * col + 0.00583715 * row;
  const noise = 52.9829189 * (p - Math.floor(p));
  const dither = noise - Math.floor(noise);
  const scale = (TABLE_SIDE - 1) / (2 * NORMAL_SCALE);
  const x = clampIndex(Math.floor((nx + NORMAL_SCALE) * scale + dither), TABLE_SIDE);
  const y = clampIndex(Math.floor((ny + NORMAL_SCALE) * scale + dither), TABLE_SIDE);
  return y * TABLE_SIDE + x;
}
