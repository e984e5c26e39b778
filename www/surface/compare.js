/** Errors of a surface against the known truth. */
import { NO_NORMAL, normalsOf, NORMAL_SCALE } from './normals.js';

/** @import {Normals} from './normals.js' */

/**
 * The errors of heights: root mean square, and the mean angle between normals in degrees.
 * @param {ArrayLike<number>} truth
 * @param {number} truthScale unit of length per unit of `truth`
 * @param {{ width: number, height: number, pixelSize: number }} grid
 * @param {ArrayLike<number>} heights
 * @param {number} scale unit of length per unit of `heights`
 */
export function errorsAgainst(truth, truthScale, { width, height, pixelSize }, heights, scale) {
  const [found, right] = [[heights, scale], [truth, truthScale]].map(([values, unit]) =>
    normalsOf(/** @type {ArrayLike<number>} */ (values), width, height, /** @type {number} */ (unit) / pixelSize));
  return { height: rmsError(heights, scale, truth, truthScale), angle: meanAngle(found, right) };
}

/**
 * Root mean square of the height differences, over the pixels with data in both.
 * @param {ArrayLike<number>} heights
 * @param {number} scale unit of length per unit of `heights`
 * @param {ArrayLike<number>} truth
 * @param {number} truthScale unit of length per unit of `truth`
 */
export function rmsError(heights, scale, truth, truthScale) {
  let sum = 0;
  let count = 0;
  for (let i = 0; i < truth.length; i++) {
    const difference = heights[i] * scale - truth[i] * truthScale;
    if (Number.isNaN(difference)) continue;
    sum += difference * difference;
    count++;
  }
  return Math.sqrt(sum / count);
}

/**
 * Mean angle between normals in degrees, over the pixels with data in both.
 * @param {Normals} a
 * @param {Normals} b
 */
export function meanAngle(a, b) {
  let sum = 0;
  let count = 0;
  for (let i = 0; i < a.xy.length; i += 2) {
    if (a.xy[i] === NO_NORMAL || b.xy[i] === NO_NORMAL) continue;
    const ax = a.xy[i] / NORMAL_SCALE;
    const ay = a.xy[i + 1] / NORMAL_SCALE;
    const bx = b.xy[i] / NORMAL_SCALE;
    const by = b.xy[i + 1] / NORMAL_SCALE;
    const dx = ax - bx;
    const dy = ay - by;
    const dz = Math.sqrt(Math.max(0, 1 - ax * ax - ay * ay)) - Math.sqrt(Math.max(0, 1 - bx * bx - by * by));
    // The angle from the chord: at small angles it is more accurate than from the cosine.
    sum += 2 * Math.asin(Math.min(1, Math.sqrt(dx * dx + dy * dy + dz * dz) / 2));
    count++;
  }
  return ((sum / count) * 180) / Math.PI;
}
