/** The total Gaussian curvature of a surface's patches, which is near 0 if they are developable. */
import { ROW_SPACING_RATIO } from './lattice.js';

/** @typedef {import('../../pkg/types.js').PatchMap} PatchMap */

/** Maximum total curvature of patches that are sheets. Examples made of sheets have 0.4 at most, a bust 0.7 and 1.8, mountains 10. */
export const MAX_SHEET_CURVATURE_RADIANS = 0.6;
/** Share of the vertices that are counted. The others have the largest curvature: tips of cones and lines. */
const KEPT_VERTEX_SHARE = 0.95;
/** Maximum number of sampled vertices. */
const MAX_SAMPLED_VERTICES = 40_000;
/** Distance from a crease within which vertices are not counted, in cells. */
const CREASE_MARGIN_CELLS = 3;

/**
 * The integral of the absolute Gaussian curvature away from creases and tips, in radians: 2π for a hemisphere.
 * @param {Pick<PatchMap, 'rows' | 'cols' | 'labels' | 'spacing'>} patches
 * @param {{ gaussian: ArrayLike<number> }} analysis on the same lattice
 */
export function totalGaussianCurvature({ rows, cols, labels, spacing }, { gaussian }) {
  const step = Math.ceil(labels.length / MAX_SAMPLED_VERTICES);
  const around = [-1, 0, 1].flatMap((down) => [-1, 0, 1].map((right) => CREASE_MARGIN_CELLS * (down * cols + right)));
  /** @type {number[]} */
  const found = [];
  for (let row = CREASE_MARGIN_CELLS; row < rows - CREASE_MARGIN_CELLS; row++) {
    for (let i = row * cols + CREASE_MARGIN_CELLS + (row % step); i < (row + 1) * cols - CREASE_MARGIN_CELLS; i += step) {
      const label = labels[i];
      const curvature = gaussian[i];
      if (label < 0 || !(Math.abs(curvature) < Infinity)) continue;
      if (around.every((offset) => labels[i + offset] === label)) found.push(Math.abs(curvature));
    }
  }
  const kept = Float64Array.from(found).sort().subarray(0, Math.floor(KEPT_VERTEX_SHARE * found.length));
  return kept.reduce((sum, value) => sum + value, 0) * step * spacing * spacing * ROW_SPACING_RATIO;
}
