/** `developable occlusions`. */
import { crc32, deflateSync } from 'node:zlib';
import * as developable from '../index.js';
import { checkPlaces, writeWhole } from './files.js';
import { readInput } from './inputs.js';
import { print, succeed } from './terminal.js';

/**
 * Prints how many vertices there are, and writes where.
 * @param {import('./task.js').Task} task
 * @param {AbortSignal} signal
 */
export async function occlusions(task, signal) {
  await checkPlaces(...task.written);
  const input = await readInput(task);
  const { threshold, normalize, spacing } = task;
  const options = task.lattice !== 'square' ? { threshold, normalize } : { threshold, normalize, spacing };
  const { rows, cols, vertices, image, count } = await developable.occlusions(input, options);
  const flags = image ?? vertices;
  const width = 'width' in input && image ? input.width : cols;
  const height = 'height' in input && image ? input.height : rows;
  const bytes = task.extension === '.png'
    ? maskPng(width, height, flags)
    : await developable.writeNpy({ width, height, data: flags });
  await writeWhole([{ path: task.output, bytes }], signal);
  succeed(task.output, `${count} vertices where the surface is torn`);
  if (task.output !== '-') await print(`${count}\n`);
}

/**
 * An 8-bit grey PNG, white where the flag is set. The package's own PNGs are of heights, and keep
 * black for no data.
 * @param {number} width
 * @param {number} height
 * @param {Uint8Array} flags
 */
function maskPng(width, height, flags) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head[8] = 8;
  // Each row begins with its filter: none.
  const rows = Buffer.alloc(height * (width + 1));
  flags.forEach((flag, i) => (rows[i + Math.floor(i / width) + 1] = flag ? 255 : 0));
  const magic = Buffer.from('\x89PNG\r\n\x1a\n', 'latin1');
  return Buffer.concat([magic, chunk('IHDR', head), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

/**
 * @param {string} type
 * @param {Uint8Array} data
 */
function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const [length, check] = [Buffer.alloc(4), Buffer.alloc(4)];
  length.writeUInt32BE(data.length);
  check.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, check]);
}
