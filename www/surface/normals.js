/** Unit normals of a height image. */

/**
 * @typedef {object} Normals
 * @property {number} width
 * @property {number} height
 * @property {Int16Array} xy x and y of each unit normal times {@link NORMAL_SCALE}; x is {@link NO_NORMAL} without data
 */

/** Factor from components of a unit normal to 16-bit integers. */
export const NORMAL_SCALE = 32767;
/** x of a pixel without a normal. */
export const NO_NORMAL = -32768;

/**
 * Computes normals by central differences, one-sided beside a hole or the border. An isolated pixel has a vertical normal.
 * @param {ArrayLike<number>} heights row by row, top row first, NaN for no data
 * @param {number} width
 * @param {number} height
 * @param {number} steepness unit of `heights` over the side of a pixel
 * @returns {Normals}
 */
export function normalsOf(heights, width, height, steepness) {
  const xy = new Int16Array(2 * width * height);
  for (let row = 0, i = 0; row < height; row++) {
    for (let col = 0; col < width; col++, i++) {
      const z = heights[i];
      if (Number.isNaN(z)) {
        xy[2 * i] = NO_NORMAL;
        continue;
      }
      const west = col > 0 ? heights[i - 1] : NaN;
      const east = col + 1 < width ? heights[i + 1] : NaN;
      const south = row + 1 < height ? heights[i + width] : NaN;
      const north = row > 0 ? heights[i - width] : NaN;
      const x = -steepness * difference(west, z, east);
      const y = -steepness * difference(south, z, north);
      const scale = NORMAL_SCALE / Math.sqrt(x * x + y * y + 1);
      xy[2 * i] = Math.round(x * scale);
      xy[2 * i + 1] = Math.round(y * scale);
    }
  }
  return { width, height, xy };
}

/**
 * The central difference; one-sided beside NaN, 0 between two NaN.
 * @param {number} before
 * @param {number} here
 * @param {number} after
 */
function difference(before, here, after) {
  if (Number.isNaN(before)) return Number.isNaN(after) ? 0 : after - here;
  return Number.isNaN(after) ? here - before : (after - before) / 2;
}
