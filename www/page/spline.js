/** Natural cubic splines through points. */

/** @typedef {import('./outline.js').Point} Point */

/**
 * Points along the natural cubic spline through points, parametrised by the length of the chords.
 * @param {readonly Point[]} points at least two
 * @param {number} steps number of intervals between the returned points
 * @returns {Point[]} `steps + 1` points, evenly spaced in the parameter, both ends included
 */
export function splineThrough(points, steps) {
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
 * The natural cubic spline through values as a function of the parameter.
 * @param {readonly number[]} parameters ascending
 * @param {readonly number[]} values
 * @returns {(t: number) => number}
 */
function spline(parameters, values) {
  const n = parameters.length;
  if (n < 2) return () => values[0];
  // Second derivatives at the knots, by elimination in the tridiagonal system.
  const [second, factor] = [new Float64Array(n), new Float64Array(n)];
  for (let i = 1; i < n - 1; i++) {
    const [before, after] = [parameters[i] - parameters[i - 1], parameters[i + 1] - parameters[i]];
    const pivot = 2 * (before + after) - before * factor[i - 1];
    const jump = (values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before;
    factor[i] = after / pivot;
    second[i] = (6 * jump - before * second[i - 1]) / pivot;
  }
  for (let i = n - 2; i > 0; i--) second[i] -= factor[i] * second[i + 1];
  return (t) => {
    let i = 0;
    while (i < n - 2 && t > parameters[i + 1]) i++;
    const step = parameters[i + 1] - parameters[i];
    const b = (t - parameters[i]) / step;
    const a = 1 - b;
    return a * values[i] + b * values[i + 1] + ((a ** 3 - a) * second[i] + (b ** 3 - b) * second[i + 1]) * (step * step) / 6;
  };
}
