/** A flat image against the page itself. */
import msssim from '@blazediff/ssim/msssim';
import { project, seenFrom } from './camera.mjs';
import { anisotropy, similarity, singular } from './fitting.mjs';
import { greyAt } from './sensor.mjs';

/**
 * @typedef {import('./fitting.mjs').Pair} Pair
 * @typedef {import('./sensor.mjs').Grey} Grey
 * @typedef {{ width: number, height: number, map: Float32Array }} Mapped a flat image's warp map
 */

/** Side of the squares of the page that count as covered, or not, in metres. */
const SQUARE = 1e-3;
/** A step that strain is taken over, in metres. */
const STEP = 2e-3;

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
 * @typedef {object} Truth
 * @property {number} rms displacement after the best similarity, in widths of the page
 * @property {number} anisotropy
 * @property {number} coverage share of the page that is shown
 * @property {number} strain mean of the larger one, over steps of 2 mm, in lengths that are as long on the whole
 * @property {import('./fitting.mjs').Similarity} place from the page, in metres, to pixels of the flat image
 */

/**
 * @param {{ width: number, height: number }} flat
 * @param {Float32Array} places
 * @param {{ width: number, height: number }} page
 * @returns {Truth}
 */
export function measure({ width, height }, places, page) {
  /** @type {Pair[]} */
  const pairs = [];
  const [cols, rows] = [page.width, page.height].map((side) => Math.ceil(side / SQUARE));
  const covered = new Uint8Array(cols * rows);
  for (let i = 0; i < width * height; i += 1) {
    const [u, v] = [places[2 * i], places[2 * i + 1]];
    if (Number.isNaN(u)) continue;
    const [col, row] = [Math.min(cols - 1, Math.floor(u / SQUARE)), Math.min(rows - 1, Math.floor(v / SQUARE))];
    covered[row * cols + col] = 1;
    if (i % 7 === 0) pairs.push([i % width, Math.floor(i / width), u, v]);
  }
  const back = similarity(pairs);
  const place = similarity(pairs.map(([x, y, u, v]) => [u, v, x, y]));
  return {
    rms: back.rms / page.width,
    anisotropy: anisotropy(pairs),
    coverage: covered.reduce((sum, one) => sum + one, 0) / covered.length,
    strain: strain(width, height, places, Math.hypot(back.a, back.b)),
    place,
  };
}

/**
 * @param {number} width
 * @param {number} height
 * @param {Float32Array} places
 * @param {number} pixel its length on the page
 */
function strain(width, height, places, pixel) {
  const step = Math.max(1, Math.round(STEP / pixel));
  let [sum, count] = [0, 0];
  for (let y = 0; y < height - step; y += step) {
    for (let x = 0; x < width - step; x += step) {
      const [here, right, below] = [y * width + x, y * width + x + step, (y + step) * width + x];
      const change = (/** @type {number} */ k, /** @type {number} */ to) =>
        (places[2 * to + k] - places[2 * here + k]) / step / pixel;
      const values = singular([change(0, right), change(0, below), change(1, right), change(1, below)]);
      if (values.some(Number.isNaN)) continue;
      sum += Math.max(...values.map((value) => Math.abs(value - 1)));
      count += 1;
    }
  }
  return sum / count;
}

/** On white. @param {{ width: number, height: number, data: Uint8Array | Uint8ClampedArray }} image @returns {Grey} */
export function greyOf({ width, height, data }) {
  const grey = Uint8Array.from({ length: width * height }, (_, i) => (data[4 * i + 3] > 0 ? data[4 * i] : 255));
  return { width, height, data: grey };
}

/** @param {Grey} image */
export function rgba({ width, height, data }) {
  const pixels = new Uint8ClampedArray(4 * width * height).fill(255);
  data.forEach((value, i) => pixels.fill(value, 4 * i, 4 * i + 3));
  return { width, height, data: pixels };
}

/**
 * What a flat image shows of the page on the pixels of the page's own image, turned and shifted to it.
 * @param {Grey} flat
 * @param {Grey} original
 * @param {{ width: number }} page
 * @param {import('./fitting.mjs').Similarity} place
 * @returns {Grey}
 */
export function turned(flat, { width, height }, page, { a, b, s, t }) {
  const pixel = page.width / width;
  const data = Uint8Array.from({ length: width * height }, (_, i) => {
    const [u, v] = [((i % width) + 0.5) * pixel, (Math.floor(i / width) + 0.5) * pixel];
    const [x, y] = [a * u - b * v + s, b * u + a * v + t];
    const inside = x >= 0 && y >= 0 && x <= flat.width - 1 && y <= flat.height - 1;
    return inside ? Math.round(greyAt(flat, x, y)) : 255;
  });
  return { width, height, data };
}

/**
 * What a photo shows of the page on the pixels of the page's own image, by the shape that it has: the most
 * that any surface can give, with as many pixels to a letter as the photo has.
 * @param {Grey} photo
 * @param {Grey} original
 * @param {import('./pages.mjs').Page} page
 * @param {import('./camera.mjs').Pose} pose
 * @param {import('./camera.mjs').Camera} camera
 * @returns {Grey}
 */
export function byItsShape(photo, { width, height }, page, pose, camera) {
  const pixel = page.width / width;
  const space = seenFrom(page, pose);
  const data = Uint8Array.from({ length: width * height }, (_, i) => {
    const [x, y] = project(camera, space(((i % width) + 0.5) * pixel, (Math.floor(i / width) + 0.5) * pixel));
    return Math.round(greyAt(photo, x, y));
  });
  return { width, height, data };
}

/**
 * Multi-scale structural similarity, not a number where it is a root of a negative one.
 * @param {Grey} found
 * @param {Grey} original
 */
export function alike(found, original) {
  const { width, height } = original;
  return msssim(rgba(found).data, rgba(original).data, undefined, width, height);
}
