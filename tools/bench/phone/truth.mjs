/** A flat image against the page itself. */
import { similarity } from './fitting.mjs';

/** @typedef {{ width: number, height: number, map: Float32Array }} Mapped a flat image's warp map */

/** Of so many pixels one is compared. */
const PIXEL_STEP = 7;

/**
 * The place on the page that a flat image shows at each pixel, NaN where it shows none.
 * @param {Mapped} flat
 * @param {import('./camera.mjs').View} seen what the photo shows
 */
export function placesOf({ width, height, map }, { width: across, height: down, places }) {
  const found = new Float32Array(2 * width * height).fill(NaN);
  for (let i = 0; i < width * height; i += 1) {
    const [x, y] = [map[2 * i], map[2 * i + 1]];
    const [left, top] = [Math.floor(x), Math.floor(y)];
    if (!(left >= 0 && top >= 0 && left < across - 1 && top < down - 1)) continue;
    const [s, t, at] = [x - left, y - top, 2 * (top * across + left)];
    for (const k of [0, 1]) {
      const [above, below] = [at + k, at + k + 2 * across].map((j) => (1 - s) * places[j] + s * places[j + 2]);
      found[2 * i + k] = (1 - t) * above + t * below;
    }
  }
  return found;
}

/**
 * Displacement after the best similarity, root mean square in widths of the page.
 * @param {{ width: number, height: number }} flat
 * @param {Float32Array} places
 * @param {{ width: number }} page
 */
export function displacement({ width, height }, places, page) {
  /** @type {import('./fitting.mjs').Pair[]} */
  const pairs = [];
  for (let i = 0; i < width * height; i += PIXEL_STEP) {
    const [u, v] = [places[2 * i], places[2 * i + 1]];
    if (!Number.isNaN(u)) pairs.push([i % width, Math.floor(i / width), u, v]);
  }
  return similarity(pairs).rms / page.width;
}
