/** Flat images and their warp maps in files. */
import { basename, extname } from 'node:path';
import * as developable from '../index.js';

/**
 * @typedef {Pick<import('../types.js').Dewarped, 'width' | 'height' | 'resolution' | 'corner' | 'map' | 'grid'> &
 *   { unit?: string }} WarpMap
 */

/**
 * A flat image in a file of the kind that its name says.
 * @param {{ extension: string, quality?: number, output?: string }} task
 * @param {import('../types.js').SizedPhoto} flat
 */
export function printed({ extension, quality, output }, flat) {
  const formats = /** @type {const} */ ({ '.png': 'png', '.pdf': 'pdf', '.jpg': 'jpeg', '.jpeg': 'jpeg' });
  return developable.writePhoto(flat, { format: formats[/** @type {keyof typeof formats} */ (extension)], quality, title: titleOf(output), transfer: true });
}

/** The title of a document: the name of its file; none on standard output. @param {string} [path] */
export function titleOf(path = '-') {
  return path === '-' ? undefined : basename(path, extname(path));
}

/** The size of a flat image. @param {import('../types.js').SizedPhoto} flat */
export function sizeInWords({ width, height, resolution = 1, unit }) {
  const size = [width, height].map((pixels) => Number((pixels / resolution).toPrecision(4)));
  const lengths = unit === 'mm' || unit === 'm' ? `, ${size.join(' × ')} ${unit}` : '';
  return `${width} × ${height} pixels${lengths}`;
}

/** Returns which form of the warp map its file takes: an NPY file the whole map, a JSON file a grid. @param {string} [path] */
export function mapOptions(path) {
  const full = path?.toLowerCase().endsWith('.npy') === true;
  return { map: full, grid: path !== undefined && !full };
}

/**
 * @param {WarpMap} flat
 * @param {{ width: number, height: number }} photo
 */
export function mapFile(flat, photo) {
  return flat.grid === undefined ? mapNpy(flat) : mapJson(flat, flat.grid, photo);
}

/** The warp map as a NumPy array of shape (height, width, 2). @param {WarpMap} flat */
function mapNpy({ width, height, map }) {
  const text = `{'descr': '<f4', 'fortran_order': False, 'shape': (${height}, ${width}, 2), }`;
  // The data begin at a multiple of 64 bytes, after a line break.
  const length = Math.ceil((10 + text.length + 1) / 64) * 64 - 10;
  const head = Buffer.from(`\x93NUMPY\x01\x00\0\0${text.padEnd(length - 1)}\n`, 'latin1');
  head.writeUInt16LE(length, 8);
  const data = Buffer.alloc(4 * map.length);
  map.forEach((value, i) => data.writeFloatLE(value, 4 * i));
  return Buffer.concat([head, data]);
}

/**
 * The map on a grid as JSON, null where there is no sheet.
 * @param {WarpMap} flat
 * @param {import('../types.js').WarpGrid} grid
 * @param {{ width: number, height: number }} photo
 */
function mapJson({ width, height, resolution, unit, corner }, { columns, rows, step, places, rms, maximum }, photo) {
  const rounded = (/** @type {number} */ value) => Math.round(1000 * value) / 1000;
  const file = {
    width,
    height,
    photo: { width: photo.width, height: photo.height },
    resolution,
    unit: unit ?? null,
    corner,
    error: { rms, maximum },
    columns,
    rows,
    origin: [0, 0],
    step,
    places: Array.from({ length: columns * rows }, (_, i) =>
      (Number.isNaN(places[2 * i]) ? null : [rounded(places[2 * i]), rounded(places[2 * i + 1])])),
  };
  return new TextEncoder().encode(`${JSON.stringify(file)}\n`);
}
