/** What is shown of curvatures, and how much a surface bends both ways at once within its smooth pieces: next to nothing, where they are sheets. */
import { magnitude } from './colours.js';

/** @typedef {import('../../pkg/types.js').Analysis} Analysis */
/** @typedef {import('../../pkg/types.js').PatchMap} PatchMap */

/**
 * From where on pieces are no sheets but creased all over: what is made of sheets comes to 0.4 at most, a bust to 0.7
 * and 1.8, mountains to 10.
 */
export const CREASED = 0.6;
/** Share of the vertices that counts: what is left are tips of cones and whatever else is a point or a line. */
const MOST = 0.95;
/** At most so many vertices are looked at. */
const SAMPLE = 40_000;
/** Cells from a crease that count as a part of it. */
const RIM = 3;
/** Area of a vertex' cell over the square of the spacing. */
const CELL = Math.sqrt(3) / 2;

/**
 * Total absolute Gaussian curvature away from creases and tips, in radians: that of a half ball is about 2π.
 * @param {Pick<PatchMap, 'rows' | 'cols' | 'labels' | 'spacing'>} patches
 * @param {{ gaussian: ArrayLike<number> }} analysis on the same lattice
 */
export function roundness({ rows, cols, labels, spacing }, { gaussian }) {
  const step = Math.ceil(labels.length / SAMPLE);
  /** @type {number[]} */
  const found = [];
  for (let row = RIM; row < rows - RIM; row++) {
    for (let i = row * cols + RIM + (row % step); i < (row + 1) * cols - RIM; i += step) {
      const label = labels[i];
      const curvature = gaussian[i];
      if (label < 0 || !(Math.abs(curvature) < Infinity)) continue;
      const [up, down] = [i - RIM * cols, i + RIM * cols];
      if (labels[i - RIM] !== label || labels[i + RIM] !== label || labels[up] !== label || labels[down] !== label) continue;
      if (labels[up - RIM] !== label || labels[up + RIM] !== label || labels[down - RIM] !== label || labels[down + RIM] !== label) continue;
      found.push(Math.abs(curvature));
    }
  }
  const kept = Float64Array.from(found).sort().subarray(0, Math.floor(MOST * found.length));
  return kept.reduce((sum, value) => sum + value, 0) * step * spacing * spacing * CELL;
}

/**
 * What is shown of an analysis, in half the memory.
 * @param {Analysis} analysis
 */
export function curvaturesOf({ rows, cols, spacing, origin, gaussian, kappa1, kappa2, summary }) {
  return {
    rows, cols, spacing, origin, summary,
    gaussian: new Float32Array(gaussian),
    kappa2: new Float32Array(kappa2),
    medianKappa1: magnitude([kappa1], 0.5),
  };
}
