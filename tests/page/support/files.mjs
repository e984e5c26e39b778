/** Files of heights and meshes. */
import { crc32, deflateSync } from 'node:zlib';
import { init, load, writeImage, writePly } from '../../../pkg/direct.js';

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
  if (bytes.toString('latin1', 0, 6) !== '\x93NUMPY') throw new Error('no NPY magic');
  const length = bytes[6] === 1 ? bytes.readUInt16LE(8) : bytes.readUInt32LE(8);
  const start = bytes[6] === 1 ? 10 : 12;
  const header = bytes.toString('latin1', start, start + length);
  if (!header.includes("'<f8'")) throw new Error(`not 64-bit floats: ${header}`);
  const [, rows, cols] = /\((\d+),\s*(\d+)[,\s]*\)/.exec(header) ?? [];
  const data = bytes.subarray(start + length);
  const values = Array.from({ length: data.length / 8 }, (_, i) => data.readDoubleLE(8 * i));
  return { rows: Number(rows), cols: Number(cols), values };
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

/**
 * NPZ: a ZIP of stored NPY files.
 * @param {Record<string, Buffer>} arrays
 */
export function npz(arrays) {
  const bodies = [];
  const directory = [];
  let offset = 0;
  for (const [name, bytes] of Object.entries(arrays)) {
    const path = Buffer.from(`${name}.npy`);
    const common = Buffer.alloc(26);
    // Version 2, no flags, stored, no time.
    common.writeUInt16LE(20, 0);
    common.writeUInt32LE(crc32(bytes), 10);
    common.writeUInt32LE(bytes.length, 14);
    common.writeUInt32LE(bytes.length, 18);
    common.writeUInt16LE(path.length, 22);
    const body = Buffer.concat([Buffer.from('PK\x03\x04'), common, path, bytes]);
    const tail = Buffer.alloc(14);
    tail.writeUInt32LE(offset, 10);
    directory.push(Buffer.from('PK\x01\x02\x14\x00', 'latin1'), common, tail, path);
    bodies.push(body);
    offset += body.length;
  }
  const entries = Buffer.concat(directory);
  const end = Buffer.alloc(18);
  end.writeUInt16LE(bodies.length, 4);
  end.writeUInt16LE(bodies.length, 6);
  end.writeUInt32LE(entries.length, 8);
  end.writeUInt32LE(offset, 12);
  return Buffer.concat([...bodies, entries, Buffer.from('PK\x05\x06'), end]);
}

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
