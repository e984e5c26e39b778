/** Converts values at the vertices of a hexagonal lattice to images. */

/**
 * @typedef {object} Lattice row 0 is at the top; odd rows are shifted to the left by half a spacing
 * @property {number} rows
 * @property {number} cols
 * @property {number} spacing
 * @property {readonly [number, number]} [origin] of vertex (0, 0), y up
 */

/**
 * @typedef {object} Grid the pixels of an image in the plane of the lattice
 * @property {number} width
 * @property {number} height
 * @property {number} pixelSize
 * @property {number} left
 * @property {number} top
 */

/** Distance of two rows of the lattice, in spacings. */
export const ROW_SPACING_RATIO = Math.sqrt(3) / 2;

/**
 * Longest side of the bounding box of the vertices with a height.
 * @param {Pick<Lattice, 'cols' | 'spacing'> & { heights: ArrayLike<number> }} lattice
 */
export function longestLatticeSide({ cols, spacing, heights }) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let i = 0; i < heights.length; i++) {
    if (!Number.isFinite(heights[i])) continue;
    const row = Math.floor(i / cols);
    [(i % cols - 0.5 * (row % 2)) * spacing, row * ROW_SPACING_RATIO * spacing, heights[i]].forEach((value, k) => {
      low[k] = Math.min(low[k], value);
      high[k] = Math.max(high[k], value);
    });
  }
  return Math.max(...high.map((value, k) => value - low[k]));
}

/**
 * The pixels of an input, or those that show its lattice.
 * @param {Pick<Input, 'width' | 'height' | 'pixelSize' | 'lattice'>} input
 * @returns {Grid}
 */
export function gridOf({ width, height, pixelSize, lattice }) {
  return lattice ? gridOverLattice(lattice) : { width, height, pixelSize, left: 0, top: height * pixelSize };
}

/**
 * Pixels that cover a lattice and are as wide as its spacing.
 * @param {Lattice} lattice
 * @returns {Grid}
 */
export function gridOverLattice({ rows, cols, spacing, origin = [0, 0] }) {
  return {
    width: cols,
    height: Math.max(1, Math.round((rows - 1) * ROW_SPACING_RATIO) + 1),
    pixelSize: spacing,
    // The vertices of the top row lie at the centres of pixels.
    left: origin[0] - 0.5 * spacing,
    top: origin[1] + 0.5 * spacing,
  };
}

/**
 * Interpolates values of a lattice at the pixels of a grid, linearly along and between rows; NaN outside and beside NaN.
 * @param {Lattice} lattice
 * @param {ArrayLike<number>} values
 * @param {Grid} grid
 */
export function interpolateToGrid({ rows, cols, spacing, origin = [0, 0] }, values, { width, height, pixelSize, left, top }) {
  const out = new Float64Array(width * height).fill(NaN);
  /** @param {number} row @param {number} x in spacings, from the even rows' first vertex */
  const along = (row, x) => {
    const place = clampToRange(x + 0.5 * (row % 2), cols);
    const col = Math.floor(place);
    const from = row * cols + col;
    return interpolate(values[from], values[from + 1], place - col);
  };
  for (let i = 0, pixel = 0; i < height; i++) {
    const down = clampToRange((origin[1] - top + (i + 0.5) * pixelSize) / (spacing * ROW_SPACING_RATIO), rows);
    const row = Math.floor(down);
    for (let k = 0; k < width; k++, pixel++) {
      if (Number.isNaN(down)) continue;
      const x = (left + (k + 0.5) * pixelSize - origin[0]) / spacing;
      out[pixel] = down === row ? along(row, x) : interpolate(along(row, x), along(row + 1, x), down - row);
    }
  }
  return out;
}

/**
 * An index clamped to the range of `count` items; NaN if it is farther outside than pixels of the border reach.
 * @param {number} place
 * @param {number} count
 */
function clampToRange(place, count) {
  const inside = Math.min(count - 1, Math.max(0, place));
  return Math.abs(place - inside) < 0.6 ? inside : NaN;
}

/**
 * A neighbour without weight need not be there.
 * @param {number} a
 * @param {number} b
 * @param {number} share
 */
function interpolate(a, b, share) {
  if (share < 1e-9) return a;
  return share > 1 - 1e-9 ? b : a * (1 - share) + b * share;
}

/**
 * The index of the vertex nearest to each pixel; -1 if it is more than a spacing away.
 * @param {Lattice} lattice
 * @param {Grid} grid
 */
export function nearestVertices({ rows, cols, spacing, origin = [0, 0] }, { width, height, pixelSize, left, top }) {
  const out = new Int32Array(width * height).fill(-1);
  for (let i = 0, pixel = 0; i < height; i++) {
    const down = (origin[1] - top + (i + 0.5) * pixelSize) / (spacing * ROW_SPACING_RATIO);
    const row = Math.min(rows - 1, Math.max(0, Math.round(down)));
    if (Math.abs(down - row) > 1) continue;
    for (let k = 0; k < width; k++, pixel++) {
      const across = (left + (k + 0.5) * pixelSize - origin[0]) / spacing + 0.5 * (row % 2);
      const col = Math.min(cols - 1, Math.max(0, Math.round(across)));
      if (Math.abs(across - col) <= 1) out[pixel] = row * cols + col;
    }
  }
  return out;
}
