/** Polynomials fitted by least squares. */

/**
 * The polynomial t(s) that fits points [s, t] best, by the normal equations.
 * @param {number[][]} points
 * @param {number} degree
 * @returns {(s: number) => number}
 */
export function fitPolynomial(points, degree) {
  const n = degree + 1;
  const rows = Array.from({ length: n }, (_, i) => [
    ...Array.from({ length: n }, (_, j) => points.reduce((sum, [s]) => sum + s ** (i + j), 0)),
    points.reduce((sum, [s, t]) => sum + t * s ** i, 0),
  ]);
  for (let k = 0; k < n; k++) {
    for (let i = 0; i < n; i++) {
      if (i === k) continue;
      const factor = rows[i][k] / rows[k][k];
      for (let j = k; j <= n; j++) rows[i][j] -= factor * rows[k][j];
    }
  }
  return (s) => rows.reduce((sum, row, i) => sum + (row[n] / row[i]) * s ** i, 0);
}
