/** The outline of a bright page on a darker ground, where there is one beyond doubt. */
import { brightness, reduced, rescaled } from './grey.js';
import { nodeAt, Outline } from './outline.js';
import { settle } from './snap.js';

/** @import {Grey} from './grey.js' */
/** @import {Node, Point} from './outline.js' */

/** Pixels along the longer side of the picture in which pages are looked for. */
const SIZE = 320;
/** Pixels of that picture on both sides of a line that may run across the page. */
const GAP = 2;
/** Grey levels that page and ground differ by at least, on the mean, and what else may be a page and its ground. */
const [CONTRAST, FAINT] = [40, 25];
/** Share of the photo that a page takes at least, and that of the photo's rim that it takes at most. */
const [LEAST, RIM] = [0.1, 0.02];
/** How far a straight edge may be from its chord, as a share of that, and still be called straight. */
const STRAIGHT = 0.02;
/** How far beyond its corners a straight edge is followed, and a bent one by its tangent, in lengths of it. */
const [BEYOND, TANGENT] = [1.6, 0.15];
/** Over what share of its length an edge has to go on there for its corner to be none. */
const RUN = 0.12;
/** By what factor paper may be brighter in some places along its border than in others. */
const UNEVEN = 1.7;

/**
 * @param {Grey} grey
 * @returns {Outline | null}
 */
export function suggested(grey) {
  const small = reduced(grey, Math.max(1, Math.floor(Math.max(grey.width, grey.height) / SIZE)));
  const page = brightPart(small);
  const border = page && outerBorder(page, small.width);
  const corners = border && cornersOf(border);
  if (!border || !corners || another(small, page)) return null;
  // Upper, right, lower, left; the last two against the border's sense.
  const sides = [0, 1, 2, 3].map((k) => arc(border, corners[k], corners[(k + 1) % 4]));
  const [upper, right, lower, left] = [sides[0], sides[1], sides[2].toReversed(), sides[3].toReversed()];
  const [across, down] = [Math.max(bow(upper), bow(lower)), Math.max(bow(left), bow(right))];
  const sideways = down > across;
  if (Math.min(across, down) > STRAIGHT) return null;
  if (sides.some((side) => goesOn(small, side) || goesOn(small, side.toReversed()))) return null;
  if (unevenness(small, border) > UNEVEN) return null;
  const [first, second] = sideways ? [left, right] : [upper, lower];
  const outline = new Outline([nodesOf(first, small.scale), nodesOf(second, small.scale)]);
  outline.sideways = sideways;
  settle(grey, outline);
  return outline;
}

/**
 * The largest bright part, if bright and dark are two kinds of pixels, and it does not reach far along the photo's rim.
 * @param {Grey} grey
 * @returns {Uint8Array | null} 1 for each of its pixels and those of its holes
 */
function brightPart({ width, height, data }) {
  const level = threshold(data, CONTRAST);
  if (level === null) return null;
  // A printed frame does not part it.
  const bright = widened(Uint8Array.from(data, (value) => Number(value >= level)), width, GAP);
  const labels = new Int32Array(data.length);
  let [largest, label, which] = [0, 0, 0];
  for (let start = 0; start < data.length; start++) {
    if (labels[start] !== 0 || bright[start] === 0) continue;
    const size = fill(labels, width, start, ++label, (i) => bright[i] === 1 && labels[i] === 0);
    if (size > largest) [largest, which] = [size, label];
  }
  if (largest < LEAST * data.length) return null;
  let rim = 0;
  const outside = new Int32Array(data.length);
  for (let i = 0; i < data.length; i++) {
    const [col, row] = [i % width, Math.floor(i / width)];
    if (col > 0 && row > 0 && col < width - 1 && row < height - 1) continue;
    if (labels[i] === which) rim++;
    else if (outside[i] === 0) fill(outside, width, i, 1, (j) => labels[j] !== which && outside[j] === 0);
  }
  if (rim > RIM * 2 * (width + height)) return null;
  return widened(Uint8Array.from(outside), width, GAP).map((value) => 1 - value);
}

/**
 * Whether there is as large a part, less bright and within the photo, which may be the page: then what is brightest is a
 * screen, or where the sun falls on it.
 * @param {Grey} grey
 * @param {Uint8Array} page
 */
function another({ width, height, data }, page) {
  const taken = widened(page, width, 2 * GAP);
  const level = threshold(data.filter((_, i) => taken[i] === 0), FAINT);
  if (level === null) return false;
  const labels = new Int32Array(data.length);
  let label = 0;
  for (let start = 0; start < data.length; start++) {
    if (labels[start] !== 0 || taken[start] === 1 || data[start] < level) continue;
    const size = fill(labels, width, start, ++label, (i) => taken[i] === 0 && data[i] >= level && labels[i] === 0);
    if (size < LEAST * data.length) continue;
    const rim = labels.reduce((sum, one, i) => {
      const [col, row] = [i % width, Math.floor(i / width)];
      return sum + Number(one === label && (col === 0 || row === 0 || col === width - 1 || row === height - 1));
    }, 0);
    if (rim <= RIM * 2 * (width + height)) return true;
  }
  return false;
}

/**
 * What is at most so many pixels away, across and down.
 * @param {Uint8Array} part
 * @param {number} width
 * @param {number} by
 */
function widened(part, width, by) {
  return [1, width].reduce((given, step) => {
    const wide = Uint8Array.from(given);
    given.forEach((value, i) => {
      if (value === 0) return;
      const [at, end] = step === 1 ? [i % width, width] : [Math.floor(i / width), given.length / width];
      for (let k = Math.max(-by, -at); k <= Math.min(by, end - 1 - at); k++) wide[i + k * step] = 1;
    });
    return wide;
  }, part);
}

/**
 * The brightness that parts pixels best into two kinds (Otsu), if these are far enough from each other.
 * @param {Float32Array} data
 * @param {number} least
 */
function threshold(data, least) {
  const counts = new Float64Array(256);
  for (const value of data) counts[Math.min(255, Math.max(0, Math.round(value)))]++;
  const total = counts.reduce((sum, n, v) => sum + n * v, 0);
  let [below, sum, best, level, apart] = [0, 0, 0, 0, 0];
  for (let v = 0; v < 255; v++) {
    below += counts[v];
    sum += counts[v] * v;
    const above = data.length - below;
    if (below === 0 || above === 0) continue;
    const difference = (total - sum) / above - sum / below;
    const spread = below * above * difference ** 2;
    if (spread > best) [best, level, apart] = [spread, v + 0.5, difference];
  }
  return apart >= least ? level : null;
}

/**
 * Labels what is connected to a pixel.
 * @param {Int32Array} labels
 * @param {number} width
 * @param {number} start
 * @param {number} label
 * @param {(i: number) => boolean} takes
 */
function fill(labels, width, start, label, takes) {
  const open = [start];
  labels[start] = label;
  let size = 0;
  for (let i = open.pop(); i !== undefined; i = open.pop()) {
    size++;
    const col = i % width;
    for (const [j, there] of /** @type {[number, boolean][]} */ ([[i - 1, col > 0], [i + 1, col < width - 1], [i - width, i >= width], [i + width, i + width < labels.length]])) {
      if (!there || !takes(j)) continue;
      labels[j] = label;
      open.push(j);
    }
  }
  return size;
}

/**
 * The pixels along a part's outer border, clockwise (Moore's tracing).
 * @param {Uint8Array} part
 * @param {number} width
 * @returns {Point[] | null}
 */
function outerBorder(part, width) {
  const height = part.length / width;
  const has = (/** @type {number} */ x, /** @type {number} */ y) => x >= 0 && y >= 0 && x < width && y < height && part[y * width + x] === 1;
  const first = part.indexOf(1);
  if (first < 0) return null;
  const around = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
  const start = /** @type {Point} */ ([first % width, Math.floor(first / width)]);
  /** @type {Point[]} */
  const border = [start];
  let [x, y, way] = [...start, 0];
  for (let steps = 0; steps < 4 * part.length; steps++) {
    // From the pixel to the left of the way back, clockwise.
    const turn = [...around.keys()].map((k) => (way + 6 + k) % 8).find((k) => has(x + around[k][0], y + around[k][1]));
    if (turn === undefined) return null;
    way = turn;
    x += around[way][0];
    y += around[way][1];
    if (x === start[0] && y === start[1]) return border;
    border.push([x, y]);
  }
  return null;
}

/**
 * Where the border turns by about a right angle, once towards each side: the upper left corner first, clockwise.
 * @param {Point[]} border
 * @returns {[number, number, number, number] | null} their places in it
 */
function cornersOf(border) {
  const n = border.length;
  const arm = Math.round(n / 40);
  if (arm < 4) return null;
  const turns = border.map((at, i) => {
    const [before, after] = [border[(i - arm + n) % n], border[(i + arm) % n]];
    const [ax, ay, bx, by] = [at[0] - before[0], at[1] - before[1], after[0] - at[0], after[1] - at[1]];
    return Math.atan2(ax * by - ay * bx, ax * bx + ay * by);
  });
  const order = [...turns.keys()].sort((i, j) => turns[j] - turns[i]);
  /** @type {number[]} */
  const found = [];
  for (const i of order) {
    if (found.every((j) => Math.min(Math.abs(i - j), n - Math.abs(i - j)) > 2 * arm)) found.push(i);
    if (found.length === 5) break;
  }
  // Four corners that are much sharper than anything else.
  if (found.length < 4 || turns[found[3]] < 0.6 || (found.length > 4 && turns[found[4]] > 0.6 * turns[found[3]])) return null;
  const ring = found.slice(0, 4).sort((i, j) => i - j);
  const sums = ring.map((i) => border[i][0] + border[i][1]);
  const upperLeft = sums.indexOf(Math.min(...sums));
  return /** @type {[number, number, number, number]} */ ([0, 1, 2, 3].map((k) => ring[(upperLeft + k) % 4]));
}

/**
 * By what factor it is brighter within the border in some places than in others: by much where that is one of light on a
 * page and what lies beside it.
 * @param {Grey} grey
 * @param {Point[]} border clockwise
 */
function unevenness(grey, border) {
  const arm = Math.max(2, Math.round(border.length / 80));
  const within = border.map(([x, y], i) => {
    const [before, after] = [border.at(i - arm), border[(i + arm) % border.length]].map((point) => point ?? [x, y]);
    const [dx, dy] = [after[0] - before[0], after[1] - before[1]];
    const length = Math.hypot(dx, dy) || 1;
    // The paper, and not what is printed on it.
    return Math.max(...[2, 3, 4, 5, 6].map((d) => brightness(grey, x - (d * dy) / length, y + (d * dx) / length)));
  }).sort((p, q) => p - q);
  const [low, high] = [0.1, 0.9].map((share) => within[Math.floor(share * within.length)]);
  return high / Math.max(low, 1);
}

/**
 * Whether an edge goes on beyond its last point: that of a shadow does, on page and ground alike, and that of a part of a
 * page, cut off by what is printed across it. A page's edge ends at its corner.
 * @param {Grey} grey
 * @param {Point[]} side
 */
function goesOn(grey, side) {
  const end = side[side.length - 1];
  const straight = bow(side) < STRAIGHT / 2;
  const from = straight ? side[Math.floor(side.length / 20)] : side[Math.max(0, side.length - 1 - Math.ceil(side.length / 8))];
  const size = Math.hypot(end[0] - side[0][0], end[1] - side[0][1]);
  const length = Math.hypot(end[0] - from[0], end[1] - from[1]);
  const [ux, uy] = [(end[0] - from[0]) / length, (end[1] - from[1]) / length];
  // Between the brightness of both sides, so that light and shadow count alike.
  const contrast = (/** @type {number} */ x, /** @type {number} */ y) => {
    const [one, other] = [-1, 1].map((sign) =>
      [2, 3, 4].reduce((sum, d) => sum + brightness(grey, x - sign * d * uy, y + sign * d * ux), 24));
    return Math.log(one / other);
  };
  const own = side.slice(Math.floor(side.length / 2), -3).map(([x, y]) => contrast(x, y)).sort((p, q) => p - q);
  const usual = own[own.length >> 1];
  const most = Math.round(size * (straight ? BEYOND : TANGENT));
  const run = Math.max(6, Math.round(RUN * size));
  /** @type {boolean[]} */
  const there = [];
  for (let t = 4; t < most; t++) {
    const [x, y] = [end[0] + t * ux, end[1] + t * uy];
    if (x < 4 || y < 4 || x > grey.width - 5 || y > grey.height - 5) break;
    // A little to the side, for its direction is not quite known.
    there.push([-2, 0, 2].some((d) => Math.sign(usual) * contrast(x - d * uy, y + d * ux) > Math.abs(usual) / 2));
    if (there.length >= run && there.slice(-run).filter(Boolean).length >= 0.8 * run) return true;
  }
  return false;
}

/**
 * The part of a closed line from one of its points to another.
 * @param {Point[]} line
 * @param {number} from
 * @param {number} to
 */
function arc(line, from, to) {
  return from < to ? line.slice(from, to + 1) : [...line.slice(from), ...line.slice(0, to + 1)];
}

/** How far a line is from its chord, as a share of that. @param {Point[]} line */
function bow(line) {
  const [[x0, y0], [x1, y1]] = [line[0], line[line.length - 1]];
  const length = Math.hypot(x1 - x0, y1 - y0);
  return Math.max(...line.map(([x, y]) => Math.abs((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)))) / length ** 2;
}

/**
 * @param {Point[]} line
 * @param {number} scale
 * @returns {Node[]}
 */
function nodesOf(line, scale) {
  return [0, 1, 2, 3, 4].map((k) => {
    const [x, y] = line[Math.round((k / 4) * (line.length - 1))];
    return nodeAt([rescaled(x, 1 / scale), rescaled(y, 1 / scale)], k === 0 || k === 4);
  });
}
