/**
 * The outline of a page, or of the two pages of an open book, in pixels of its photo, (0, 0) being the centre of the
 * upper left one.
 *
 * Four edges go through nodes: the upper and the lower one from left to right, the left and the right one from top to
 * bottom. Corners are nodes of two edges; those between two pages are the ends of the gutter.
 */
import { through } from './curve.js';

/** @typedef {[x: number, y: number]} Point */
/**
 * @typedef {object} Node
 * @property {number} x
 * @property {number} y
 * @property {Point} home where it was put, near which it is drawn to what the photo shows
 * @property {boolean} corner
 * @property {boolean} held whether it was put where it is, and is not to be moved by what the photo shows
 */
/** @typedef {0 | 1 | 2 | 3} Edge the upper, lower, left and right one */
/** @typedef {{ edge: Edge, node: number }} Which */
/** @typedef {[Node[], Node[], Node[], Node[]]} Edges corners are shared by two of them */
/** @typedef {Pick<import('../../pkg/types.js').PageOutline, 'edges'>} FoundEdges */

/** Names of the edges. */
export const EDGE_NAMES = /** @type {const} */ (['upper', 'lower', 'left', 'right']);
/** All edges, by their numbers. */
export const EDGES = /** @type {const} */ ([0, 1, 2, 3]);
/** Nodes between two corners, at first, and of an edge that bends more often. */
const [BETWEEN, MAX_BETWEEN] = [3, 7];
/** Largest distance of a curve through nodes from the edge that was found, as a share of its chord. */
const MAX_NODE_CURVE_OFFSET = 0.012;

export class Outline {
  /** @type {Edges} */
  edges;
  /** Exact courses of the edges, as they were found in the photo; none once an edge is changed by hand. @type {(Point[] | null)[]} */
  found = [null, null, null, null];

  /** @param {Edges} edges corners are shared here */
  constructor([upper, lower, left, right]) {
    const side = (/** @type {Node[]} */ nodes, /** @type {number} */ end) => [
      /** @type {Node} */ (upper.at(end)), ...nodes.filter(({ corner }) => !corner), /** @type {Node} */ (lower.at(end))];
    this.edges = [upper, lower, side(left, 0), side(right, -1)];
  }

  /**
   * The quadrilateral of four corners.
   * @param {readonly Point[]} corners upper left, upper right, lower right, lower left
   */
  static between([ul, ur, lr, ll]) {
    return new Outline([straight(ul, ur), straight(ll, lr), straight(ul, ll), straight(ur, lr)]);
  }

  /**
   * Where nothing better is known.
   * @param {{ width: number, height: number }} photo
   */
  static within({ width, height }) {
    /** @type {(x: number, y: number) => Point} */
    const at = (x, y) => [x * (width - 1), y * (height - 1)];
    return Outline.between([at(0.15, 0.15), at(0.85, 0.15), at(0.85, 0.85), at(0.15, 0.85)]);
  }

  /** An outline that was found, with nodes along its edges. @param {FoundEdges} page */
  static from({ edges: { top, bottom, left, right } }) {
    const lines = [top, bottom, left, right];
    const made = new Outline(/** @type {Edges} */ (lines.map(nodesAlong)));
    made.found = lines;
    return made;
  }

  copy() {
    /** @type {Map<Node, Node>} */
    const copies = new Map();
    const made = new Outline(/** @type {Edges} */ (this.edges.map((nodes) => nodes.map((node) => {
      const copy = copies.get(node) ?? { ...node };
      copies.set(node, copy);
      return copy;
    }))));
    made.found = [...this.found];
    return made;
  }

  get pages() {
    return this.edges[0].filter(({ corner }) => corner).length - 1;
  }

  /** The four corners of the whole: upper left, upper right, lower right, lower left. */
  get corners() {
    const [upper, lower] = this.edges;
    return [upper[0], upper[upper.length - 1], lower[lower.length - 1], lower[0]];
  }

  /**
   * The nodes of each page's part of an edge, corners included.
   * @param {Edge} edge
   */
  spans(edge) {
    const nodes = this.edges[edge];
    const ends = nodes.flatMap(({ corner }, i) => (corner ? [i] : []));
    return ends.slice(1).map((end, k) => nodes.slice(ends[k], end + 1));
  }

  /** The two ends of an open book's gutter. @returns {[Node, Node] | null} */
  gutter() {
    if (this.pages < 2) return null;
    const [upper, lower] = this.edges.map((nodes) => nodes.slice(1, -1).find(({ corner }) => corner));
    return upper && lower ? [upper, lower] : null;
  }

  /** The two pages as one. */
  joined() {
    const copy = this.copy();
    for (const nodes of copy.edges.slice(0, 2)) nodes.forEach((node, i) => (node.corner = i === 0 || i === nodes.length - 1));
    return copy;
  }

  /**
   * Two pages in the place of one.
   * @param {readonly [Point, Point]} gutter its ends on both edges
   */
  divided(gutter) {
    const { edges, found } = this.copy();
    const [upper, lower] = edges.slice(0, 2).map((nodes, edge) => {
      const [first, last] = [nodes[0], nodes[nodes.length - 1]];
      const [from, to] = [first, last].map(({ x, y }) => /** @type {Point} */ ([x, y]));
      // As bent as they were.
      const curve = through(nodes.map(({ x, y }) => [x, y]), 40);
      const between = [...straight(from, gutter[edge], 2), ...straight(gutter[edge], to, 2).slice(1)].slice(1, -1).map((node) =>
        (node.corner ? node : nodeAt(nearestAcross(curve, node, from, to), false)));
      return [first, ...between, last];
    });
    const made = new Outline([upper, lower, edges[2], edges[3]]);
    made.found = [null, null, found[2], found[3]];
    return made;
  }

  /**
   * Moves a node; of a corner, what is free of its edges goes along.
   * @param {Which} which
   * @param {Point} to
   */
  move(which, [x, y]) {
    const moved = this.at(which);
    const before = { x: moved.x, y: moved.y };
    Object.assign(moved, { x, y, home: [x, y] });
    for (const edge of EDGES) {
      if (!this.edges[edge].includes(moved)) continue;
      this.found[edge] = null;
      if (moved.corner) for (const nodes of this.spans(edge)) follow(nodes, moved, before);
    }
  }

  /**
   * A further node at its place along the edge.
   * @param {Edge} edge
   * @param {Point} place
   * @returns {Which}
   */
  add(edge, [x, y]) {
    const nodes = this.edges[edge];
    const axis = direction(nodes);
    const along = (/** @type {{ x: number, y: number }} */ node) => axis[0] * node.x + axis[1] * node.y;
    const found = nodes.findIndex((node) => along(node) > along({ x, y }));
    const node = found <= 0 ? (found === 0 ? 1 : nodes.length - 1) : found;
    nodes.splice(node, 0, nodeAt([x, y], false));
    this.found[edge] = null;
    return { edge, node };
  }

  /**
   * Takes a node away that is no corner.
   * @param {Which} which
   */
  remove({ edge, node }) {
    if (this.edges[edge][node]?.corner !== false) return;
    this.edges[edge].splice(node, 1);
    this.found[edge] = null;
  }

  /** @param {Which} which */
  at({ edge, node }) {
    return this.edges[edge][node];
  }

  /**
   * What a node is called.
   * @param {Which} which
   */
  name({ edge, node }) {
    const nodes = this.edges[edge];
    if (!nodes[node].corner) return `Point ${node} of the ${EDGE_NAMES[edge]} edge`;
    if (node > 0 && node < nodes.length - 1) return `${capital(EDGE_NAMES[edge])} end of the gutter`;
    return `${capital(EDGE_NAMES[edge])} ${node === 0 ? 'left' : 'right'} corner`;
  }
}

/** @param {Point} place @param {boolean} corner @returns {Node} */
export function nodeAt([x, y], corner) {
  return { x, y, home: [x, y], corner, held: false };
}

/**
 * @param {Point} from
 * @param {Point} to
 * @param {number} [between]
 * @returns {Node[]}
 */
function straight(from, to, between = BETWEEN) {
  return Array.from({ length: between + 2 }, (_, i) => {
    const t = i / (between + 1);
    return nodeAt([from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])], i === 0 || i === between + 1);
  });
}

/**
 * Nodes along an edge that was found: few, or more where it bends often.
 * @param {Point[]} line
 * @returns {Node[]}
 */
function nodesAlong(line) {
  const nodes = evenly(line, BETWEEN);
  const [from, to] = [line[0], line[line.length - 1]];
  const curve = through(nodes.map(({ x, y }) => [x, y]), 200);
  const far = MAX_NODE_CURVE_OFFSET * Math.hypot(to[0] - from[0], to[1] - from[1]);
  const follows = line.every(([x, y]) => curve.some(([u, v]) => Math.hypot(u - x, v - y) < far));
  return follows ? nodes : evenly(line, MAX_BETWEEN);
}

/** @param {Point[]} line @param {number} between */
function evenly(line, between) {
  return Array.from({ length: between + 2 }, (_, k) =>
    nodeAt(line[Math.round((k / (between + 1)) * (line.length - 1))], k === 0 || k === between + 1));
}

/**
 * Moves the free nodes of an edge with one of its ends, by the similarity that keeps the other one.
 * @param {readonly Node[]} nodes
 * @param {Node} moved
 * @param {{ x: number, y: number }} before where that end was
 */
function follow(nodes, moved, before) {
  const [first, last] = [nodes[0], nodes[nodes.length - 1]];
  if (first !== moved && last !== moved) return;
  const fixed = first === moved ? last : first;
  // As a complex factor.
  const [ax, ay, bx, by] = [before.x - fixed.x, before.y - fixed.y, moved.x - fixed.x, moved.y - fixed.y];
  const square = ax * ax + ay * ay;
  if (square === 0) return;
  const [re, im] = [(bx * ax + by * ay) / square, (by * ax - bx * ay) / square];
  for (const node of nodes.slice(1, -1)) {
    if (node.held) continue;
    const [dx, dy] = [node.x - fixed.x, node.y - fixed.y];
    [node.x, node.y] = [fixed.x + re * dx - im * dy, fixed.y + im * dx + re * dy];
    node.home = [node.x, node.y];
  }
}

/** @param {readonly Node[]} nodes */
function direction(nodes) {
  const [from, to] = [nodes[0], nodes[nodes.length - 1]];
  return [to.x - from.x, to.y - from.y];
}

/**
 * The place of a curve that is as far along a chord as another place.
 * @param {readonly Point[]} curve
 * @param {{ x: number, y: number }} place
 * @param {Point} from
 * @param {Point} to
 */
function nearestAcross(curve, place, from, to) {
  const along = (/** @type {number} */ x, /** @type {number} */ y) => (to[0] - from[0]) * x + (to[1] - from[1]) * y;
  const wanted = along(place.x, place.y);
  const off = (/** @type {Point} */ [x, y]) => Math.abs(along(x, y) - wanted);
  return curve.reduce((best, point) => (off(point) < off(best) ? point : best));
}

/** @param {string} word */
function capital(word) {
  return word[0].toUpperCase() + word.slice(1);
}
