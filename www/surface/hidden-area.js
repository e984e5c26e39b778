/** Measures how much of a mesh is hidden in its heights from one side. */
import { ROW_SPACING_RATIO } from './lattice.js';

/** Minimum depth of a hidden triangle behind the heights, in spacings. */
const MIN_HIDDEN_DEPTH_SPACINGS = 3;

/**
 * The share of a mesh's area that lies behind its heights.
 * @param {Pick<import('../api.js').Mesh, 'positions' | 'triangles'>} mesh
 * @param {Pick<import('../api.js').SampledMesh, 'rows' | 'cols' | 'spacing' | 'origin' | 'heights' | 'frame'>} sampled
 */
export function hiddenAreaShare({ positions, triangles }, { rows, cols, spacing, origin, heights, frame: { right, up, towards } }) {
  const axes = [right, up, towards];
  let [whole, hidden] = [0, 0];
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * triangles[i + k];
      return axes.map((axis) => axis[0] * positions[at] + axis[1] * positions[at + 1] + axis[2] * positions[at + 2]);
    });
    const [u, v] = [b, c].map((corner) => corner.map((x, k) => x - a[k]));
    const area = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    if (!Number.isFinite(area)) continue;
    const [x, y, z] = a.map((first, k) => (first + b[k] + c[k]) / 3);
    const row = Math.round((origin[1] - y) / (spacing * ROW_SPACING_RATIO));
    const col = Math.round((x - origin[0]) / spacing + (row % 2) / 2);
    const inside = row >= 0 && row < rows && col >= 0 && col < cols;
    whole += area;
    if (inside && heights[row * cols + col] - z > MIN_HIDDEN_DEPTH_SPACINGS * spacing) hidden += area;
  }
  return whole > 0 ? hidden / whole : 0;
}
