/** What views show as colours: pixels as the canvas' bytes, 0 where there is nothing. */
import { divergingPixel, logarithmic, magnitude } from './colours.js';
import { interpolated, nearest } from './lattice.js';
import { assembled, stretchesOf } from './assembled.js';
import { extentOf, fillTriangles } from './triangles.js';
import { strainOf } from './unfolding.js';

/** @import {Grid, Lattice} from './lattice.js' */

/** Pixels along the longer side of a sheet. */
const SHEET = 1600;
/** Of these, along both sides, for each one whose strain can be read. */
const READ = 4;
/** Strain below which colours would only show rounding. */
const FAINTEST = 1e-3;

/**
 * Values on a logarithmic scale.
 * @param {Lattice} lattice
 * @param {ArrayLike<number>} values
 * @param {Grid} grid
 * @param {number} knee
 * @param {number} most
 */
export function valuePixels(lattice, values, grid, knee, most) {
  const { place } = logarithmic(knee, most);
  return Uint32Array.from(interpolated(lattice, values, grid), (value) => (Number.isNaN(value) ? 0 : divergingPixel(place(value))));
}

/**
 * @param {Lattice} lattice
 * @param {ArrayLike<number>} labels below 0 for none
 * @param {Grid} grid
 * @param {readonly number[]} colours of the labels
 */
export function labelPixels(lattice, labels, grid, colours) {
  return Uint32Array.from(nearest(lattice, grid), (vertex) => {
    if (vertex < 0) return 0;
    // At the border the nearest vertex may lie beyond it, and one beside it does not.
    const near = labels[vertex] >= 0 ? vertex : labels[vertex - 1] >= 0 ? vertex - 1 : vertex + 1;
    return labels[near] >= 0 ? colours[labels[near]] : 0;
  });
}

/**
 * The photo that shows a surface, or colours of its vertices.
 * @param {Lattice} lattice
 * @param {{ image?: { width: number, height: number, data: Uint8ClampedArray }, uvs?: ArrayLike<number>, colors?: ArrayLike<number> }} seen
 *   `uvs`: places in the image as shares from the left and from below; `colors`: from 0 to 1
 * @param {Grid} grid
 */
export function photoPixels(lattice, { image, uvs, colors }, grid) {
  const values = image && uvs ? uvs : colors ?? [];
  const channels = image && uvs ? 2 : 3;
  const count = lattice.rows * lattice.cols;
  const planes = Array.from({ length: channels }, (_, k) =>
    interpolated(lattice, Float64Array.from({ length: count }, (_, i) => values[channels * i + k]), grid));
  const out = new Uint8ClampedArray(4 * grid.width * grid.height);
  for (let i = 0; i < grid.width * grid.height; i++) {
    const place = planes.map((plane) => plane[i]);
    if (place.some(Number.isNaN)) continue;
    out[4 * i + 3] = 255;
    if (image) {
      const col = Math.min(image.width - 1, Math.max(0, Math.floor(place[0] * image.width)));
      const row = Math.min(image.height - 1, Math.max(0, Math.floor((1 - place[1]) * image.height)));
      for (let k = 0; k < 3; k++) out[4 * i + k] = image.data[4 * (row * image.width + col) + k];
    } else for (let k = 0; k < 3; k++) out[4 * i + k] = 255 * place[k];
  }
  return new Uint32Array(out.buffer);
}

/**
 * A sheet in colours of its strain.
 * @param {Uint32Array} triangles
 * @param {Float64Array} places
 * @param {Float64Array} stretches
 */
export function sheetPixels(triangles, places, stretches) {
  const strains = Float64Array.from({ length: triangles.length / 3 }, (_, t) => strainOf(stretches, t));
  const most = Math.max(FAINTEST, magnitude([strains], 0.99));
  const extent = extentOf(places);
  const dots = SHEET / Math.max(extent.width, extent.height);
  const [width, height] = [Math.max(1, Math.ceil(extent.width * dots)), Math.max(1, Math.ceil(extent.height * dots))];
  const onImage = places.map((value, i) => (i % 2 === 0 ? value - extent.left : extent.top - value) * dots);
  const pixels = new Uint32Array(width * height);
  const colours = Uint32Array.from(strains, (strain) => divergingPixel(strain / most));
  fillTriangles({ width, height }, triangles, onImage, (pixel, triangle) => (pixels[pixel] = colours[triangle]));
  const read = { width: Math.ceil(width / READ), height: Math.ceil(height / READ), strains: new Float32Array(0) };
  read.strains = new Float32Array(read.width * read.height).fill(NaN);
  fillTriangles(read, triangles, onImage.map((value) => value / READ), (pixel, triangle) => (read.strains[pixel] = strains[triangle]));
  return { extent, most, width, height, pixels, read };
}

/** The same of a mesh laid flat. @param {{ positions: Float64Array, places: Float64Array, triangles: Uint32Array }} mesh */
export function flatPixels(mesh) {
  return sheetPixels(mesh.triangles, mesh.places, stretchesOf(mesh));
}

/**
 * The strain of a drawing's sheets, in colours and as numbers, at its places.
 * @param {Uint8Array} model the drawing's assembly, in metres
 * @param {{ width: number, height: number, bounds: readonly (readonly [readonly [number, number], readonly [number, number]])[] }} drawing
 *   in millimetres, `bounds` those of its sheets
 */
export function drawnStrains(model, { width: wide, height: high, bounds }) {
  const { places, triangles, sheets, stretches } = assembled(model, 1 / 1000);
  const middles = bounds.map(() => [Infinity, Infinity, -Infinity, -Infinity]);
  sheets.forEach((sheet, i) => {
    const [x, y, box] = [places[2 * i], places[2 * i + 1], middles[sheet]];
    middles[sheet] = [Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y)];
  });
  const dots = SHEET / Math.max(wide, high);
  const [width, height] = [Math.ceil(wide * dots), Math.ceil(high * dots)];
  const onImage = places.map((value, i) => {
    const [k, box, [low, most]] = [i % 2, middles[sheets[i >> 1]], bounds[sheets[i >> 1]]];
    const place = value + (low[k] + most[k] - box[k] - box[k + 2]) / 2;
    return (k === 0 ? place : high - place) * dots;
  });
  const strains = Float64Array.from({ length: triangles.length / 3 }, (_, t) => strainOf(stretches, t));
  const most = Math.max(FAINTEST, magnitude([strains], 0.99));
  const colours = Uint32Array.from(strains, (strain) => divergingPixel(strain / most));
  const pixels = new Uint32Array(width * height);
  const values = new Float32Array(width * height).fill(NaN);
  fillTriangles({ width, height }, triangles, onImage, (pixel, triangle) => {
    pixels[pixel] = colours[triangle];
    values[pixel] = strains[triangle];
  });
  return { width, height, pixels, values, most };
}
