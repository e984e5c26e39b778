/** Polynomials by least squares. */

/**
 * The polynomial t(s) that fits points [s, t] best.
 * @param {number[][]} points
 * @param {number} degree
 * @returns {(s: number) => number}
 */
export function polynomial(points, degree) {
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

/**
 * The same without the worst fifth of the points.
 * @param {number[][]} points
 * @param {number} degree
 * @returns {(s: number) => number}
 */
export function robust(points, degree) {
  const first = polynomial(points, degree);
  const off = (/** @type {number[]} */ [s, t]) => Math.abs(first(s) - t);
  const kept = points.toSorted((a, b) => off(a) - off(b)).slice(0, Math.max(degree + 2, Math.ceil(0.8 * points.length)));
  return polynomial(kept, degree);
}
