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
    width: cols,
    height: Math.max(1, Math.round((rows - 1) * ROW) + 1),
    pixelSize: spacing,
    // Vertices of even rows lie at pixels' centres, and so does the top row.
    left: origin[0] - 0.5 * spacing,
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
    const place = within(x + 0.5 * (row % 2), cols);
    const col = Math.floor(place);
    const from = row * cols + col;
    return between(values[from], values[from + 1], place - col);
  };
  for (let i = 0, pixel = 0; i < height; i++) {
    const down = within((origin[1] - top + (i + 0.5) * pixelSize) / (spacing * ROW), rows);
    const row = Math.floor(down);
    for (let k = 0; k < width; k++, pixel++) {
      if (Number.isNaN(down)) continue;
      const x = (left + (k + 0.5) * pixelSize - origin[0]) / spacing;
      out[pixel] = down === row ? along(row, x) : between(along(row, x), along(row + 1, x), down - row);
    }
  }
  return out;
}

/**
 * A place among so many, NaN outside; a bit beyond the ends, as far as pixels reach, counts as them.
 * @param {number} place
 * @param {number} count
 */
function within(place, count) {
  const inside = Math.min(count - 1, Math.max(0, place));
  return Math.abs(place - inside) < 0.6 ? inside : NaN;
}

/**
 * A neighbour without weight need not be there.
 * @param {number} a
 * @param {number} b
 * @param {number} share
 */
function between(a, b, share) {
  if (share < 1e-9) return a;
  return share > 1 - 1e-9 ? b : a * (1 - share) + b * share;
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
