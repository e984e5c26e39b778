/** How far a surface is from the known truth. */
import { HOLE, UNIT } from './normals.js';

/** @import {Normals} from './normals.js' */

/**
 * Root mean square of the differences, over the pixels that both have.
 * @param {ArrayLike<number>} heights
 * @param {number} scale of `heights`
 * @param {ArrayLike<number>} truth
 * @param {number} truthScale
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
 * Mean angle between normals in degrees, over the pixels that both have.
 * @param {Normals} a
 * @param {Normals} b
 */
export function meanAngle(a, b) {
  let sum = 0;
  let count = 0;
  for (let i = 0; i < a.xy.length; i += 2) {
    if (a.xy[i] === HOLE || b.xy[i] === HOLE) continue;
    const ax = a.xy[i] / UNIT;
    const ay = a.xy[i + 1] / UNIT;
    const bx = b.xy[i] / UNIT;
    const by = b.xy[i + 1] / UNIT;
    const dx = ax - bx;
    const dy = ay - by;
    const dz = Math.sqrt(Math.max(0, 1 - ax * ax - ay * ay)) - Math.sqrt(Math.max(0, 1 - bx * bx - by * by));
    // By the chord, which is accurate where the cosine is not: at small angles.
    sum += 2 * Math.asin(Math.min(1, Math.sqrt(dx * dx + dy * dy + dz * dz) / 2));
    count++;
  }
  return ((sum / count) * 180) / Math.PI;
}
