/**
 * The outline of a page, or of the two pages of an open book, in pixels of its photo, (0, 0) being the centre of the
 * upper left one.
 *
 * Two edges are bent: the upper and the lower one, from left to right, or the left and the right one, from top to
 * bottom. Each goes through nodes, of which corners part one page from the next.
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
/** @typedef {{ edge: 0 | 1, node: number }} Which */

/** Nodes between two corners, for a start. */
const BETWEEN = 3;

export class Outline {
  /** Whether the left and the right edge are the bent ones. */
  sideways = false;
  /** @type {[Node[], Node[]]} */
  edges;

  /** @param {[Node[], Node[]]} edges */
  constructor(edges) {
    this.edges = edges;
  }

  /**
   * @param {readonly [Point, Point]} first corners of an edge
   * @param {readonly [Point, Point]} second those of the other
   */
  static between(first, second) {
    return new Outline([straight(...first), straight(...second)]);
  }

  /**
   * Where nothing better is known.
   * @param {{ width: number, height: number }} photo
   */
  static within({ width, height }) {
    /** @type {(x: number, y: number) => Point} */
    const at = (x, y) => [x * (width - 1), y * (height - 1)];
    return Outline.between([at(0.15, 0.15), at(0.85, 0.15)], [at(0.15, 0.85), at(0.85, 0.85)]);
  }

  /** What another one was made of. @param {Pick<Outline, 'edges' | 'sideways'>} parts */
  static of({ edges: [first, second], sideways }) {
    const made = new Outline([first.map((node) => ({ ...node })), second.map((node) => ({ ...node }))]);
    made.sideways = sideways;
    return made;
  }

  copy() {
    return Outline.of(this);
  }

  get pages() {
    return this.edges[0].filter(({ corner }) => corner).length - 1;
  }

  /**
   * The nodes of each page's part of an edge, corners included.
   * @param {0 | 1} edge
   */
  spans(edge) {
    const nodes = this.edges[edge];
    const ends = nodes.flatMap(({ corner }, i) => (corner ? [i] : []));
    return ends.slice(1).map((end, k) => nodes.slice(ends[k], end + 1));
  }

  /** The straight edges, each from a corner of the first bent edge to one of the second; at a gutter, too. */
  sides() {
    const [first, second] = this.edges.map((nodes) => nodes.filter(({ corner }) => corner));
    return first.map((node, i) => /** @type {[Node, Node]} */ ([node, second[i]]));
  }

  /** The other two edges are the bent ones. */
  turned() {
    const [[a, b], [c, d]] = this.edges.map((nodes) => [nodes[0], nodes[nodes.length - 1]].map(({ x, y }) => /** @type {Point} */ ([x, y])));
    const turned = Outline.between([a, c], [b, d]);
    turned.sideways = !this.sideways;
    return turned;
  }

  /** The two pages as one. */
  joined() {
    const copy = this.copy();
    for (const nodes of copy.edges) nodes.forEach((node, i) => (node.corner = i === 0 || i === nodes.length - 1));
    return copy;
  }

  /**
   * Two pages in the place of one.
   * @param {readonly [Point, Point]} gutter its ends on both edges
   */
  divided(gutter) {
    const copy = this.copy();
    copy.edges = /** @type {[Node[], Node[]]} */ (copy.edges.map((nodes, edge) => {
      const [from, to] = [nodes[0], nodes[nodes.length - 1]].map(({ x, y }) => /** @type {Point} */ ([x, y]));
      // As bent as they were.
      const curve = through(nodes.map(({ x, y }) => [x, y]), 40);
      return [...straight(from, gutter[edge], 2), ...straight(gutter[edge], to, 2).slice(1)].map((node) =>
        (node.corner ? node : nodeAt(nearestAcross(curve, node, from, to), false)));
    }));
    return copy;
  }

  /**
   * Moves a node; of a corner, what is free of its parts goes along.
   * @param {Which} which
   * @param {Point} to
   */
  move(which, [x, y]) {
    const moved = this.at(which);
    const before = { x: moved.x, y: moved.y };
    Object.assign(moved, { x, y, home: [x, y] });
    if (!moved.corner) return;
    for (const nodes of this.spans(which.edge)) {
      const [first, last] = [nodes[0], nodes[nodes.length - 1]];
      if (first !== moved && last !== moved) continue;
      const fixed = first === moved ? last : first;
      // The similarity that keeps the other corner, as a complex factor.
      const [ax, ay, bx, by] = [before.x - fixed.x, before.y - fixed.y, x - fixed.x, y - fixed.y];
      const square = ax * ax + ay * ay;
      if (square === 0) continue;
      const [re, im] = [(bx * ax + by * ay) / square, (by * ax - bx * ay) / square];
      for (const node of nodes.slice(1, -1)) {
        if (node.held) continue;
        const [dx, dy] = [node.x - fixed.x, node.y - fixed.y];
        [node.x, node.y] = [fixed.x + re * dx - im * dy, fixed.y + im * dx + re * dy];
        node.home = [node.x, node.y];
      }
    }
  }

  /**
   * A further node at its place along the edge.
   * @param {0 | 1} edge
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
    return { edge, node };
  }

  /**
   * Takes a node away that is no corner.
   * @param {Which} which
   */
  remove({ edge, node }) {
    if (!this.edges[edge][node]?.corner) this.edges[edge].splice(node, 1);
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
    const [one, other] = this.sideways ? ['left', 'right'] : ['upper', 'lower'];
    const side = edge === 0 ? one : other;
    const nodes = this.edges[edge];
    if (!nodes[node].corner) return `Point ${node} of the ${side} edge`;
    const ends = this.sideways ? ['upper', 'lower'] : ['left', 'right'];
    if (node > 0 && node < nodes.length - 1) return `${capital(side)} end of the gutter`;
    const end = ends[node === 0 ? 0 : 1];
    return this.sideways ? `${capital(end)} ${side} corner` : `${capital(side)} ${end} corner`;
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
