/** Places of a mesh that moves: lines that are drawn on it go along, and values are read from it. */
import { extentOf } from './triangles.js';

/** @import {Line} from './layer.js' */
/** @import {Vector} from './camera.js' */

/**
 * Lines as shares of the corners of triangles, three for each point.
 * @typedef {object} Anchored
 * @property {Uint32Array} corners
 * @property {Float32Array} shares
 * @property {Uint32Array} lengths points of each line
 * @property {Uint32Array} of which of the lines that were given each one is, or is a part of
 */

/** A mesh on its way. @typedef {{ triangles: Uint32Array, forms: readonly Float32Array[] }} Moving */

/**
 * @param {readonly (readonly (readonly [number, number, number])[])[]} lines over the plane
 * @param {Float64Array} positions x, y, z of each vertex; from above no triangle is behind another
 * @param {Uint32Array} triangles
 * @returns {Anchored} without points beside the mesh, at which lines end
 */
export function anchored(lines, positions, triangles) {
  const find = finderOf(positions, triangles);
  /** @type {number[]} */
  const corners = [];
  /** @type {number[]} */
  const shares = [];
  /** @type {number[]} */
  const lengths = [];
  /** @type {number[]} */
  const of = [];
  lines.forEach((line, number) => {
    let length = 0;
    for (const [x, y] of line) {
      const found = find(x, y);
      if (found) {
        corners.push(...found.corners);
        shares.push(...found.shares);
        length++;
      }
      if (found || length === 0) continue;
      lengths.push(length);
      of.push(number);
      length = 0;
    }
    if (length === 0) return;
    lengths.push(length);
    of.push(number);
  });
  return { of: Uint32Array.from(of), corners: Uint32Array.from(corners), shares: Float32Array.from(shares), lengths: Uint32Array.from(lengths) };
}

/**
 * Triangles by the cells of a grid over the plane that they touch.
 * @param {Float64Array} positions
 * @param {Uint32Array} triangles
 */
function finderOf(positions, triangles) {
  const { left, top, width, height } = extentOf(positions, 3);
  const side = Math.max(1, Math.ceil(Math.sqrt(triangles.length / 6)));
  /** @param {number} share of the way across or down */
  const cell = (share) => Math.min(side - 1, Math.max(0, Math.floor(share * side)));
  const colOf = (/** @type {number} */ x) => cell((x - left) / (width || 1));
  const rowOf = (/** @type {number} */ y) => cell((top - y) / (height || 1));
  /** @type {number[][]} */
  const cells = Array.from({ length: side * side }, () => []);
  for (let t = 0; t < triangles.length; t += 3) {
    const xs = [0, 1, 2].map((k) => positions[3 * triangles[t + k]]);
    const ys = [0, 1, 2].map((k) => positions[3 * triangles[t + k] + 1]);
    for (let row = rowOf(Math.max(...ys)); row <= rowOf(Math.min(...ys)); row++) {
      for (let col = colOf(Math.min(...xs)); col <= colOf(Math.max(...xs)); col++) cells[row * side + col].push(t);
    }
  }
  /** @param {number} x @param {number} y */
  return (x, y) => {
    for (const t of cells[rowOf(y) * side + colOf(x)]) {
      const corners = [triangles[t], triangles[t + 1], triangles[t + 2]];
      const [ax, bx, cx] = corners.map((vertex) => positions[3 * vertex]);
      const [ay, by, cy] = corners.map((vertex) => positions[3 * vertex + 1]);
      const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      const b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area;
      const c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area;
      if (b >= -1e-6 && c >= -1e-6 && b + c <= 1 + 1e-6) return { corners, shares: [1 - b - c, b, c] };
    }
    return null;
  };
}

/**
 * Between two forms.
 * @param {readonly Float32Array[]} forms
 * @param {number} share of the way through all of them
 */
export function formAt(forms, share) {
  const place = share * (forms.length - 1);
  const first = Math.min(forms.length - 2, Math.floor(place));
  const [from, to, part] = [forms[first], forms[first + 1], place - first];
  /** @param {number} i */
  return (i) => from[i] + part * (to[i] - from[i]);
}

/**
 * Where anchored lines are now.
 * @param {Anchored} lines
 * @param {readonly Float32Array[]} forms
 * @param {number} share
 * @param {(line: number) => Pick<Line, 'colour' | 'width'>} look of each line that was given
 * @returns {Line[]}
 */
export function linesAt({ corners, shares, lengths, of }, forms, share, look) {
  const at = formAt(forms, share);
  let point = 0;
  return Array.from(lengths, (length, n) => ({
    ...look(of[n]),
    points: Array.from({ length }, () => {
      const i = 3 * point++;
      /** @param {number} k */
      const mean = (k) => shares[i] * at(3 * corners[i] + k) + shares[i + 1] * at(3 * corners[i + 1] + k) + shares[i + 2] * at(3 * corners[i + 2] + k);
      return /** @type {const} */ ([mean(0), mean(1), mean(2)]);
    }),
  }));
}

/**
 * The value at the place of a mesh that is seen first along a line of sight, NaN beside it (Möller and Trumbore 1997).
 * @param {Moving} mesh
 * @param {number} share
 * @param {{ point: Vector, towards: Vector }} sight
 * @param {ArrayLike<number>} values of the vertices
 */
export function valueOnMesh({ triangles, forms }, share, { point: [px, py, pz], towards: [dx, dy, dz] }, values) {
  const at = formAt(forms, share);
  let [nearest, value] = [-Infinity, NaN];
  for (let t = 0; t < triangles.length; t += 3) {
    const [i, j, k] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ax, ay, az] = [at(i), at(i + 1), at(i + 2)];
    const [ex, ey, ez] = [at(j) - ax, at(j + 1) - ay, at(j + 2) - az];
    const [fx, fy, fz] = [at(k) - ax, at(k + 1) - ay, at(k + 2) - az];
    const [hx, hy, hz] = [dy * fz - dz * fy, dz * fx - dx * fz, dx * fy - dy * fx];
    const area = ex * hx + ey * hy + ez * hz;
    if (area === 0) continue;
    const [sx, sy, sz] = [px - ax, py - ay, pz - az];
    const b = (sx * hx + sy * hy + sz * hz) / area;
    const [qx, qy, qz] = [sy * ez - sz * ey, sz * ex - sx * ez, sx * ey - sy * ex];
    const c = (dx * qx + dy * qy + dz * qz) / area;
    const along = (fx * qx + fy * qy + fz * qz) / area;
    if (!(b >= 0 && c >= 0 && b + c <= 1) || along <= nearest) continue;
    nearest = along;
    value = (1 - b - c) * values[i / 3] + b * values[j / 3] + c * values[k / 3];
  }
  return value;
}
