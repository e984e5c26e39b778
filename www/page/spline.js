/** Smooth curves through points. */

/** @typedef {import('./outline.js').Point} Point */

/**
 * Points along a curve through points: cubic Hermite pieces, parametrised by the length of the chords, whose slope at a point is that of
 * the parabola through it and its neighbours.
 * @param {readonly Point[]} points at least two
 * @param {number} steps number of intervals between the returned points
 * @returns {Point[]} `steps + 1` points, evenly spaced in the parameter, both ends included
 */
export function splineThrough(points, steps) {
  const knots = points.filter(([x, y], i) => i === 0 || x !== points[i - 1][0] || y !== points[i - 1][1]);
  const lengths = knots.slice(1).map(([x, y], i) => Math.hypot(x - knots[i][0], y - knots[i][1]));
  const last = lengths.length - 1;
  if (last < 0) return Array.from({ length: steps + 1 }, () => knots[0]);
  /** @param {number} i @param {number} axis */
  const chord = (i, axis) => (knots[i + 1][axis] - knots[i][axis]) / lengths[i];
  /** @param {number} i @param {number} axis */
  const slope = (i, axis) => {
    if (i === 0 || i > last) return chord(Math.min(i, last), axis);
    return (lengths[i] * chord(i - 1, axis) + lengths[i - 1] * chord(i, axis)) / (lengths[i - 1] + lengths[i]);
  };
  const end = lengths.reduce((sum, length) => sum + length, 0);
  return Array.from({ length: steps + 1 }, (_, step) => {
    let [i, along] = [0, (step / steps) * end];
    while (i < last && along > lengths[i]) along -= lengths[i++];
    const t = along / lengths[i];
    const u = 1 - t;
    return /** @type {Point} */ ([0, 1].map((axis) => u * u * (1 + 2 * t) * knots[i][axis] + t * t * (1 + 2 * u) * knots[i + 1][axis]
      + lengths[i] * t * u * (u * slope(i, axis) - t * slope(i + 1, axis))));
  });
}
