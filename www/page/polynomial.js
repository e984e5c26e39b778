/** Polynomials fitted by least squares. */

/** Share of the points that a robust fit keeps. */
const INLIER_SHARE = 0.8;

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

/**
 * The least-squares polynomial after the fifth of the points with the largest residuals was discarded.
 * @param {number[][]} points
 * @param {number} degree
 * @returns {(s: number) => number}
 */
export function fitPolynomialRobustly(points, degree) {
  const first = fitPolynomial(points, degree);
  const residual = (/** @type {number[]} */ [s, t]) => Math.abs(first(s) - t);
  const inliers = points.toSorted((a, b) => residual(a) - residual(b)).slice(0, Math.max(degree + 2, Math.ceil(INLIER_SHARE * points.length)));
  return fitPolynomial(inliers, degree);
}
