/** Files of heights and meshes. */
import { crc32, deflateSync } from 'node:zlib';
import { zipSync } from 'fflate';
import { init, load, read, writeImage, writePly } from '../../../pkg/direct.js';

await init();
await load('files', 'meshes');

/** @typedef {{ name: string, bytes: Buffer }} File */

/**
 * @param {number} width
 * @param {number} height
 * @param {(col: number, row: number) => number} value
 * @returns {number[]} row by row
 */
export function grid(width, height, value) {
  return Array.from({ length: width * height }, (_, i) => value(i % width, Math.floor(i / width)));
}

/** NPY of 64-bit floats. @param {number} width @param {number[]} values */
export const npy = (width, values) => Buffer.from(writeImage({ width, height: values.length / width, data: values }));

/**
 * The values of an NPY of 64-bit floats.
 * @param {Buffer} bytes
 */
export function parseNpy(bytes) {
  const { format, dataType, height: rows, width: cols, data } = read(bytes, { assumeNoData: false });
  if (format !== 'npy' || dataType !== 'f64') throw new Error(`not 64-bit floats: ${format} of ${dataType}`);
  return { rows, cols, values: Array.from(data) };
}

/**
 * A 16-bit grey PNG.
 * @param {number} width
 * @param {number[]} values from 0 to 65535
 */
export function png16(width, values) {
  const height = values.length / width;
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  // 16 bits of grey.
  head.set([16, 0], 8);
  // Each row begins with its filter: none.
  const rows = Buffer.alloc(height * (1 + 2 * width));
  values.forEach((value, i) => {
    const [row, col] = [Math.floor(i / width), i % width];
    rows.writeUInt16BE(value, row * (1 + 2 * width) + 1 + 2 * col);
  });
  return Buffer.concat([
    Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'),
    chunk('IHDR', head), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0)),
  ]);
}

/** @param {string} type @param {Buffer} data */
export function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const length = Buffer.alloc(4);
  length.writeUInt32BE(data.length);
  const check = Buffer.alloc(4);
  check.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, check]);
}

/** NPZ: a ZIP of stored NPY files. @param {Record<string, Buffer>} arrays */
export const npz = (arrays) =>
  Buffer.from(zipSync(Object.fromEntries(Object.entries(arrays).map(([name, bytes]) => [`${name}.npy`, bytes])), { level: 0 }));

/** @typedef {{ points: (readonly [number, number, number])[], triangles: (readonly [number, number, number])[] }} Mesh */

/** Wavefront OBJ. @param {Mesh} mesh */
export function obj({ points, triangles }) {
  const lines = [
    ...points.map((point) => `v ${point.join(' ')}`),
    ...triangles.map((corners) => `f ${corners.map((corner) => corner + 1).join(' ')}`),
  ];
  return Buffer.from(`${lines.join('\n')}\n`);
}

/** PLY. @param {Mesh} mesh */
export const ply = ({ points, triangles }) => Buffer.from(writePly({ positions: Float64Array.from(points.flat()), triangles: Uint32Array.from(triangles.flat()) }));

/** Two triangles that lean. */
export const ramp = obj({ points: [[0, 0, 0], [3, 0, 0], [3, 2, 1], [0, 2, 1]], triangles: [[0, 1, 2], [0, 2, 3]] });

/** An OBJ without the vertex that a triangle names. */
export const tornObj = Buffer.from('v 0 0 0\nv 1 0\nf 1 2 9\n');
