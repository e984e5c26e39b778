/** Finds the gutter of an open book, at the kinks of its upper and lower edge. */

/** @import {Point} from './outline.js' */

/** Number of intervals between the sampled places of an edge. */
const EDGE_INTERVALS = 128;
/** Bounds of the gutter's position along an edge, as shares of the edge's chord. */
const [MIN_GUTTER_POSITION, MAX_GUTTER_POSITION] = [0.3, 0.7];
/** Minimum angle of a kink between the lines on its two sides, in radians. */
const MIN_KINK_ANGLE_RADIANS = 0.15;
/** Number of samples on either side of a kink to which a line is fitted. */
const FIT_POINTS = 9;
/**
 * The ends of the gutter on the upper and the lower edge: the kink of each edge, or its midpoint if it has none.
 * @param {readonly [upper: Point[], lower: Point[]]} edges around both pages, from left to right
 * @returns {[Point, Point]}
 */
export function findGutter([upper, lower]) {
  return [findKink(upper) ?? midpoint(upper), findKink(lower) ?? midpoint(lower)];
}

/** The midpoint between the ends of an edge. @param {Point[]} line @returns {Point} */
function midpoint(line) {
  const [[x, y], [u, v]] = [line[0], line[line.length - 1]];
  return [(x + u) / 2, (y + v) / 2];
}

/** The sharpest kink of an edge, or null if there is none. @param {Point[]} line @returns {Point | null} */
function findKink(line) {
  if (line.length < EDGE_INTERVALS / 2) return null;
  const points = Array.from({ length: EDGE_INTERVALS + 1 }, (_, k) => line[Math.round((k / EDGE_INTERVALS) * (line.length - 1))]);
  // Coordinates along and across the chord.
  const [from, to] = [points[0], points[points.length - 1]];
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const [ux, uy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
  const local = points.map(([x, y]) => [(x - from[0]) * ux + (y - from[1]) * uy, (y - from[1]) * ux - (x - from[0]) * uy]);
  let best = { turn: MIN_KINK_ANGLE_RADIANS, s: NaN, t: NaN };
  for (let i = FIT_POINTS + 1; i < local.length - FIT_POINTS - 1; i++) {
    if (local[i][0] < MIN_GUTTER_POSITION * length || local[i][0] > MAX_GUTTER_POSITION * length) continue;
    // The samples next to the kink are left out: it may be rounded.
    const [left, right] = [fitLine(local.slice(i - FIT_POINTS, i - 1)), fitLine(local.slice(i + 2, i + FIT_POINTS + 1))];
    const turn = Math.abs(Math.atan(right.slope) - Math.atan(left.slope));
    const s = (left.level - right.level) / (right.slope - left.slope);
    if (turn > best.turn && Math.abs(s - local[i][0]) < (2 * length) / EDGE_INTERVALS) best = { turn, s, t: left.level + left.slope * s };
  }
  const { s, t } = best;
  return Number.isNaN(s) ? null : [from[0] + s * ux - t * uy, from[1] + s * uy + t * ux];
}

/** The least-squares line through points. @param {number[][]} points */
function fitLine(points) {
  const [s, t] = [0, 1].map((k) => points.reduce((sum, point) => sum + point[k], 0) / points.length);
  const slope = points.reduce((sum, point) => sum + (point[0] - s) * (point[1] - t), 0) / points.reduce((sum, point) => sum + (point[0] - s) ** 2, 0);
  return { slope, level: t - slope * s };
}
