/** Meshes for measurements and tests. */

/**
 * Two triangles for each square of a grid.
 * @param {number} cols
 * @param {number} rows
 * @param {(col: number, row: number) => [number, number, number]} place
 */
export function gridMesh(cols, rows, place) {
  const positions = Float64Array.from(Array.from({ length: cols * rows }, (_, i) => place(i % cols, Math.floor(i / cols))).flat());
  const triangles = Array.from({ length: (cols - 1) * (rows - 1) }, (_, i) => {
    const a = Math.floor(i / (cols - 1)) * cols + (i % (cols - 1));
    return [a, a + 1, a + cols, a + 1, a + cols + 1, a + cols];
  });
  return { positions, triangles: Uint32Array.from(triangles.flat()) };
}
