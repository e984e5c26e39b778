/** `developable info`: what is in a file. */
import { basename } from 'node:path';
import * as developable from '../index.js';
import { withFileName } from './explain.js';
import { readBytes } from './files.js';
import { assumptionsInWords, readMeshFile } from './inputs.js';
import { isMesh } from './task.js';
import { print } from './terminal.js';

/** @typedef {import('../types.js').ReadResult} ReadResult */

/** @param {import('./task.js').Task} task */
export async function info({ input, array }) {
  const bytes = await readBytes(input);
  const lines = await withFileName(input, async () => {
    const read = () => (isMesh(input) ? readMeshFile(input, bytes) : developable.read(bytes, { array, name: basename(input) }));
    const listed = isArchive(bytes) && !isMesh(input) && array === undefined ? arraysInWords(await developable.npzArrays(bytes)) : [];
    // Several arrays are listed, to choose one.
    const file = listed.length > 0 ? await read().catch(() => undefined) : await read();
    if (file === undefined) return listed;
    const told = 'positions' in file ? meshInWords(file) : imageInWords(file);
    return [...listed, ...told.slice(listed.length > 0 ? 1 : 0), ...assumptionsInWords(file).map((words) => ['assumed', words])];
  });
  await print(lines.map(([name, value]) => `${`${name}:`.padEnd(14)}${value}\n`).join(''));
}

/** Whether it is a ZIP archive whose first file is an array of NumPy: documents, X3P and 3MF are archives, too. @param {Uint8Array} bytes */
function isArchive(bytes) {
  const name = new TextDecoder().decode(bytes.subarray(30, 30 + bytes[26] + 256 * bytes[27]));
  return bytes[0] === 0x50 && bytes[1] === 0x4b && (name.endsWith('.npy') || bytes[2] === 5);
}

/** @param {import('../types.js').NpzArray[]} arrays */
function arraysInWords(arrays) {
  return [
    ['format', 'npz'],
    ...arrays.map(({ name, shape, dataType }) => ['array', `${name}, ${shape.join(' × ') || 'one value'}, ${dataType}`]),
  ];
}

/** @param {import('../types.js').Mesh} mesh */
function meshInWords({ positions, triangles, colors, uvs, textures = [], missing = [], unit }) {
  const ranges = ['x', 'y', 'z'].map((axis, k) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = k; i < positions.length; i += 3) {
      low = Math.min(low, positions[i]);
      high = Math.max(high, positions[i]);
    }
    return [axis, [low, high].map((end) => Number(end.toPrecision(15))).join(' to ')];
  });
  return [
    ['vertices', `${positions.length / 3}`],
    ['triangles', triangles.length === 0 ? 'none: a point cloud' : `${triangles.length / 3}`],
    ...ranges,
    ['unit', unit ?? 'not known'],
    ['colours', colors ? 'yes' : 'no'],
    ['texture', uvs ? `has coordinates, ${textures.length || 'no'} picture${textures.length === 1 ? '' : 's'}` : 'no coordinates'],
    ...missing.map((name) => ['missing', JSON.stringify(name)]),
  ];
}

/** @param {ReadResult} file */
function imageInWords({ format, width, height, data, dataType, pixelSize, unit, heightScale }) {
  let [low, high, missing] = [Infinity, -Infinity, 0];
  for (const value of data) {
    if (value < low) low = value;
    if (value > high) high = value;
    if (Number.isNaN(value)) missing += 1;
  }
  return [
    ['format', format],
    ['size', `${width} × ${height} pixels`],
    ['data type', dataType],
    ['values', low <= high ? `${low} to ${high}` : 'none'],
    ['no data', `${missing} pixels`],
    ['pixel size', unit === null ? `${pixelSize}` : `${pixelSize} ${unit}`],
    ['height scale', `${heightScale}`],
    ...(heightScale !== 1 && low <= high ? [['heights', [low, high].map((level) => Number((heightScale * level).toPrecision(6))).join(' to ')]] : []),
  ];
}
