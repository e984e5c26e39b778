/** Guesses of metadata that a file of heights lacks: its lattice, and the size of a solve. */

/** @typedef {{ width: number, height: number, data: Float64Array }} HeightValues */

/** Maximum number of vertices of a solve that takes less than a few minutes. */
const MAX_QUICK_VERTICES = 1.2e6;

/**
 * Whether the values are probably those of a hexagonal lattice, whose odd rows lie half a spacing to the left: then the
 * mean of the four vertices above and below predicts a height better than the mean of two pixels in the same column.
 * @param {HeightValues} values
 */
export function isHexagonal({ width, height, data }) {
  let [square, left, right] = [0, 0, 0];
  for (let row = 1; row < height - 1; row++) {
    const shift = row % 2 === 1 ? -1 : 1;
    for (let i = row * width + 1; i < (row + 1) * width - 1; i++) {
      const straight = data[i - width] + data[i + width];
      const one = data[i] - (straight + data[i - width + shift] + data[i + width + shift]) / 4;
      const other = data[i] - (straight + data[i - width - shift] + data[i + width - shift]) / 4;
      if (!Number.isFinite(one + other)) continue;
      square += (data[i] - straight / 2) ** 2;
      left += one ** 2;
      right += other ** 2;
    }
  }
  return left < 0.6 * square && right > 1.5 * square;
}

/**
 * The lattice spacing in pixels that keeps the solve of a large image short.
 * @param {Pick<HeightValues, 'width' | 'height'>} size
 */
export function coarseningFor({ width, height }) {
  return [1, 2, 4].find((step) => width * height <= MAX_QUICK_VERTICES * step * step) ?? 4;
}
