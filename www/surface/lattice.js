/** Converts values at the vertices of a hexagonal lattice to images. */

/**
 * @typedef {object} Lattice row 0 is at the top; odd rows are shifted to the left by half a spacing
 * @property {number} rows
 * @property {number} cols
 * @property {number} spacing
 * @property {readonly [number, number]} [origin] of vertex (0, 0), y up
 */

/** @typedef {{ width: number, height: number, pixelSize: number, left: number, top: number }} Grid the pixels of an image in the plane of the lattice */

/** Distance of two rows of the lattice, in spacings. */
export const ROW_SPACING_RATIO = Math.sqrt(3) / 2;

/** Coordinates x, y, z of the vertices, from the even rows' first one; NaN without a height. @param {Pick<Lattice, 'cols' | 'spacing'> & { heights: ArrayLike<number> }} lattice */
export function latticePositions({ cols, spacing, heights }) {
  return Float64Array.from({ length: 3 * heights.length }, (_, i) => {
    const [vertex, row] = [Math.floor(i / 3), Math.floor(i / 3 / cols)];
    if (!Number.isFinite(heights[vertex])) return NaN;
    return [(vertex % cols - 0.5 * (row % 2)) * spacing, -row * ROW_SPACING_RATIO * spacing, heights[vertex]][i % 3];
  });
}

/** The pixels of an input, or those that show its lattice. @param {Pick<Input, 'width' | 'height' | 'pixelSize' | 'lattice'>} input @returns {Grid} */
export function gridOf({ width, height, pixelSize, lattice }) {
  return lattice ? gridOverLattice(lattice) : { width, height, pixelSize, left: 0, top: height * pixelSize };
}

/** Pixels that cover a lattice and are as wide as its spacing. @param {Lattice} lattice @returns {Grid} */
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
 * Interpolates values of a lattice linearly along and between rows.
 * @param {Lattice} lattice
 * @param {ArrayLike<number>} values
 * @param {{ stride: number, part: number }} [layout] numbers for each vertex, and which of them is interpolated
 * @returns {(x: number, y: number) => number} the value at a place; NaN outside and beside NaN
 */
export function interpolatorOf({ rows, cols, spacing, origin = [0, 0] }, values, { stride, part } = { stride: 1, part: 0 }) {
  /** @param {number} row @param {number} x in spacings, from the even rows' first vertex */
  const along = (row, x) => {
    const place = clampToRange(x + 0.5 * (row % 2), cols);
    const col = Math.floor(place);
    const from = stride * (row * cols + col) + part;
    return interpolate(values[from], values[from + stride], place - col);
  };
  return (x, y) => {
    const [across, down] = [(x - origin[0]) / spacing, clampToRange((origin[1] - y) / (spacing * ROW_SPACING_RATIO), rows)];
    const row = Math.floor(down);
    if (Number.isNaN(row)) return NaN;
    return down === row ? along(row, across) : interpolate(along(row, across), along(row + 1, across), down - row);
  };
}

/** Interpolates values of a lattice at the pixels of a grid. @param {Lattice} lattice @param {ArrayLike<number>} values @param {Grid} grid */
export function interpolateToGrid(lattice, values, { width, height, pixelSize, left, top }) {
  const at = interpolatorOf(lattice, values);
  return Float64Array.from({ length: width * height }, (_, i) => at(left + (i % width + 0.5) * pixelSize, top - (Math.floor(i / width) + 0.5) * pixelSize));
}

/** An index clamped to the range of `count` items; NaN if it is farther outside than pixels of the border reach. @param {number} place @param {number} count */
function clampToRange(place, count) {
  const inside = Math.min(count - 1, Math.max(0, place));
  return Math.abs(place - inside) < 0.6 ? inside : NaN;
}

/** A neighbour without weight need not be there. @param {number} a @param {number} b @param {number} share */
function interpolate(a, b, share) {
  if (share < 1e-9) return a;
  return share > 1 - 1e-9 ? b : a * (1 - share) + b * share;
}

/** The index of the vertex nearest to a place; -1 if it is more than a spacing away. @param {Lattice} lattice @param {number} x @param {number} y */
export function nearestVertex({ rows, cols, spacing, origin = [0, 0] }, x, y) {
  const down = (origin[1] - y) / (spacing * ROW_SPACING_RATIO);
  const row = Math.min(rows - 1, Math.max(0, Math.round(down)));
  const across = (x - origin[0]) / spacing + 0.5 * (row % 2);
  const col = Math.min(cols - 1, Math.max(0, Math.round(across)));
  return Math.abs(down - row) <= 1 && Math.abs(across - col) <= 1 ? row * cols + col : -1;
}
