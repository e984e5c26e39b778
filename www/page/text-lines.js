/**
 * Lines of text drawn by hand. The user gives two ends; the line between them follows the bend of the page, and snaps to the
 * baseline of the letters.
 */
import { rescalePixel } from './grey.js';
import { nodeAt } from './outline.js';
import { traceEdge } from './edge-snapping.js';

/** @import {GreyImage} from './grey.js' */
/** @import {Point} from './outline.js' */
/** @import {DewarpedPage} from './flatten.js' */
/** @typedef {[from: Point, to: Point]} Ends in pixels of the photo */

/** Number of points of a line. */
const LINE_POINTS = 16;
/** Maximum distance of the baseline from the drawn line, in diagonals of the photo: less than the distance of two lines of text. */
const MAX_BASELINE_OFFSET_DIAGONALS = 0.004;
/** Maximum deviation of a baseline point from the median offset, in pixels of the reduced photo. */
const MAX_BASELINE_DEVIATION_PIXELS = 1.5;

/**
 * The line of text between two ends, in pixels of the photo.
 * @param {GreyImage} grey
 * @param {Ends} ends
 * @param {DewarpedPage | null} flat the newest flat page, made from the photo at the scale of `grey`; null for a straight line
 * @param {boolean} snapping whether the line snaps to the baseline of the letters
 * @returns {Point[]}
 */
export function textLineBetween(grey, ends, flat, snapping) {
  const guide = (flat && flatLineBetween(flat, ends, grey.scale)) ?? straightLine(ends);
  if (!snapping) return guide;
  const maxOffset = Math.max(3, MAX_BASELINE_OFFSET_DIAGONALS * Math.hypot(grey.width, grey.height));
  const { points, visibleShare } = traceEdge(grey, guide.map((point) => nodeAt(point, false)), { intervals: 2 * LINE_POINTS, maxOffset });
  // The ends were put by hand and need not lie on the baseline; points far from the median offset belong to another line.
  const baseline = points.slice(1, -1).map((point) => ({ point, off: signedDistance(guide, point) }));
  const median = baseline.map(({ off }) => off).sort((a, b) => a - b)[baseline.length >> 1] ?? 0;
  const near = baseline.filter(({ off }) => Math.abs(off - median) < MAX_BASELINE_DEVIATION_PIXELS / grey.scale);
  return visibleShare >= 0.5 && 2 * near.length > baseline.length && near.length > 4 ? near.map(({ point }) => point) : guide;
}

/** The signed distance of a place from the nearest segment of a polyline. @param {readonly Point[]} line @param {Point} place */
function signedDistance(line, [x, y]) {
  let [best, least] = [0, Infinity];
  line.slice(1).forEach(([u, v], i) => {
    const [a, b] = line[i];
    const length = Math.hypot(u - a, v - b) || 1;
    const away = Math.hypot(x - (a + u) / 2, y - (b + v) / 2);
    if (away < least) [best, least] = [((u - a) * (y - b) - (v - b) * (x - a)) / length, away];
  });
  return best;
}

/** Evenly spaced points from one end to the other. @param {Ends} ends @returns {Point[]} */
function straightLine([from, to]) {
  return Array.from({ length: LINE_POINTS }, (_, i) => {
    const t = i / (LINE_POINTS - 1);
    return [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
  });
}

/**
 * The curve in the photo that is straight on the flat page; null if an end is not on the page.
 * @param {DewarpedPage} flat
 * @param {Ends} ends
 * @param {number} scale
 * @returns {Point[] | null}
 */
function flatLineBetween(flat, ends, scale) {
  const places = ends.map((end) => flatPixelAt(flat, end, scale));
  const [from, to] = places;
  if (!from || !to) return null;
  return straightLine([from, to]).map(([col, row]) => {
    const at = 2 * (Math.round(row) * flat.width + Math.round(col));
    return [rescalePixel(flat.map[at], 1 / scale), rescalePixel(flat.map[at + 1], 1 / scale)];
  });
}

/**
 * The pixel of the flat page that shows a place of the photo; null if none does within three pixels. A coarse grid of pixels
 * is searched first, then the pixels around the best one.
 * @param {DewarpedPage} flat
 * @param {Point} place
 * @param {number} scale pixels of the reduced photo per pixel of the photo
 * @returns {Point | null}
 */
export function flatPixelAt({ width, height, map }, place, scale) {
  const [x, y] = place.map((v) => rescalePixel(v, scale));
  const distance = (/** @type {number} */ at) => Math.hypot(map[2 * at] - x, map[2 * at + 1] - y);
  let [best, least] = [-1, Infinity];
  /** @param {number} at */
  const testPixel = (at) => {
    const here = distance(at);
    if (here < least) [best, least] = [at, here];
  };
  const step = 8;
  for (let row = 0; row < height; row += step) {
    for (let col = 0; col < width; col += step) testPixel(row * width + col);
  }
  const [near, far] = [best % width, Math.floor(best / width)];
  for (let row = Math.max(0, far - step); row <= Math.min(height - 1, far + step); row++) {
    for (let col = Math.max(0, near - step); col <= Math.min(width - 1, near + step); col++) testPixel(row * width + col);
  }
  return least < 3 ? [best % width, Math.floor(best / width)] : null;
}
