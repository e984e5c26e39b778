/** Rasterises triangles, faster than a canvas draws many of them, and measures them. */

/** @import {Place} from './scene.js' */

/**
 * Visits the pixels whose centres lie in a triangle, for each triangle. A pixel on a common edge is visited for both.
 * @param {{ width: number, height: number }} image
 * @param {ArrayLike<number>} triangles three corners each
 * @param {ArrayLike<number>} places x, y of each corner in pixels, y down, (0, 0) the upper left corner
 * @param {(pixel: number, triangle: number, a: number, b: number, c: number) => void} visit gets the barycentric coordinates a, b, c
 */
export function fillTriangles({ width, height }, triangles, places, visit) {
  for (let t = 0; 3 * t < triangles.length; t++) {
    const [i, j, k] = [2 * triangles[3 * t], 2 * triangles[3 * t + 1], 2 * triangles[3 * t + 2]];
    const [ax, ay, bx, by, cx, cy] = [places[i], places[i + 1], places[j], places[j + 1], places[k], places[k + 1]];
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area === 0) continue;
    const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5));
    const right = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
    const top = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5));
    const bottom = Math.min(height - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
    for (let row = top; row <= bottom; row++) {
      const y = row + 0.5;
      for (let col = left; col <= right; col++) {
        const x = col + 0.5;
        const b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area;
        const c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area;
        // The tolerance prevents gaps between neighbours by rounding.
        if (b > -1e-6 && c > -1e-6 && b + c < 1 + 1e-6) visit(row * width + col, t, 1 - b - c, b, c);
      }
    }
  }
}

/** The bounding box of places, without coordinates that are NaN. @param {ArrayLike<number>} places @param {number} [dimensions] coordinates of each */
export function boxOf(places, dimensions = 3) {
  const ends = Array.from({ length: dimensions }, (_, k) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = k; i < places.length; i += dimensions) {
      if (places[i] < low) low = places[i];
      if (places[i] > high) high = places[i];
    }
    return { low, high };
  });
  return { low: ends.map(({ low }) => low), high: ends.map(({ high }) => high) };
}

/** Height above the lowest vertex up to which a mesh stands on the ground, as a share of its height; and which shares of its box are no foot, and surely one. */
const [FOOT_HEIGHT, MAX_NO_FOOT, MIN_FOOT] = [0.01, 0.25, 0.5];

/** Whether a mesh stands on a foot along one axis, but not along another. @param {ArrayLike<number>} positions @param {0 | 1 | 2} one @param {0 | 1 | 2} other */
export function standsRather(positions, one, other) {
  const { low, high } = boxOf(positions);
  const share = (/** @type {number} */ axis) => {
    const top = low[axis] + FOOT_HEIGHT * (high[axis] - low[axis]);
    const foot = sidesOf(Array.from(positions).filter((_, i) => positions[i - (i % 3) + axis] <= top));
    return foot.reduce((product, side, k) => (k === axis ? product : product * side / (high[k] - low[k])), 1);
  };
  return share(one) > MIN_FOOT && share(other) < MAX_NO_FOOT;
}

/** The sides of the bounding box of places. @param {ArrayLike<number>} places @param {number} [dimensions] */
export function sidesOf(places, dimensions) {
  const { low, high } = boxOf(places, dimensions);
  return high.map((value, k) => value - low[k]);
}

/** A value of vertices at a place between them. @param {{ triangles: Uint32Array }} mesh @param {Pick<Place, 'triangle' | 'shares'>} place @param {(vertex: number) => number} value */
export function interpolateAt({ triangles }, { triangle, shares }, value) {
  return shares.reduce((sum, share, corner) => sum + share * value(triangles[3 * triangle + corner]), 0);
}

/** The edges with a triangle on one side only, in its direction. @param {Uint32Array} triangles @returns {[number, number][]} */
export function borderEdges(triangles) {
  const count = triangles.reduce((most, vertex) => Math.max(most, vertex), 0) + 1;
  /** @type {Map<number, [number, number]>} */
  const single = new Map();
  for (let t = 0; t < triangles.length; t++) {
    const [a, b] = [triangles[t], triangles[t % 3 === 2 ? t - 2 : t + 1]];
    if (!single.delete(b * count + a)) single.set(a * count + b, [a, b]);
  }
  return [...single.values()];
}
