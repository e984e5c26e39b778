/** Finds the gutter of an open book, at the kinks of its upper and lower edge. */
import { fitPolynomial } from './polynomial.js';
import { traceEdge } from './edge-snapping.js';

/** @import {GreyImage} from './grey.js' */
/** @import {Node, Outline, Point} from './outline.js' */

/** Number of intervals between the sampled places of an edge. */
const EDGE_INTERVALS = 128;
/** Bounds of the gutter's position along an edge, as shares of the edge's chord. */
const [MIN_GUTTER_POSITION, MAX_GUTTER_POSITION] = [0.3, 0.7];
/** Minimum angle of a kink between the lines on its two sides, in radians. */
const MIN_KINK_ANGLE_RADIANS = 0.15;
/** Number of samples on either side of a kink to which a line is fitted. */
const FIT_POINTS = 9;
/** Minimum visible share of an edge whose kink is looked for. */
const MIN_VISIBLE_SHARE = 0.8;

/**
 * The ends of the gutter on the upper and the lower edge: the kink of each edge, or its midpoint if no kink is found.
 * @param {Outline} outline around both pages
 * @param {GreyImage | null} grey the photo in which kinks are looked for; null for midpoints
 * @returns {[Point, Point]}
 */
export function findGutter(outline, grey) {
  return /** @type {[Point, Point]} */ (outline.edges.slice(0, 2).map((nodes) => (grey && findKink(grey, nodes)) ?? midpoint(nodes)));
}

/** The midpoint between the ends of an edge. @param {readonly Node[]} nodes @returns {Point} */
function midpoint(nodes) {
  const [from, to] = [nodes[0], nodes[nodes.length - 1]];
  return [(from.x + to.x) / 2, (from.y + to.y) / 2];
}

/**
 * The sharpest kink of an edge, or null if there is none.
 * @param {GreyImage} grey
 * @param {readonly Node[]} nodes
 * @returns {Point | null}
 */
function findKink(grey, nodes) {
  const { points, visibleShare } = traceEdge(grey, nodes, { intervals: EDGE_INTERVALS });
  if (visibleShare < MIN_VISIBLE_SHARE) return null;
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
  const fitted = fitPolynomial(points, 1);
  return { slope: fitted(1) - fitted(0), level: fitted(0) };
}
