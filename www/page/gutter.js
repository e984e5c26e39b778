/** Where an open book's gutter is: at the kink of its edges. */
import { polynomial } from './polynomial.js';
import { traced } from './snap.js';

/** @import {Grey} from './grey.js' */
/** @import {Node, Outline, Point} from './outline.js' */

/** Places along an edge that are looked at. */
const PLACES = 128;
/** The part of an edge that the gutter may be in. */
const [FROM, TO] = [0.3, 0.7];
/** Angle between both sides, in radians, that is a kink. */
const SHARP = 0.15;
/** Places on either side by which it is found. */
const SIDE = 9;

/**
 * The kinks of both bent edges, or else their middles.
 * @param {Outline} outline of one page, which both are taken for
 * @param {Grey | null} grey none where nothing is to be looked for
 * @returns {[Point, Point]}
 */
export function gutterOf(outline, grey) {
  return /** @type {[Point, Point]} */ (outline.edges.slice(0, 2).map((nodes) => (grey && kink(grey, nodes)) ?? middle(nodes)));
}

/** @param {readonly Node[]} nodes @returns {Point} */
function middle(nodes) {
  const [from, to] = [nodes[0], nodes[nodes.length - 1]];
  return [(from.x + to.x) / 2, (from.y + to.y) / 2];
}

/**
 * @param {Grey} grey
 * @param {readonly Node[]} nodes
 * @returns {Point | null}
 */
function kink(grey, nodes) {
  const { points, seen } = traced(grey, nodes, { places: PLACES });
  if (seen < 0.8) return null;
  // Along the chord, and across it.
  const [from, to] = [points[0], points[points.length - 1]];
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const [ux, uy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
  const local = points.map(([x, y]) => [(x - from[0]) * ux + (y - from[1]) * uy, (y - from[1]) * ux - (x - from[0]) * uy]);
  let best = { turn: SHARP, s: NaN, t: NaN };
  for (let i = SIDE + 1; i < local.length - SIDE - 1; i++) {
    if (local[i][0] < FROM * length || local[i][0] > TO * length) continue;
    // What is nearest to it may be rounded.
    const [left, right] = [line(local.slice(i - SIDE, i - 1)), line(local.slice(i + 2, i + SIDE + 1))];
    const turn = Math.abs(Math.atan(right.slope) - Math.atan(left.slope));
    const s = (left.level - right.level) / (right.slope - left.slope);
    if (turn > best.turn && Math.abs(s - local[i][0]) < (2 * length) / PLACES) best = { turn, s, t: left.level + left.slope * s };
  }
  const { s, t } = best;
  return Number.isNaN(s) ? null : [from[0] + s * ux - t * uy, from[1] + s * uy + t * ux];
}

/** The line through points that fits best. @param {number[][]} points */
function line(points) {
  const at = polynomial(points, 1);
  return { slope: at(1) - at(0), level: at(0) };
}
