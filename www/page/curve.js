/** Smooth curves through a few points. */

/** @typedef {import('./outline.js').Point} Point */

/**
 * Places along a natural cubic spline through points, whose parameter is the length of its chords.
 * @param {readonly Point[]} points at least two
 * @param {number} steps how many places are wanted, less one
 * @returns {Point[]} evenly spaced in the parameter, both ends included
 */
export function through(points, steps) {
  const distinct = points.filter(([x, y], i) => i === 0 || x !== points[i - 1][0] || y !== points[i - 1][1]);
  const lengths = [0];
  for (let i = 1; i < distinct.length; i++) {
    lengths.push(lengths[i - 1] + Math.hypot(distinct[i][0] - distinct[i - 1][0], distinct[i][1] - distinct[i - 1][1]));
  }
  const curves = [0, 1].map((axis) => spline(lengths, distinct.map((point) => point[axis])));
  const end = lengths[lengths.length - 1];
  return Array.from({ length: steps + 1 }, (_, i) => /** @type {Point} */ (curves.map((curve) => curve((i / steps) * end))));
}

/**
 * @param {readonly number[]} at ascending
 * @param {readonly number[]} values
 * @returns {(t: number) => number}
 */
function spline(at, values) {
  const n = at.length;
  if (n < 2) return () => values[0];
  // Second derivatives, by elimination in the tridiagonal system.
  const [second, factor] = [new Float64Array(n), new Float64Array(n)];
  for (let i = 1; i < n - 1; i++) {
    const [before, after] = [at[i] - at[i - 1], at[i + 1] - at[i]];
    const pivot = 2 * (before + after) - before * factor[i - 1];
    const jump = (values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before;
    factor[i] = after / pivot;
    second[i] = (6 * jump - before * second[i - 1]) / pivot;
  }
  for (let i = n - 2; i > 0; i--) second[i] -= factor[i] * second[i + 1];
  return (t) => {
    let i = 0;
    while (i < n - 2 && t > at[i + 1]) i++;
    const step = at[i + 1] - at[i];
    const b = (t - at[i]) / step;
    const a = 1 - b;
    return a * values[i] + b * values[i + 1] + ((a ** 3 - a) * second[i] + (b ** 3 - b) * second[i + 1]) * (step * step) / 6;
  };
}

/**
 * Unit normals of a polyline, a quarter turn clockwise from its course as y points down.
 * @param {readonly Point[]} line
 * @returns {Point[]}
 */
export function normals(line) {
  return line.map((_, i) => {
    const [p, q] = [line[Math.max(0, i - 1)], line[Math.min(line.length - 1, i + 1)]];
    const [x, y] = [q[0] - p[0], q[1] - p[1]];
    const length = Math.hypot(x, y) || 1;
    return [-y / length, x / length];
  });
}
