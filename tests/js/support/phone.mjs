/** What a phone sees of a curled A4 page at a slant: its depths, its photo, and where on the page a pixel lies. */
import { similarity } from '../../../tools/bench/phone/fitting.mjs';
import { depthCamera } from '../../../tools/bench/phone/camera.mjs';

export { depthCamera };

/** @typedef {{ width: number, height: number, fx: number, fy: number, cx: number, cy: number }} Camera */

const [radius, tilt, away] = [0.12, (25 * Math.PI) / 180, 0.43];
const page = [0.21, 0.297];
/** Of the camera beside the LiDAR, which shows the same, five times as fine: `cx' + 1/2 = (cx + 1/2)·5`. */
export const photoCamera = { width: 1280, height: 960, fx: 1025, fy: 1025, cx: 632, cy: 487 };

/**
 * Where the ray of a pixel meets the page: how far ahead, and its arc from the middle and its height there, in metres.
 * @param {Camera} camera
 * @param {number} col
 * @param {number} row
 * @returns {[ahead: number, arc: number, down: number] | undefined}
 */
export function meets({ fx, fy, cx, cy }, col, row) {
  const [x, y] = [(col - cx) / fx, (row - cy) / fy];
  const [sin, cos] = [Math.sin(tilt), Math.cos(tilt)];
  // In the page's own axes the cylinder is u² + (w − r)² = r².
  const [ou, ov, ow] = [0, -sin * away, -cos * away];
  const [du, dv, dw] = [x, cos * y + sin, cos - sin * y];
  const a = du * du + dw * dw;
  const b = ou * du + (ow - radius) * dw;
  const c = ou * ou + (ow - radius) ** 2 - radius ** 2;
  const t = (-b - Math.sqrt(b * b - a * c)) / a;
  const [u, v, w] = [ou + t * du, ov + t * dv, ow + t * dw];
  const arc = radius * Math.atan2(u, radius - w);
  return Math.abs(arc) <= page[0] / 2 && Math.abs(v) <= page[1] / 2 ? [t, arc, v] : undefined;
}

/** Depths in metres, 0 beside the page. */
export function depths() {
  const { width, height } = depthCamera;
  const data = Float64Array.from({ length: width * height }, (_, i) =>
    meets(depthCamera, i % width, Math.floor(i / width))?.[0] ?? 0);
  return { width, height, data };
}

/** A photo, red from left to right on the page and green from top to bottom, grey beside it. @param {Camera} camera */
export function photo(camera) {
  const { width, height } = camera;
  const data = new Uint8ClampedArray(4 * width * height);
  for (let i = 0; i < width * height; i += 1) {
    const found = meets(camera, i % width, Math.floor(i / width));
    const [red, green, blue] = found ? [255 * (found[1] / page[0] + 0.5), 255 * (found[2] / page[1] + 0.5), 0] : [90, 90, 90];
    data.set([red, green, blue, 255], 4 * i);
  }
  return { width, height, data };
}

/**
 * How far what a flat image shows is from where it is on the page after the best similarity: root of the mean square,
 * in shares of the page's width.
 * @param {Camera} camera of the photo
 * @param {{ width: number, height: number, map: Float32Array }} flat
 */
export function displacement(camera, { width, height, map }) {
  /** @type {[number, number, number, number][]} */
  const pairs = [];
  for (let i = 0; i < width * height; i += 3) {
    const found = Number.isNaN(map[2 * i]) ? undefined : meets(camera, map[2 * i], map[2 * i + 1]);
    if (found) pairs.push([i % width, Math.floor(i / width), found[1], found[2]]);
  }
  return similarity(pairs).rms / page[0];
}
