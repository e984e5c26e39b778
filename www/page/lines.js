/**
 * Lines of text that are drawn by hand: two ends, between which a line runs as the page bends, drawn to the letters' feet.
 */
import { rescaled } from './grey.js';
import { nodeAt } from './outline.js';
import { traced } from './snap.js';

/** @import {Grey} from './grey.js' */
/** @import {Point} from './outline.js' */
/** @import {DewarpedPage} from './flatten.js' */
/** @typedef {[from: Point, to: Point]} Ends in pixels of the photo */

/** Points along a line. */
const POINTS = 16;
/** How far from it letters' feet are looked for, as a share of the photo's diagonal: less than from line to line. */
const REACH = 0.004;
/** Pixels by which letters' feet may be off each other. */
const ALIKE = 1.5;

/**
 * @param {Grey} grey
 * @param {Ends} ends
 * @param {DewarpedPage | null} flat the page as it is known, of the photo reduced like `grey`
 * @param {boolean} snapping
 * @returns {Point[]}
 */
export function lineBetween(grey, ends, flat, snapping) {
  const level = (flat && levelBetween(flat, ends, grey.scale)) ?? straight(ends);
  if (!snapping) return level;
  const reach = Math.max(3, REACH * Math.hypot(grey.width, grey.height));
  const { points, seen } = traced(grey, level.map((point) => nodeAt(point, false)), { places: 2 * POINTS, reach });
  // Its ends are where they were put, not where the letters stand; and what is off by more than the rest is another line.
  const own = points.slice(1, -1).map((point) => ({ point, off: beside(level, point) }));
  const middle = own.map(({ off }) => off).sort((a, b) => a - b)[own.length >> 1] ?? 0;
  const near = own.filter(({ off }) => Math.abs(off - middle) < ALIKE / grey.scale);
  return seen >= 0.5 && 2 * near.length > own.length && near.length > 4 ? near.map(({ point }) => point) : level;
}

/** How far a place is from the nearest part of a line, and on which side. @param {readonly Point[]} line @param {Point} place */
function beside(line, [x, y]) {
  let [best, least] = [0, Infinity];
  line.slice(1).forEach(([u, v], i) => {
    const [a, b] = line[i];
    const length = Math.hypot(u - a, v - b) || 1;
    const away = Math.hypot(x - (a + u) / 2, y - (b + v) / 2);
    if (away < least) [best, least] = [((u - a) * (y - b) - (v - b) * (x - a)) / length, away];
  });
  return best;
}

/** @param {Ends} ends @returns {Point[]} */
function straight([from, to]) {
  return Array.from({ length: POINTS }, (_, i) => {
    const t = i / (POINTS - 1);
    return [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
  });
}

/**
 * What is straight between two places on the flat page; none if one is beside it.
 * @param {DewarpedPage} flat
 * @param {Ends} ends
 * @param {number} scale
 * @returns {Point[] | null}
 */
function levelBetween(flat, ends, scale) {
  const places = ends.map((end) => flatPlace(flat, end, scale));
  const [from, to] = places;
  if (!from || !to) return null;
  return straight([from, to]).map(([col, row]) => {
    const at = 2 * (Math.round(row) * flat.width + Math.round(col));
    return [rescaled(flat.map[at], 1 / scale), rescaled(flat.map[at + 1], 1 / scale)];
  });
}

/**
 * The pixel of the flat page that shows a place of the photo.
 * @param {DewarpedPage} flat
 * @param {Point} place
 * @param {number} scale
 * @returns {Point | null}
 */
export function flatPlace({ width, height, map }, place, scale) {
  const [x, y] = place.map((v) => rescaled(v, scale));
  const off = (/** @type {number} */ at) => Math.hypot(map[2 * at] - x, map[2 * at + 1] - y);
  let [best, least] = [-1, Infinity];
  /** @param {number} at */
  const look = (at) => {
    const here = off(at);
    if (here < least) [best, least] = [at, here];
  };
  const step = 8;
  for (let row = 0; row < height; row += step) {
    for (let col = 0; col < width; col += step) look(row * width + col);
  }
  const [near, far] = [best % width, Math.floor(best / width)];
  for (let row = Math.max(0, far - step); row <= Math.min(height - 1, far + step); row++) {
    for (let col = Math.max(0, near - step); col <= Math.min(width - 1, near + step); col++) look(row * width + col);
  }
  return least < 3 ? [best % width, Math.floor(best / width)] : null;
}
