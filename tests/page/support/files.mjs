/** Height files written here, byte by byte, so that the page's readers are not tested with its own writers. */
import { deflateSync } from 'node:zlib';

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

/**
 * NPY, version 1, little-endian 64-bit floats.
 * @param {number} width
 * @param {number[]} values
 */
export function npy(width, values) {
  const shape = `(${values.length / width}, ${width})`;
  const text = `{'descr': '<f8', 'fortran_order': False, 'shape': ${shape}, }`;
  const header = text.padEnd(Math.ceil((text.length + 11) / 64) * 64 - 11) + '\n';
  const length = Buffer.alloc(2);
  length.writeUInt16LE(header.length);
  return Buffer.concat([
    Buffer.from('\x93NUMPY\x01\x00', 'latin1'), length, Buffer.from(header, 'latin1'),
    Buffer.from(Float64Array.from(values).buffer),
  ]);
}

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
function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const length = Buffer.alloc(4);
  length.writeUInt32BE(data.length);
  const check = Buffer.alloc(4);
  check.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, check]);
}

/** @param {Buffer} bytes */
function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}
