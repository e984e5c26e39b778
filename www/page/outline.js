/**
 * The outline of a page, or of the two pages of an open book, in pixels of its photo; (0, 0) is the centre of the upper left
 * pixel.
 *
 * Four edges pass through nodes: the upper and the lower one from left to right, the left and the right one from top to
 * bottom. Two edges share each corner. The corners between two pages are the ends of the gutter.
 */
import { splineThrough } from './spline.js';

/** @typedef {[x: number, y: number]} Point */
/**
 * @typedef {object} Node
 * @property {number} x
 * @property {number} y
 * @property {Point} home where the node was put; snapping moves it only near this place
 * @property {boolean} corner
 * @property {boolean} pinned whether snapping leaves the node where it is
 */
/** @typedef {0 | 1 | 2 | 3} Edge index of the upper, lower, left or right edge */
/** @typedef {{ edge: Edge, node: number }} NodeIndex */
/** @typedef {[Node[], Node[], Node[], Node[]]} Edges nodes of the four edges; two edges share each corner */
/** @typedef {Pick<import('../../pkg/types.js').PageOutline, 'edges'>} DetectedEdges */

/** Names of the edges. */
export const EDGE_NAMES = /** @type {const} */ (['upper', 'lower', 'left', 'right']);
/** Indices of all edges. */
export const EDGES = /** @type {const} */ ([0, 1, 2, 3]);
/** Number of nodes between two corners of a new outline. */
const INNER_NODES = 3;
/** Number of nodes between two corners of a detected edge that {@link INNER_NODES} do not follow. */
const MAX_INNER_NODES = 7;
/** Maximum distance of the curve through the nodes from a detected edge, in chords of the edge. */
const MAX_NODE_CURVE_OFFSET_CHORDS = 0.012;

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

  /**
   * The quadrilateral of four corners.
   * @param {readonly Point[]} corners upper left, upper right, lower right, lower left
   */
  static fromCorners([ul, ur, lr, ll]) {
    return new Outline([straightNodes(ul, ur), straightNodes(ll, lr), straightNodes(ul, ll), straightNodes(ur, lr)]);
  }

  /**
   * The default outline for a photo without a detected page: a rectangle in its middle.
   * @param {{ width: number, height: number }} photo
   */
  static defaultFor({ width, height }) {
    /** @type {(x: number, y: number) => Point} */
    const at = (x, y) => [x * (width - 1), y * (height - 1)];
    return Outline.fromCorners([at(0.15, 0.15), at(0.85, 0.15), at(0.85, 0.85), at(0.15, 0.85)]);
  }

  /** The outline of a detected page. @param {DetectedEdges} page */
  static fromDetected({ edges: { top, bottom, left, right } }) {
    const lines = [top, bottom, left, right];
    const outline = new Outline(/** @type {Edges} */ (lines.map(nodesAlong)));
    outline.detectedEdges = lines;
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

  /** A deep copy. */
  copy() {
    return Outline.copyOf(this);
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

  /**
   * The nodes of each page along an edge, corners included.
   * @param {Edge} edge
   */
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

  /** A copy whose two pages are joined into one. */
  withoutGutter() {
    const copy = this.copy();
    for (const nodes of copy.edges.slice(0, 2)) nodes.forEach((node, i) => (node.corner = i === 0 || i === nodes.length - 1));
    return copy;
  }

  /**
   * A copy whose page is divided into two.
   * @param {readonly [Point, Point]} gutter its ends on the upper and the lower edge
   */
  withGutter(gutter) {
    const { edges, detectedEdges } = this.copy();
    const [upper, lower] = edges.slice(0, 2).map((nodes, edge) => {
      const [first, last] = [nodes[0], nodes[nodes.length - 1]];
      const [from, to] = [first, last].map(({ x, y }) => /** @type {Point} */ ([x, y]));
      // The nodes lie on the earlier curve, so that the edge keeps its shape.
      const curve = splineThrough(nodes.map(({ x, y }) => [x, y]), 40);
      const between = [...straightNodes(from, gutter[edge], 2), ...straightNodes(gutter[edge], to, 2).slice(1)].slice(1, -1).map((node) =>
        (node.corner ? node : nodeAt(pointAlongChord(curve, node, from, to), false)));
      return [first, ...between, last];
    });
    const outline = new Outline([upper, lower, edges[2], edges[3]]);
    outline.detectedEdges = [null, null, detectedEdges[2], detectedEdges[3]];
    return outline;
  }

  /**
   * Moves a node. The inner nodes of the edges at a corner move with it unless they are pinned.
   * @param {NodeIndex} index
   * @param {Point} to
   */
  move(index, [x, y]) {
    const moved = this.nodeOf(index);
    const before = { x: moved.x, y: moved.y };
    Object.assign(moved, { x, y, home: [x, y] });
    for (const edge of EDGES) {
      if (!this.edges[edge].includes(moved)) continue;
      this.detectedEdges[edge] = null;
      if (moved.corner) for (const nodes of this.spans(edge)) transformInnerNodes(nodes, moved, before);
    }
  }

  /**
   * Adds a node to an edge.
   * @param {Edge} edge
   * @param {Point} place
   * @returns {NodeIndex}
   */
  add(edge, [x, y]) {
    const nodes = this.edges[edge];
    const axis = chordOf(nodes);
    const along = (/** @type {{ x: number, y: number }} */ node) => axis[0] * node.x + axis[1] * node.y;
    const found = nodes.findIndex((node) => along(node) > along({ x, y }));
    const node = found <= 0 ? (found === 0 ? 1 : nodes.length - 1) : found;
    nodes.splice(node, 0, nodeAt([x, y], false));
    this.detectedEdges[edge] = null;
    return { edge, node };
  }

  /**
   * Removes a node that is not a corner.
   * @param {NodeIndex} which
   */
  remove({ edge, node }) {
    if (this.edges[edge][node]?.corner !== false) return;
    this.edges[edge].splice(node, 1);
    this.detectedEdges[edge] = null;
  }

  /** The node with an index. @param {NodeIndex} which */
  nodeOf({ edge, node }) {
    return this.edges[edge][node];
  }

  /**
   * The name of a node for screen readers.
   * @param {NodeIndex} which
   */
  name({ edge, node }) {
    const nodes = this.edges[edge];
    if (!nodes[node].corner) return `Point ${node} of the ${EDGE_NAMES[edge]} edge`;
    if (node > 0 && node < nodes.length - 1) return `${capitalise(EDGE_NAMES[edge])} end of the gutter`;
    return `${capitalise(EDGE_NAMES[edge])} ${node === 0 ? 'left' : 'right'} corner`;
  }
}

/** A node that was not moved yet. @param {Point} place @param {boolean} corner @returns {Node} */
export function nodeAt([x, y], corner) {
  return { x, y, home: [x, y], corner, pinned: false };
}

/**
 * The nodes of a straight edge between two corners.
 * @param {Point} from
 * @param {Point} to
 * @param {number} [innerNodes] number of nodes between them
 * @returns {Node[]}
 */
function straightNodes(from, to, innerNodes = INNER_NODES) {
  return Array.from({ length: innerNodes + 2 }, (_, i) => {
    const t = i / (innerNodes + 1);
    return nodeAt([from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])], i === 0 || i === innerNodes + 1);
  });
}

/**
 * Nodes along a detected edge: few, or more if a curve through few does not follow the edge.
 * @param {Point[]} line
 * @returns {Node[]}
 */
function nodesAlong(line) {
  const nodes = evenNodes(line, INNER_NODES);
  const [from, to] = [line[0], line[line.length - 1]];
  const curve = splineThrough(nodes.map(({ x, y }) => [x, y]), 200);
  const tolerance = MAX_NODE_CURVE_OFFSET_CHORDS * Math.hypot(to[0] - from[0], to[1] - from[1]);
  const follows = line.every(([x, y]) => curve.some(([u, v]) => Math.hypot(u - x, v - y) < tolerance));
  return follows ? nodes : evenNodes(line, MAX_INNER_NODES);
}

/** Nodes at evenly spaced points of a line. @param {Point[]} line @param {number} innerNodes */
function evenNodes(line, innerNodes) {
  return Array.from({ length: innerNodes + 2 }, (_, k) =>
    nodeAt(line[Math.round((k / (innerNodes + 1)) * (line.length - 1))], k === 0 || k === innerNodes + 1));
}

/**
 * Moves the inner nodes of an edge with one of its ends, by the similarity transform that fixes the other end.
 * @param {readonly Node[]} nodes
 * @param {Node} moved the end that was moved
 * @param {{ x: number, y: number }} before its place before
 */
function transformInnerNodes(nodes, moved, before) {
  const [first, last] = [nodes[0], nodes[nodes.length - 1]];
  if (first !== moved && last !== moved) return;
  const fixed = first === moved ? last : first;
  // The similarity transform as a complex factor.
  const [ax, ay, bx, by] = [before.x - fixed.x, before.y - fixed.y, moved.x - fixed.x, moved.y - fixed.y];
  const square = ax * ax + ay * ay;
  if (square === 0) return;
  const [re, im] = [(bx * ax + by * ay) / square, (by * ax - bx * ay) / square];
  for (const node of nodes.slice(1, -1)) {
    if (node.pinned) continue;
    const [dx, dy] = [node.x - fixed.x, node.y - fixed.y];
    [node.x, node.y] = [fixed.x + re * dx - im * dy, fixed.y + im * dx + re * dy];
    node.home = [node.x, node.y];
  }
}

/** The vector from the first node to the last. @param {readonly Node[]} nodes */
function chordOf(nodes) {
  const [from, to] = [nodes[0], nodes[nodes.length - 1]];
  return [to.x - from.x, to.y - from.y];
}

/**
 * The point of a curve whose projection onto a chord is that of a place.
 * @param {readonly Point[]} curve
 * @param {{ x: number, y: number }} place
 * @param {Point} from
 * @param {Point} to
 */
function pointAlongChord(curve, place, from, to) {
  const along = (/** @type {number} */ x, /** @type {number} */ y) => (to[0] - from[0]) * x + (to[1] - from[1]) * y;
  const wanted = along(place.x, place.y);
  const off = (/** @type {Point} */ [x, y]) => Math.abs(along(x, y) - wanted);
  return curve.reduce((best, point) => (off(point) < off(best) ? point : best));
}

/** The word with a capital first letter. @param {string} word */
function capitalise(word) {
  return word[0].toUpperCase() + word.slice(1);
}
