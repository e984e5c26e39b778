/** Results as text: JSON, and OBJ of lines and of flat sheets. */
import { streams } from './terminal.js';

/** @param {unknown} value */
export function json(value) {
  return new TextEncoder().encode(`${JSON.stringify(value, undefined, 2)}\n`);
}

/**
 * The file of a report with what was assumed of the input, if one is asked for.
 * @param {{ report?: string }} task
 * @param {object} report
 */
export function reportFile({ report: path }, report) {
  return path === undefined ? [] : [{ path, bytes: json({ ...report, assumptions: streams().assumptions ?? [] }) }];
}

/** Typed arrays as plain ones, for JSON. @param {object} object */
export function plainArrays(object) {
  const entries = Object.entries(object);
  return Object.fromEntries(entries.map(([name, value]) => [name, ArrayBuffer.isView(value) ? [.../** @type {Float64Array} */ (value)] : value]));
}

/**
 * Lines as an OBJ, in the axes that the surface's mesh has.
 * @param {import('../types.js').Ruling[]} lines
 * @param {import('../types.js').Frame} [frame]
 */
export function linesObj(lines, frame) {
  const { right = [1, 0, 0], up = [0, 1, 0], towards = [0, 0, 1] } = frame ?? {};
  const text = ['# rulings'];
  let count = 0;
  for (const { points } of lines) {
    for (const [x, y, z] of points) {
      text.push(`v ${[0, 1, 2].map((k) => x * right[k] + y * up[k] + z * towards[k]).join(' ')}`);
    }
    // The file counts from 1.
    text.push(`l ${points.map((_, i) => count + i + 1).join(' ')}`);
    count += points.length;
  }
  return new TextEncoder().encode(`${text.join('\n')}\n`);
}

/** The sheet as a flat mesh. @param {Pick<import('../types.js').Unrolling, 'places' | 'triangles'>} sheet */
export function flatObj({ places, triangles }) {
  const lines = ['# a surface laid flat'];
  for (let i = 0; i < places.length; i += 2) lines.push(`v ${places[i]} ${places[i + 1]} 0`);
  // The file counts from 1.
  for (let i = 0; i < triangles.length; i += 3) {
    lines.push(`f ${triangles[i] + 1} ${triangles[i + 1] + 1} ${triangles[i + 2] + 1}`);
  }
  return new TextEncoder().encode(`${lines.join('\n')}\n`);
}
