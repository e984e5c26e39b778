/** Values at the vertices of a hexagonal lattice, as images of the page. */

/** @import {Input} from '../session.js' */

/**
 * @typedef {object} Lattice row 0 at the top, odd rows half a spacing to the left
 * @property {number} rows
 * @property {number} cols
 * @property {number} spacing
 * @property {readonly [number, number]} [origin] of vertex (0, 0), y up
 */

/**
 * @typedef {object} Grid where the pixels of an image lie on the same plane
 * @property {number} width
 * @property {number} height
 * @property {number} pixelSize
 * @property {number} left
 * @property {number} top
 */

const ROW = Math.sqrt(3) / 2;

/**
 * Where an input's pixels lie.
 * @param {Pick<Input, 'width' | 'height' | 'pixelSize' | 'lattice'>} input
 * @returns {Grid}
 */
export function gridOf({ width, height, pixelSize, lattice }) {
  return lattice ? gridOver(lattice) : { width, height, pixelSize, left: 0, top: height * pixelSize };
}

/**
 * Pixels as wide as the lattice's spacing, over all of it.
 * @param {Lattice} lattice
 * @returns {Grid}
 */
export function gridOver({ rows, cols, spacing, origin = [0, 0] }) {
  return {
    width: cols + 1,
    height: Math.max(1, Math.round((rows - 1) * ROW) + 1),
    pixelSize: spacing,
    // Vertices of even rows lie at pixels' centres, and so does the top row.
    left: origin[0] - 1.5 * spacing,
    top: origin[1] + 0.5 * spacing,
  };
}

/**
 * Linear along the rows of the lattice and between them; NaN outside and beside NaN.
 * @param {Lattice} lattice
 * @param {ArrayLike<number>} values
 * @param {Grid} grid
 */
export function interpolated({ rows, cols, spacing, origin = [0, 0] }, values, { width, height, pixelSize, left, top }) {
  const out = new Float64Array(width * height).fill(NaN);
  /** @param {number} row @param {number} x in spacings, from the even rows' first vertex */
  const along = (row, x) => {
    const place = x + 0.5 * (row % 2);
    const col = Math.floor(place);
    const share = place - col;
    const from = row * cols + col;
    // A neighbour without weight need not be there.
    if (share < 1e-9) return col >= 0 && col < cols ? values[from] : NaN;
    if (share > 1 - 1e-9) return col >= -1 && col + 1 < cols ? values[from + 1] : NaN;
    return col >= 0 && col + 1 < cols ? values[from] * (1 - share) + values[from + 1] * share : NaN;
  };
  for (let i = 0, pixel = 0; i < height; i++) {
    const down = (origin[1] - top + (i + 0.5) * pixelSize) / (spacing * ROW);
    const row = Math.min(rows - 1, Math.max(0, Math.floor(down)));
    const share = down - row;
    // Half a row beyond the first and the last one counts as them: pixels reach as far.
    const single = share < 1e-9 ? row : share > 1 - 1e-9 && row + 1 < rows ? row + 1 : row + 1 >= rows ? row : -1;
    const outside = share < -0.6 || (row + 1 >= rows && share > 0.6);
    for (let k = 0; k < width; k++, pixel++) {
      if (outside) continue;
      const x = (left + (k + 0.5) * pixelSize - origin[0]) / spacing;
      out[pixel] = single >= 0 ? along(single, x) : along(row, x) * (1 - share) + along(row + 1, x) * share;
    }
  }
  return out;
}

/**
 * The number of the vertex nearest to each pixel, -1 where that is more than a spacing away.
 * @param {Lattice} lattice
 * @param {Grid} grid
 */
export function nearest({ rows, cols, spacing, origin = [0, 0] }, { width, height, pixelSize, left, top }) {
  const out = new Int32Array(width * height).fill(-1);
  for (let i = 0, pixel = 0; i < height; i++) {
    const down = (origin[1] - top + (i + 0.5) * pixelSize) / (spacing * ROW);
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
