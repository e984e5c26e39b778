/**
 * The outline of a page, or of the two pages of an open book, in pixels of its photo; (0, 0) is the centre of the upper left
 * pixel.
 *
 * Four edges pass through nodes: the upper and the lower one from left to right, the left and the right one from top to
 * bottom. Two edges share each corner. The corners between two pages are the ends of the gutter. Other nodes are set by hand;
 * an edge without them is the detected one, or the library traces it in the photo from corner to corner.
 */
import { capitalised } from '../format.js';

/** @typedef {[x: number, y: number]} Point */
/**
 * @typedef {object} Node
 * @property {number} x
 * @property {number} y
 * @property {boolean} corner
 */
/** @typedef {0 | 1 | 2 | 3} Edge index of the upper, lower, left or right edge */
/** @typedef {{ edge: Edge, node: number }} NodeIndex */
/** @typedef {[Node[], Node[], Node[], Node[]]} Edges nodes of the four edges; two edges share each corner */
/** @typedef {Pick<import('../../pkg/types.js').PageOutline, 'edges'>} DetectedEdges */

/** Names of the edges. */
export const EDGE_NAMES = /** @type {const} */ (['upper', 'lower', 'left', 'right']);
/** Indices of all edges. */
export const EDGES = /** @type {const} */ ([0, 1, 2, 3]);
/** Number of nodes that keep the shape of an edge when another one is added by hand. */
const KEPT_NODES = 3;
/** Number of intervals between the points of a curve through nodes. */
const CURVE_INTERVALS = 40;

export class Outline {
  /** @type {Edges} */
  edges;
  /** The edges as they were detected in the photo; null once an edge is changed by hand. @type {(Point[] | null)[]} */
  detectedEdges = [null, null, null, null];

  /** @param {Edges} edges the corners of the left and right edge are replaced by those of the other two */
  constructor([upper, lower, left, right]) {
    const side = (/** @type {Node[]} */ nodes, /** @type {number} */ end) => [
      /** @type {Node} */ (upper.at(end)), ...nodes.filter(({ corner }) => !corner), /** @type {Node} */ (lower.at(end))];
    this.edges = [upper, lower, side(left, 0), side(right, -1)];
  }

  /** The quadrilateral of four corners. @param {readonly Point[]} corners upper left, upper right, lower right, lower left */
  static fromCorners([ul, ur, lr, ll]) {
    return new Outline(/** @type {Edges} */ ([[ul, ur], [ll, lr], [ul, ll], [ur, lr]].map((ends) => ends.map((place) => nodeAt(place, true)))));
  }

  /** The rectangle in the middle of a photo, `margin` of its size away from each side. @param {{ width: number, height: number }} photo @param {number} [margin] */
  static inside({ width, height }, margin = 0.15) {
    /** @type {(x: number, y: number) => Point} */
    const at = (x, y) => [x * (width - 1), y * (height - 1)];
    const [near, far] = [margin, 1 - margin];
    return Outline.fromCorners([at(near, near), at(far, near), at(far, far), at(near, far)]);
  }

  /** The outline of a detected page. @param {DetectedEdges} page */
  static fromDetected({ edges: { top, bottom, left, right } }) {
    const outline = Outline.fromCorners([top[0], top[top.length - 1], bottom[bottom.length - 1], bottom[0]]);
    outline.detectedEdges = [top, bottom, left, right];
    return outline;
  }

  /** A deep copy of an outline, or of its fields. @param {Pick<Outline, 'edges' | 'detectedEdges'>} fields */
  static copyOf({ edges, detectedEdges }) {
    /** @type {Map<Node, Node>} */
    const copies = new Map();
    const outline = new Outline(/** @type {Edges} */ (edges.map((nodes) => nodes.map((node) => {
      const copy = copies.get(node) ?? { ...node };
      copies.set(node, copy);
      return copy;
    }))));
    outline.detectedEdges = [...detectedEdges];
    return outline;
  }

  /** Number of pages: 1 or 2. */
  get pages() {
    return this.edges[0].filter(({ corner }) => corner).length - 1;
  }

  /** The four outer corners: upper left, upper right, lower right, lower left. */
  get corners() {
    const [upper, lower] = this.edges;
    return [upper[0], upper[upper.length - 1], lower[lower.length - 1], lower[0]];
  }

  /** The nodes of each page along an edge, corners included. @param {Edge} edge */
  spans(edge) {
    const nodes = this.edges[edge];
    const ends = nodes.flatMap(({ corner }, i) => (corner ? [i] : []));
    return ends.slice(1).map((end, k) => nodes.slice(ends[k], end + 1));
  }

  /** The upper and lower end of the gutter; null for one page. @returns {[Node, Node] | null} */
  gutter() {
    if (this.pages < 2) return null;
    const [upper, lower] = this.edges.map((nodes) => nodes.slice(1, -1).find(({ corner }) => corner));
    return upper && lower ? [upper, lower] : null;
  }

  /** The line of each page along an edge: as detected, a curve through the nodes, or the two corners alone. @param {Edge} edge @returns {Point[][]} */
  lines(edge) {
    const detected = this.detectedEdges[edge];
    if (detected) return [detected];
    return this.spans(edge).map((nodes) => {
      const places = nodes.map(({ x, y }) => /** @type {Point} */ ([x, y]));
      return places.length === 2 ? places : splineThrough(places, CURVE_INTERVALS);
    });
  }

  /** A copy whose two pages are joined into one. */
  withoutGutter() {
    const { edges: [upper, lower, left, right] } = Outline.copyOf(this);
    const ends = (/** @type {Node[]} */ nodes) => nodes.filter(({ corner }, i) => !corner || i === 0 || i === nodes.length - 1);
    return new Outline([ends(upper), ends(lower), left, right]);
  }

  /** A copy whose page is divided into two. @param {readonly [Point, Point]} gutter its ends on the upper and the lower edge */
  withGutter(gutter) {
    const copy = Outline.copyOf(this);
    gutter.forEach((place, edge) => {
      const added = copy.add(/** @type {Edge} */ (edge), place);
      copy.nodeOf(added).corner = true;
    });
    return copy;
  }

  /** Moves a node. The lines of its edges are forgotten. @param {NodeIndex} index @param {Point} to */
  move(index, [x, y]) {
    const moved = this.nodeOf(index);
    Object.assign(moved, { x, y });
    for (const edge of EDGES) if (this.edges[edge].includes(moved)) this.detectedEdges[edge] = null;
  }

  /**
   * Adds a node to an edge. An edge that had none gets further ones along its line, so that it keeps its shape.
   * @param {Edge} edge
   * @param {Point} place
   * @param {Point[]} [line] the line of the edge in the photo, if that is known
   * @returns {NodeIndex}
   */
  add(edge, [x, y], line = []) {
    const nodes = this.edges[edge];
    if (nodes.length === 2 && line.length > KEPT_NODES) {
      const places = Array.from({ length: KEPT_NODES }, (_, k) => line[Math.round(((k + 1) / (KEPT_NODES + 1)) * (line.length - 1))]);
      nodes.splice(1, 0, ...places.map((place) => nodeAt(place, false)));
    }
    const [from, to] = [nodes[0], nodes[nodes.length - 1]];
    const along = (/** @type {{ x: number, y: number }} */ node) => (to.x - from.x) * node.x + (to.y - from.y) * node.y;
    const found = nodes.findIndex((node) => along(node) > along({ x, y }));
    const node = found <= 0 ? (found === 0 ? 1 : nodes.length - 1) : found;
    nodes.splice(node, 0, nodeAt([x, y], false));
    this.detectedEdges[edge] = null;
    return { edge, node };
  }

  /** Removes a node that is not a corner. @param {NodeIndex} which */
  remove({ edge, node }) {
    if (this.edges[edge][node]?.corner !== false) return;
    this.edges[edge].splice(node, 1);
    this.detectedEdges[edge] = null;
  }

  /** The node with an index. @param {NodeIndex} which */
  nodeOf({ edge, node }) {
    return this.edges[edge][node];
  }

  /** The name of a node for screen readers. @param {NodeIndex} which */
  name({ edge, node }) {
    const nodes = this.edges[edge];
    if (!nodes[node].corner) return `Point ${node} of the ${EDGE_NAMES[edge]} edge`;
    if (node > 0 && node < nodes.length - 1) return `${capitalised(EDGE_NAMES[edge])} end of the gutter`;
    return `${capitalised(EDGE_NAMES[edge])} ${node === 0 ? 'left' : 'right'} corner`;
  }
}

/** A node at a place. @param {Point} place @param {boolean} corner @returns {Node} */
const nodeAt = ([x, y], corner) => ({ x, y, corner });

/**
 * Points along a curve through points: cubic Hermite pieces, parametrised by the length of the chords, whose slope at a point is that of
 * the parabola through it and its neighbours.
 * @param {readonly Point[]} points at least two
 * @param {number} steps number of intervals between the returned points
 * @returns {Point[]} `steps + 1` points, evenly spaced in the parameter, both ends included
 */
function splineThrough(points, steps) {
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
