/**
 * Snaps the edges of an outline to the strongest brightness gradient beside them.
 *
 * The brightness is sampled along the normals of a line. Dynamic programming finds the path through the samples whose
 * gradients are large and of one sign, and which turns little.
 */
import { polylineNormals, splineThrough } from './spline.js';
import { brightnessAt, rescalePixel } from './grey.js';
import { EDGES } from './outline.js';
import { fitPolynomialRobustly } from './polynomial.js';

/** @import {GreyImage} from './grey.js' */
/** @import {Edge, Node, Outline, Point} from './outline.js' */

/** Number of intervals between the sampled places of a line. */
const EDGE_INTERVALS = 48;
/** Maximum distance of an edge from its line, on either side, in diagonals of the photo. */
const MAX_EDGE_OFFSET_DIAGONALS = 0.014;
/** Width of the two windows whose mean brightness is compared, in pixels: wide enough that a printed line counts less than the page's edge. */
const GRADIENT_WINDOW_PIXELS = 4;
/** Penalty of an edge at the maximum distance, in grey levels; it falls with the square of the distance. */
const MAX_OFFSET_PENALTY_GREY_LEVELS = 20;
/** Minimum gradient of a visible edge, in grey levels. */
const MIN_GRADIENT_GREY_LEVELS = 8;
/** Penalty of a path that shifts by one pixel between two samples, in grey levels; it grows with the square of the shift. */
const STEP_PENALTY_GREY_LEVELS = 2;
/** Gradient with half of the maximum score, in grey levels. Scores saturate, so that a faint edge all along beats scattered strong ones. */
const HALF_SCORE_GRADIENT_GREY_LEVELS = 40;
/** Minimum visible share of both edges at a corner that is moved to their intersection. */
const MIN_CORNER_VISIBLE_SHARE = 0.5;
/** Minimum visible share of an edge whose inner nodes are moved onto it. */
const MIN_NODE_VISIBLE_SHARE = 0.3;

/**
 * @typedef {object} Trace
 * @property {Point[]} points of the edge where it is visible, and its two ends
 * @property {number} visibleShare share of the samples that show an edge
 */

/**
 * Traces the edge beside a line through nodes. The ends of the line stay where they are.
 * @param {GreyImage} grey
 * @param {readonly Node[]} nodes
 * @param {{ intervals?: number, maxOffset?: number }} [how] number of intervals between samples; maximum distance of the edge from the line, in pixels of `grey`
 * @returns {Trace}
 */
export function traceEdge(grey, nodes, { intervals = EDGE_INTERVALS, maxOffset = maxOffsetOf(grey) } = {}) {
  const line = splineThrough(nodes.map(({ x, y }) => [rescalePixel(x, grey.scale), rescalePixel(y, grey.scale)]), intervals);
  // The edge passes through pinned nodes and corners, so it may leave the line only little beside them.
  const fixedPoints = nodes.flatMap(({ x, y, pinned, corner }) => (pinned || corner ? [[rescalePixel(x, grey.scale), rescalePixel(y, grey.scale)]] : []));
  const maxOffsets = line.map(([x, y]) => Math.min(maxOffset, ...fixedPoints.map(([u, v]) => 0.5 * Math.hypot(x - u, y - v))));
  const { offsets, visible } = bestOffsets(grey, line, maxOffsets);
  const lineNormals = polylineNormals(line);
  /** @type {Point[]} */
  const points = [];
  line.forEach(([x, y], i) => {
    const end = i === 0 || i === line.length - 1;
    if (!end && !visible[i]) return;
    const by = end ? 0 : offsets[i];
    points.push([rescalePixel(x + by * lineNormals[i][0], 1 / grey.scale), rescalePixel(y + by * lineNormals[i][1], 1 / grey.scale)]);
  });
  return { points, visibleShare: visible.filter(Boolean).length / visible.length };
}

/** The default maximum distance of an edge from its line, in pixels. @param {GreyImage} grey */
function maxOffsetOf({ width, height }) {
  return Math.max(4, MAX_EDGE_OFFSET_DIAGONALS * Math.hypot(width, height));
}

/**
 * The signed distance of the edge from each sample of a line along its normal, in pixels, and whether the edge is visible there.
 * @param {GreyImage} grey
 * @param {readonly Point[]} line
 * @param {readonly number[]} maxOffsets maximum distance at each sample
 * @returns {{ offsets: number[], visible: boolean[] }}
 */
function bestOffsets(grey, line, maxOffsets) {
  const lineNormals = polylineNormals(line);
  const centre = Math.ceil(Math.max(...maxOffsets));
  const count = 2 * centre + 1;
  const gradients = line.map(([x, y], i) => {
    const [nx, ny] = lineNormals[i];
    // The mean over five pixels along the line: letters beside it count less.
    const profile = Float64Array.from({ length: count + 2 * GRADIENT_WINDOW_PIXELS }, (_, k) => {
      const offset = k - centre - GRADIENT_WINDOW_PIXELS;
      if (Math.abs(offset) > maxOffsets[i] + GRADIENT_WINDOW_PIXELS + 1) return 0;
      let sum = 0;
      for (let t = -2; t <= 2; t++) sum += brightnessAt(grey, x + offset * nx + t * ny, y + offset * ny - t * nx);
      return sum / 5;
    });
    return Float64Array.from({ length: count }, (_, k) => {
      if (Math.abs(k - centre) > maxOffsets[i] + 1) return 0;
      let sum = 0;
      for (let d = 1; d <= GRADIENT_WINDOW_PIXELS; d++) sum += profile[k + GRADIENT_WINDOW_PIXELS + d] - profile[k + GRADIENT_WINDOW_PIXELS - d];
      return sum / GRADIENT_WINDOW_PIXELS;
    });
  });
  const [rising, falling] = [1, -1].map((sign) => bestPath(gradients, maxOffsets, centre, sign));
  const { sign, path } = rising.score >= falling.score ? rising : falling;
  const peaks = path.map((k, i) => steepestNear(gradients[i], k, sign));
  const offsets = peaks.map((k, i) => k - centre + parabolaVertexOffset(gradients[i], k));
  return { offsets, visible: peaks.map((k, i) => sign * gradients[i][k] >= MIN_GRADIENT_GREY_LEVELS) };
}

/**
 * The path with the largest sum of scores of gradients of one sign, less the penalties of shifts and distances (Viterbi).
 * @param {readonly Float64Array[]} gradients
 * @param {readonly number[]} maxOffsets
 * @param {number} centre index of the line itself among the offsets
 * @param {number} sign 1 where the brightness rises along the normal, −1 where it falls
 */
function bestPath(gradients, maxOffsets, centre, sign) {
  const count = 2 * centre + 1;
  let scores = new Float64Array(count);
  /** @type {Int16Array[]} */
  const from = [];
  gradients.forEach((gradient, i) => {
    const next = new Float64Array(count);
    const back = new Int16Array(count);
    for (let k = 0; k < count; k++) {
      if (Math.abs(k - centre) > maxOffsets[i] + 0.5) {
        next[k] = -Infinity;
        continue;
      }
      let [score, previous] = [-Infinity, k];
      for (let step = -3; step <= 3; step++) {
        const j = k + step;
        if (j < 0 || j >= count) continue;
        const one = scores[j] - STEP_PENALTY_GREY_LEVELS * step * step;
        if (one > score) [score, previous] = [one, j];
      }
      next[k] = score + gradientScore(sign * gradient[k]) - MAX_OFFSET_PENALTY_GREY_LEVELS * ((k - centre) / (centre + 1)) ** 2;
      back[k] = previous;
    }
    scores = next;
    from.push(back);
  });
  const path = new Array(gradients.length).fill(0);
  path[gradients.length - 1] = scores.indexOf(Math.max(...scores));
  for (let i = gradients.length - 1; i > 0; i--) path[i - 1] = from[i][path[i]];
  return { score: Math.max(...scores), path, sign };
}

/** The score of a gradient in grey levels; it saturates. @param {number} gradient */
function gradientScore(gradient) {
  return gradient > 0 ? (2 * HALF_SCORE_GRADIENT_GREY_LEVELS * gradient) / (gradient + HALF_SCORE_GRADIENT_GREY_LEVELS) : 0;
}

/**
 * The index of the largest gradient within two pixels of an index.
 * @param {Float64Array} gradients
 * @param {number} k
 * @param {number} sign
 */
function steepestNear(gradients, k, sign) {
  let best = k;
  for (let j = Math.max(0, k - 2); j <= Math.min(gradients.length - 1, k + 2); j++) {
    if (sign * gradients[j] > sign * gradients[best]) best = j;
  }
  return best;
}

/** The distance from a value to the vertex of the parabola through it and its neighbours, −0.5 to 0.5. @param {Float64Array} values @param {number} k */
function parabolaVertexOffset(values, k) {
  if (k < 1 || k > values.length - 2) return 0;
  const [a, b, c] = [values[k - 1], values[k], values[k + 1]];
  const bend = a - 2 * b + c;
  return bend === 0 ? 0 : Math.min(0.5, Math.max(-0.5, (0.5 * (a - c)) / bend));
}

/** Two edges that meet at each corner, and the index of their end there: 0 for the first node, −1 for the last. @type {readonly (readonly [Edge, Edge, number, number])[]} */
const CORNER_EDGES = [[0, 2, 0, 0], [0, 3, -1, 0], [1, 2, 0, -1], [1, 3, -1, -1]];

/**
 * Moves nodes that are not pinned onto the edges that the photo shows, and corners to the intersections of these. Detected
 * edges stay unchanged.
 * @param {GreyImage} grey
 * @param {Outline} outline is changed
 */
export function snapOutline(grey, outline) {
  const maxShift = 1.5 * maxOffsetOf(grey) / grey.scale;
  const changed = EDGES.filter((edge) => !outline.detectedEdges[edge]);
  const fixed = new Set(EDGES.filter((edge) => outline.detectedEdges[edge]).flatMap((edge) => outline.edges[edge]));
  const free = changed.flatMap((edge) => outline.edges[edge]).filter((node) => !node.pinned && !fixed.has(node));
  for (const node of free) [node.x, node.y] = node.home;
  /** @param {Node} node @param {Point} to */
  const moveNear = (node, to) => {
    if (Math.hypot(to[0] - node.home[0], to[1] - node.home[1]) < maxShift) [node.x, node.y] = to;
  };
  // A moved corner changes the edges at it, so these are traced twice.
  for (let pass = 0; pass < 2; pass++) {
    /** Traces of the changed edges whose ends are free: the corners are what is looked for. */
    const traces = EDGES.map((edge) => (changed.includes(edge) ? outline.spans(edge).map((nodes) => traceFreeEdge(grey, nodes)) : []));
    for (const [edge, side, end, sideEnd] of CORNER_EDGES) {
      const corner = /** @type {Node} */ (outline.edges[edge].at(end));
      const [one, other] = [traces[edge].at(end), traces[side][0]];
      if (!free.includes(corner) || !one || !other || one.visibleShare < MIN_CORNER_VISIBLE_SHARE || other.visibleShare < MIN_CORNER_VISIBLE_SHARE) continue;
      const [p, q] = [end === 0 ? one.points : one.points.toReversed(), sideEnd === 0 ? other.points : other.points.toReversed()];
      const intersection = intersectCurves(p, q);
      if (intersection) moveNear(corner, intersection);
    }
    for (const edge of changed) {
      for (const nodes of outline.spans(edge)) {
        const { points, visibleShare } = traceEdge(grey, nodes);
        if (visibleShare < MIN_NODE_VISIBLE_SHARE) continue;
        for (const node of nodes) {
          if (node.corner || node.pinned) continue;
          moveNear(node, nearestPoint(points, node));
        }
      }
    }
  }
}

/**
 * Traces the edge beside a line whose ends are free.
 * @param {GreyImage} grey
 * @param {readonly Node[]} nodes
 */
function traceFreeEdge(grey, nodes) {
  return traceEdge(grey, nodes.map((node) => ({ ...node, corner: false, pinned: node.pinned && !node.corner })));
}

/**
 * The intersection of two curves that begin near each other: a parabola fits the first part of one, a line that of the other.
 * @param {readonly Point[]} one
 * @param {readonly Point[]} other
 * @returns {Point | null}
 */
function intersectCurves(one, other) {
  // The first points are left out: the ends of a trace are not observed.
  const [p, q] = [one, other].map((points) => points.slice(2, 2 + Math.max(8, points.length >> 3)));
  if (p.length < 5 || q.length < 5) return null;
  // Coordinates along and across the first curve.
  const [ax, ay] = [p[p.length - 1][0] - p[0][0], p[p.length - 1][1] - p[0][1]];
  const length = Math.hypot(ax, ay);
  const [ux, uy] = [ax / length, ay / length];
  /** @param {Point} point */
  const local = ([x, y]) => [(x - p[0][0]) * ux + (y - p[0][1]) * uy, (y - p[0][1]) * ux - (x - p[0][0]) * uy];
  const bent = fitPolynomialRobustly(p.map(local), 2);
  const line = fitPolynomialRobustly(q.map(local).map(([s, t]) => [t, s]), 1);
  let [s, t] = [0, 0];
  for (let i = 0; i < 20; i++) {
    t = bent(s);
    s = line(t);
  }
  if (!Number.isFinite(s) || Math.abs(line(bent(s)) - s) > 0.01 * length) return null;
  return [p[0][0] + s * ux - t * uy, p[0][1] + s * uy + t * ux];
}

/**
 * The point nearest to a place.
 * @param {readonly Point[]} points
 * @param {{ x: number, y: number }} place
 */
function nearestPoint(points, { x, y }) {
  return points.reduce((best, point) =>
    (Math.hypot(point[0] - x, point[1] - y) < Math.hypot(best[0] - x, best[1] - y) ? point : best));
}
