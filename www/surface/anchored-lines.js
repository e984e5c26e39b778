/** Lines on a morphing mesh, anchored to its triangles. */
import { extentOf } from './triangles.js';

/** @import {Line} from './layer.js' */

/**
 * Lines whose points have barycentric coordinates in triangles.
 * @typedef {object} AnchoredLines
 * @property {Uint32Array} corners three vertices for each point
 * @property {Float32Array} shares barycentric coordinates, three for each point
 * @property {Uint32Array} lengths number of points of each line
 * @property {Uint32Array} lineIndices index of the original line of which each line is a part
 */

/**
 * Anchors lines to the triangles that lie below or above their points. Lines end where there is no triangle.
 * @param {readonly (readonly (readonly [number, number, number])[])[]} lines whose x and y count
 * @param {Float64Array} positions x, y, z of each vertex; seen from above, triangles must not overlap
 * @param {Uint32Array} triangles
 * @returns {AnchoredLines}
 */
export function anchorLines(lines, positions, triangles) {
  const find = triangleFinder(positions, triangles);
  /** @type {number[]} */
  const corners = [];
  /** @type {number[]} */
  const shares = [];
  /** @type {number[]} */
  const lengths = [];
  /** @type {number[]} */
  const indices = [];
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
      indices.push(number);
      length = 0;
    }
    if (length === 0) return;
    lengths.push(length);
    indices.push(number);
  });
  return { lineIndices: Uint32Array.from(indices), corners: Uint32Array.from(corners), shares: Float32Array.from(shares), lengths: Uint32Array.from(lengths) };
}

/**
 * Returns a function that finds the triangle at a place of the plane, by a uniform grid of the triangles.
 * @param {Float64Array} positions
 * @param {Uint32Array} triangles
 */
function triangleFinder(positions, triangles) {
  const { left, top, width, height } = extentOf(positions, 3);
  const side = Math.max(1, Math.ceil(Math.sqrt(triangles.length / 6)));
  /** @param {number} share position across or down, 0 to 1 */
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
 * Returns a function that interpolates one coordinate linearly between two forms.
 * @param {readonly Float32Array[]} forms
 * @param {number} share position between the first form, 0, and the last, 1
 */
export function interpolateForms(forms, share) {
  const place = share * (forms.length - 1);
  const first = Math.min(forms.length - 2, Math.floor(place));
  const [from, to, part] = [forms[first], forms[first + 1], place - first];
  /** @param {number} i */
  return (i) => from[i] + part * (to[i] - from[i]);
}

/**
 * The polylines of anchored lines on a morphing mesh.
 * @param {AnchoredLines} lines
 * @param {readonly Float32Array[]} forms
 * @param {number} share
 * @param {(line: number) => Pick<Line, 'colour' | 'width'>} lineStyle colour and width of each original line
 * @returns {Line[]}
 */
export function morphLines({ corners, shares, lengths, lineIndices }, forms, share, lineStyle) {
  const at = interpolateForms(forms, share);
  let point = 0;
  return Array.from(lengths, (length, n) => ({
    ...lineStyle(lineIndices[n]),
    points: Array.from({ length }, () => {
      const i = 3 * point++;
      /** @param {number} k */
      const mean = (k) => shares[i] * at(3 * corners[i] + k) + shares[i + 1] * at(3 * corners[i + 1] + k) + shares[i + 2] * at(3 * corners[i + 2] + k);
      return /** @type {const} */ ([mean(0), mean(1), mean(2)]);
    }),
  }));
}
