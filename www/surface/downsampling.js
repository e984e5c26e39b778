/** Reduces height images. */

/** @typedef {{ width: number, height: number, data: ArrayLike<number>, pixelSize?: number }} Heights row by row, NaN for no data; pixels are 1 wide unless said otherwise */

/** The mean of the values in each block of pixels; NaN for a block without data. @param {Heights} image @param {number} maxBlocks maximum number of blocks along the longer side */
export function downsample({ width, height, data, pixelSize = 1 }, maxBlocks) {
  const share = Math.min(1, maxBlocks / Math.max(width, height));
  const [cols, rows] = [Math.max(3, Math.round(width * share)), Math.max(3, Math.round(height * share))];
  const sums = new Float64Array(cols * rows);
  const counts = new Uint32Array(cols * rows);
  const colOf = Int32Array.from({ length: width }, (_, x) => Math.floor((x * cols) / width));
  for (let y = 0, i = 0; y < height; y++) {
    const from = Math.floor((y * rows) / height) * cols;
    for (let x = 0; x < width; x++, i++) {
      const value = data[i];
      if (value !== value) continue;
      sums[from + colOf[x]] += value;
      counts[from + colOf[x]]++;
    }
  }
  for (let i = 0; i < sums.length; i++) sums[i] /= counts[i];
  return { width: cols, height: rows, data: sums, pixelSize: (pixelSize * width) / cols };
}
