/** Depths as a phone gives them, and photos. */
import { background, finer, view } from './camera.mjs';

/**
 * @typedef {import('./camera.mjs').Camera} Camera
 * @typedef {import('./camera.mjs').Pose} Pose
 * @typedef {import('./camera.mjs').View} View
 * @typedef {import('./pages.mjs').Page} Page
 * @typedef {{ width: number, height: number, data: Uint8Array }} Grey
 */

/** Samples across a pixel of the depths; it collects light from half a pixel around it, too. */
const FINE = 4;

/**
 * Uniform numbers from 0 to 1, the same each time (Numerical Recipes' linear congruential generator).
 * @param {number} seed
 */
export function uniform(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Normal, by Box and Muller. @param {number} seed */
export function normal(seed) {
  const next = uniform(seed);
  return () => Math.sqrt(-2 * Math.log(1 - next())) * Math.cos(2 * Math.PI * next());
}

/**
 * Normal numbers in a row, smoothed and of standard deviation 1.
 * @param {number} length
 * @param {number} deviation of the kernel
 * @param {() => number} next
 */
function smoothRow(length, deviation, next) {
  const reach = Math.ceil(4 * deviation);
  const kernel = Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp(-0.5 * ((i - reach) / deviation) ** 2));
  const norm = Math.hypot(...kernel);
  const white = Float64Array.from({ length: length + 2 * reach }, next);
  return Float64Array.from({ length }, (_, i) =>
    kernel.reduce((sum, weight, k) => sum + weight * white[i + k], 0) / norm);
}

/**
 * The same over an image.
 * @param {number} width
 * @param {number} height
 * @param {number} deviation
 * @param {() => number} next
 */
export function smoothNoise(width, height, deviation, next) {
  const reach = Math.ceil(4 * deviation);
  const rows = Array.from({ length: height + 2 * reach }, () => smoothRow(width, deviation, next));
  const field = new Float64Array(width * height);
  for (let x = 0; x < width; x += 1) {
    let at = 0;
    const column = smoothRow(height, deviation, () => rows[at++][x]);
    for (let y = 0; y < height; y += 1) field[y * width + x] = column[y];
  }
  return field;
}

/**
 * In whole millimetres, 0 where there is none: with what is behind, mixtures of both at outlines, smooth noise
 * and dropouts.
 * @param {Page} page
 * @param {Pose} pose
 * @param {Camera} camera
 * @param {number} noise standard deviation, in millimetres
 * @param {number} seed of the noise
 * @param {number} smooth standard deviation of the kernel that the noise is smooth by, in pixels
 */
export function sensed(page, pose, camera, noise, seed, smooth) {
  const { width, height } = camera;
  const close = finer(camera, FINE);
  const [fine, behind] = [view(page, pose, close), background(page, pose, close)];
  const next = normal(1 + Math.round(10 * noise) + 100 * seed);
  const error = smoothNoise(width, height, smooth, next);
  const around = FINE / 2;
  const data = new Float64Array(width * height);
  for (let i = 0; i < data.length; i += 1) {
    const [col, row] = [(i % width) * FINE, Math.floor(i / width) * FINE];
    let [sum, count] = [0, 0];
    for (let y = Math.max(0, row - around); y < Math.min(fine.height, row + FINE + around); y += 1) {
      for (let x = Math.max(0, col - around); x < Math.min(fine.width, col + FINE + around); x += 1) {
        const depth = fine.depths[y * fine.width + x];
        sum += 1000 * (depth < Infinity ? depth : behind(x, y));
        count += 1;
      }
    }
    data[i] = Math.round(sum / count + noise * error[i]);
  }
  const chance = uniform(7);
  for (let k = 0; k < 120; k += 1) {
    const [x, y, radius] = [chance() * width, chance() * height, 0.6 + 1.6 * chance()];
    for (let i = 0; i < data.length; i += 1) {
      if (Math.hypot((i % width) - x, Math.floor(i / width) - y) < radius) data[i] = 0;
    }
  }
  return { width, height, data };
}

/**
 * Grey at a place of a printed page, bilinear.
 * @param {Grey} print
 * @param {number} x in its pixels, (0, 0) the centre of the first
 * @param {number} y
 */
function greyAt({ width, height, data }, x, y) {
  const [left, top] = [Math.min(Math.max(x, 0), width - 1.001), Math.min(Math.max(y, 0), height - 1.001)];
  const [i, j] = [Math.floor(left), Math.floor(top)];
  const [s, t, at] = [left - i, top - j, j * width + i];
  return (1 - t) * ((1 - s) * data[at] + s * data[at + 1]) + t * ((1 - s) * data[at + width] + s * data[at + width + 1]);
}

/** Of a pixel's samples from its centre, in pixels. */
const SAMPLES = [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]];

/**
 * A photo of the page as it is printed, grey beside it.
 * @param {View} seen
 * @param {Grey} print
 * @param {Page} page
 */
export function photograph({ width, height, places }, print, page) {
  const data = new Uint8ClampedArray(4 * width * height);
  const scale = print.width / page.width;
  for (let i = 0; i < width * height; i += 1) {
    let grey = 80;
    if (!Number.isNaN(places[2 * i])) {
      /** How a place changes from here to another pixel. @param {number} k @param {number} other */
      const change = (k, other) => (places[2 * other + k] - places[2 * i + k]) * scale || 0;
      const [ux, vx, uy, vy] = [change(0, i + 1), change(1, i + 1), change(0, i + width), change(1, i + width)];
      const [u, v] = [places[2 * i] * scale - 0.5, places[2 * i + 1] * scale - 0.5];
      grey = SAMPLES.reduce((sum, [x, y]) => sum + greyAt(print, u + x * ux + y * uy, v + x * vx + y * vy), 0) / 4;
    }
    data.fill(grey, 4 * i, 4 * i + 3);
    data[4 * i + 3] = 255;
  }
  return { width, height, data };
}
