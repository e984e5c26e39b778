/** Finds the gutter of an open book, at the kinks of its upper and lower edge. */

/** @import {Point} from './outline.js' */

/** Bounds of the gutter's position along an edge, as shares of its points. */
const [MIN_GUTTER_POSITION, MAX_GUTTER_POSITION] = [0.3, 0.7];
/** Minimum angle by which an edge turns at a kink, in radians. */
const MIN_KINK_ANGLE_RADIANS = 0.15;
/** Length of the edge on either side of a kink by which its angle is measured, as a share of the edge's points. */
const KINK_ARM_SHARE = 0.07;

/**
 * The ends of the gutter on the upper and the lower edge: the kink of each edge, or its midpoint if it has none.
 * @param {readonly [upper: Point[], lower: Point[]]} edges around both pages, from left to right
 * @returns {[Point, Point]}
 */
export const findGutter = ([upper, lower]) => [findKink(upper) ?? midpoint(upper), findKink(lower) ?? midpoint(lower)];

/** The midpoint between the ends of an edge. @param {Point[]} line @returns {Point} */
function midpoint(line) {
  const [[x, y], [u, v]] = [line[0], line[line.length - 1]];
  return [(x + u) / 2, (y + v) / 2];
}

/** The point at which an edge turns most, or null if it turns nowhere sharply. @param {Point[]} line @returns {Point | null} */
function findKink(line) {
  const arm = Math.max(1, Math.round(KINK_ARM_SHARE * line.length));
  let [largest, kink] = [MIN_KINK_ANGLE_RADIANS, /** @type {Point | null} */ (null)];
  for (let i = Math.ceil(MIN_GUTTER_POSITION * line.length); i < MAX_GUTTER_POSITION * line.length; i++) {
    const [[ax, ay], [x, y], [bx, by]] = [line[i - arm] ?? line[0], line[i], line[i + arm] ?? line[line.length - 1]];
    const [ux, uy, vx, vy] = [x - ax, y - ay, bx - x, by - y];
    const turn = Math.abs(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy));
    if (turn > largest) [largest, kink] = [turn, line[i]];
  }
  return kink;
}
