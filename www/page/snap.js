/**
 * Edges drawn to the strongest gradient beside them.
 *
 * Along the normals of a line the brightness is looked at, and of all courses within reach the one is taken, by dynamic
 * programming, whose gradients are large and of one sign and which turns little.
 */
import { normals, through } from './curve.js';
import { brightness, rescaled } from './grey.js';
import { EDGES } from './outline.js';
import { robust } from './polynomial.js';

/** @import {Grey} from './grey.js' */
/** @import {Edge, Node, Outline, Point} from './outline.js' */

/** Places along a line that are looked at, less one. */
const PLACES = 48;
/** How far an edge is looked for on both sides, as a share of the photo's diagonal. */
const REACH = 0.014;
/** Pixels on both sides whose mean is compared: of a printed line less is left than of the page's edge. */
const SIDE = 4;
/** Grey levels that an edge at the end of that reach has to have more than one on the line itself. */
const FARTHEST = 20;
/** Grey levels below which a gradient is none. */
const FAINT = 8;
/** Of a course, what one step aside costs against a gradient of that many grey levels. */
const STIFF = 2;
/** Grey levels at which a gradient counts half of the most: what is dark all along counts more than what is black here and there. */
const ENOUGH = 40;

/**
 * @typedef {object} Trace
 * @property {Point[]} points where the edge is seen, its two ends included
 * @property {number} seen share of the places that show an edge
 */

/**
 * The edge beside a line through nodes; its ends stay.
 * @param {Grey} grey
 * @param {readonly Node[]} nodes
 * @param {{ places?: number, reach?: number }} [how] places along it that are looked at, less one, and how far beside it
 * @returns {Trace}
 */
export function traced(grey, nodes, { places = PLACES, reach = reachOf(grey) } = {}) {
  const line = through(nodes.map(({ x, y }) => [rescaled(x, grey.scale), rescaled(y, grey.scale)]), places);
  // What is held is not left, and what is beside it only little.
  const holds = nodes.flatMap(({ x, y, held, corner }) => (held || corner ? [[rescaled(x, grey.scale), rescaled(y, grey.scale)]] : []));
  const room = line.map(([x, y]) => Math.min(reach, ...holds.map(([u, v]) => 0.5 * Math.hypot(x - u, y - v))));
  const { offsets, seen } = course(grey, line, room);
  const across = normals(line);
  /** @type {Point[]} */
  const points = [];
  line.forEach(([x, y], i) => {
    const end = i === 0 || i === line.length - 1;
    if (!end && !seen[i]) return;
    const by = end ? 0 : offsets[i];
    points.push([rescaled(x + by * across[i][0], 1 / grey.scale), rescaled(y + by * across[i][1], 1 / grey.scale)]);
  });
  return { points, seen: seen.filter(Boolean).length / seen.length };
}

/** @param {Grey} grey */
function reachOf({ width, height }) {
  return Math.max(4, REACH * Math.hypot(width, height));
}

/**
 * @param {Grey} grey
 * @param {readonly Point[]} line
 * @param {readonly number[]} room how far to look at each place
 * @returns {{ offsets: number[], seen: boolean[] }}
 */
function course(grey, line, room) {
  const across = normals(line);
  const most = Math.ceil(Math.max(...room));
  const count = 2 * most + 1;
  const slopes = line.map(([x, y], i) => {
    const [nx, ny] = across[i];
    // Averaged along the line, so that what is written beside it counts less.
    const profile = Float64Array.from({ length: count + 2 * SIDE }, (_, k) => {
      const offset = k - most - SIDE;
      if (Math.abs(offset) > room[i] + SIDE + 1) return 0;
      let sum = 0;
      for (let t = -2; t <= 2; t++) sum += brightness(grey, x + offset * nx + t * ny, y + offset * ny - t * nx);
      return sum / 5;
    });
    return Float64Array.from({ length: count }, (_, k) => {
      if (Math.abs(k - most) > room[i] + 1) return 0;
      let sum = 0;
      for (let d = 1; d <= SIDE; d++) sum += profile[k + SIDE + d] - profile[k + SIDE - d];
      return sum / SIDE;
    });
  });
  const [rising, falling] = [1, -1].map((sign) => best(slopes, room, most, sign));
  const { sign, path } = rising.score >= falling.score ? rising : falling;
  const peaks = path.map((k, i) => sharpest(slopes[i], k, sign));
  const offsets = peaks.map((k, i) => k - most + vertex(slopes[i], k));
  return { offsets, seen: peaks.map((k, i) => sign * slopes[i][k] >= FAINT) };
}

/**
 * The course with the largest sum of gradients of one sign, less what its turns cost.
 * @param {readonly Float64Array[]} slopes
 * @param {readonly number[]} room
 * @param {number} most
 * @param {number} sign
 */
function best(slopes, room, most, sign) {
  const count = 2 * most + 1;
  let scores = new Float64Array(count);
  /** @type {Int16Array[]} */
  const from = [];
  slopes.forEach((slope, i) => {
    const next = new Float64Array(count);
    const back = new Int16Array(count);
    for (let k = 0; k < count; k++) {
      if (Math.abs(k - most) > room[i] + 0.5) {
        next[k] = -Infinity;
        continue;
      }
      let [score, previous] = [-Infinity, k];
      for (let step = -3; step <= 3; step++) {
        const j = k + step;
        if (j < 0 || j >= count) continue;
        const one = scores[j] - STIFF * step * step;
        if (one > score) [score, previous] = [one, j];
      }
      next[k] = score + worth(sign * slope[k]) - FARTHEST * ((k - most) / (most + 1)) ** 2;
      back[k] = previous;
    }
    scores = next;
    from.push(back);
  });
  const path = new Array(slopes.length).fill(0);
  path[slopes.length - 1] = scores.indexOf(Math.max(...scores));
  for (let i = slopes.length - 1; i > 0; i--) path[i - 1] = from[i][path[i]];
  return { score: Math.max(...scores), path, sign };
}

/** What a gradient counts. @param {number} slope */
function worth(slope) {
  return slope > 0 ? (2 * ENOUGH * slope) / (slope + ENOUGH) : 0;
}

/**
 * The place of the largest gradient next to a course.
 * @param {Float64Array} slope
 * @param {number} k
 * @param {number} sign
 */
function sharpest(slope, k, sign) {
  let best = k;
  for (let j = Math.max(0, k - 2); j <= Math.min(slope.length - 1, k + 2); j++) {
    if (sign * slope[j] > sign * slope[best]) best = j;
  }
  return best;
}

/** Where the parabola through a value and its neighbours has its vertex. @param {Float64Array} values @param {number} k */
function vertex(values, k) {
  if (k < 1 || k > values.length - 2) return 0;
  const [a, b, c] = [values[k - 1], values[k], values[k + 1]];
  const bend = a - 2 * b + c;
  return bend === 0 ? 0 : Math.min(0.5, Math.max(-0.5, (0.5 * (a - c)) / bend));
}

/** The edges that meet at each corner, and at which of their ends. @type {readonly (readonly [Edge, Edge, number, number])[]} */
const MEETINGS = [[0, 2, 0, 0], [0, 3, -1, 0], [1, 2, 0, -1], [1, 3, -1, -1]];

/**
 * Moves what is not held to the edges that the photo shows: corners to where two of them meet. Edges that were found stay.
 * @param {Grey} grey
 * @param {Outline} outline is changed
 */
export function settle(grey, outline) {
  const reach = 1.5 * reachOf(grey) / grey.scale;
  const changed = EDGES.filter((edge) => !outline.found[edge]);
  const kept = new Set(EDGES.filter((edge) => outline.found[edge]).flatMap((edge) => outline.edges[edge]));
  const free = changed.flatMap((edge) => outline.edges[edge]).filter((node) => !node.held && !kept.has(node));
  for (const node of free) [node.x, node.y] = node.home;
  /** @param {Node} node @param {Point} to */
  const draw = (node, to) => {
    if (Math.hypot(to[0] - node.home[0], to[1] - node.home[1]) < reach) [node.x, node.y] = to;
  };
  // Of moved corners others follow.
  for (let pass = 0; pass < 2; pass++) {
    /** The courses without their ends, which are what is looked for. */
    const traces = EDGES.map((edge) => (changed.includes(edge) ? outline.spans(edge).map((nodes) => loose(grey, nodes)) : []));
    for (const [edge, side, end, sideEnd] of MEETINGS) {
      const corner = /** @type {Node} */ (outline.edges[edge].at(end));
      const [one, other] = [traces[edge].at(end), traces[side][0]];
      if (!free.includes(corner) || !one || !other || one.seen < 0.5 || other.seen < 0.5) continue;
      const [p, q] = [end === 0 ? one.points : one.points.toReversed(), sideEnd === 0 ? other.points : other.points.toReversed()];
      const met = meeting(p, q);
      if (met) draw(corner, met);
    }
    for (const edge of changed) {
      for (const nodes of outline.spans(edge)) {
        const { points, seen } = traced(grey, nodes);
        if (seen < 0.3) continue;
        for (const node of nodes) {
          if (node.corner || node.held) continue;
          draw(node, nearest(points, node));
        }
      }
    }
  }
}

/**
 * The edge beside a line, where its ends do not hold it.
 * @param {Grey} grey
 * @param {readonly Node[]} nodes
 */
function loose(grey, nodes) {
  return traced(grey, nodes.map((node) => ({ ...node, corner: false, held: node.held && !node.corner })));
}

/**
 * Where two courses meet that begin near each other, by a parabola through the first part of each.
 * @param {readonly Point[]} one
 * @param {readonly Point[]} other
 * @returns {Point | null}
 */
function meeting(one, other) {
  // The ends themselves are not where an edge was seen.
  const [p, q] = [one, other].map((points) => points.slice(2, 2 + Math.max(8, points.length >> 3)));
  if (p.length < 5 || q.length < 5) return null;
  // Along the first course, and across it.
  const [ax, ay] = [p[p.length - 1][0] - p[0][0], p[p.length - 1][1] - p[0][1]];
  const length = Math.hypot(ax, ay);
  const [ux, uy] = [ax / length, ay / length];
  /** @param {Point} point */
  const local = ([x, y]) => [(x - p[0][0]) * ux + (y - p[0][1]) * uy, (y - p[0][1]) * ux - (x - p[0][0]) * uy];
  const bent = robust(p.map(local), 2);
  const line = robust(q.map(local).map(([s, t]) => [t, s]), 1);
  let [s, t] = [0, 0];
  for (let i = 0; i < 20; i++) {
    t = bent(s);
    s = line(t);
  }
  if (!Number.isFinite(s) || Math.abs(line(bent(s)) - s) > 0.01 * length) return null;
  return [p[0][0] + s * ux - t * uy, p[0][1] + s * uy + t * ux];
}

/**
 * @param {readonly Point[]} points
 * @param {{ x: number, y: number }} place
 */
function nearest(points, { x, y }) {
  return points.reduce((best, point) =>
    (Math.hypot(point[0] - x, point[1] - y) < Math.hypot(best[0] - x, best[1] - y) ? point : best));
}
