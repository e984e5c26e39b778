/** Warp maps as the command writes them. */

/**
 * The places of all pixels, from those at the points of a grid.
 * @param {{ width: number, height: number, columns: number, rows: number, step: number[], places: ([number, number] | null)[] }} file
 */
export function expanded({ width, height, columns, rows, step, places }) {
  const map = new Float32Array(2 * width * height).fill(NaN);
  for (let i = 0; i < width * height; i += 1) {
    const [x, y] = [(i % width) / step[0], Math.floor(i / width) / step[1]];
    const [col, row] = [Math.min(Math.floor(x), columns - 2), Math.min(Math.floor(y), rows - 2)];
    const first = row * columns + col;
    const corners = [first, first + 1, first + columns, first + columns + 1].map((node) => places[node]);
    const [fx, fy] = [x - col, y - row];
    const weights = [(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy];
    for (const k of [0, 1]) {
      map[2 * i + k] = weights.reduce((sum, weight, j) => (weight < 1e-9 ? sum : sum + weight * (corners[j]?.[k] ?? NaN)), 0);
    }
  }
  return map;
}

/** The places in an NPY file of shape (height, width, 2). @param {Buffer} file */
export function readNpyMap(file) {
  const [, height, width] = /\((\d+), (\d+), 2\)/.exec(file.toString('latin1', 0, 128)) ?? [];
  const start = file.length - 8 * Number(height) * Number(width);
  const map = new Float32Array(file.buffer.slice(file.byteOffset + start, file.byteOffset + file.length));
  return { width: Number(width), height: Number(height), map };
}
