/** Images of values in colour, as pixels of a canvas; a pixel without a value is 0. */
import { COLOUR_SCALE_QUANTILE, divergingPixel, logarithmicScale, magnitudeQuantile, toPixel } from './colours.js';
import { interpolateToGrid, nearestVertices } from './lattice.js';
import { principalStretches } from './assembly-mesh.js';
import { extentOf, fillTriangles } from './triangles.js';

/** @import {Grid, Lattice} from './lattice.js' */

/** Length of the longer side of a sheet's image, in pixels. */
const SHEET_SIDE_PIXELS = 1600;
/** Margin around a sheet in its image, in pixels. */
const SHEET_MARGIN_PIXELS = 24;
/** Colour of a sheet's outline. */
const OUTLINE_PIXEL = toPixel([90, 98, 106]);
/** Minimum strain at the end of the colour scale; a smaller one would show rounding errors. */
const MIN_STRAIN_RANGE = 1e-3;

/**
 * Values of a lattice on a logarithmic colour scale.
 * @param {Lattice} lattice
 * @param {ArrayLike<number>} values
 * @param {Grid} grid
 * @param {number} linearLimit value at which the linear part of the scale ends
 * @param {number} maximum value at the end of the scale
 */
export function valuePixels(lattice, values, grid, linearLimit, maximum) {
  const { place } = logarithmicScale(linearLimit, maximum);
  return Uint32Array.from(interpolateToGrid(lattice, values, grid), (value) => (Number.isNaN(value) ? 0 : divergingPixel(place(value))));
}

/**
 * Labels of a lattice, each in its colour.
 * @param {Lattice} lattice
 * @param {ArrayLike<number>} labels negative for none
 * @param {Grid} grid
 * @param {readonly number[]} colours of the labels
 */
export function labelPixels(lattice, labels, grid, colours) {
  return Uint32Array.from(nearestVertices(lattice, grid), (vertex) => {
    if (vertex < 0) return 0;
    // At the border the nearest vertex may have no label while a neighbour has one.
    const near = labels[vertex] >= 0 ? vertex : labels[vertex - 1] >= 0 ? vertex - 1 : vertex + 1;
    return labels[near] >= 0 ? colours[labels[near]] : 0;
  });
}

/**
 * The photo on a surface, or the colours of its vertices.
 * @param {Lattice} lattice
 * @param {{ image?: { width: number, height: number, data: Uint8ClampedArray }, uvs?: ArrayLike<number>, colors?: ArrayLike<number> }} seen
 *   `uvs`: places in the image, as shares of its width from the left and of its height from below; `colors`: from 0 to 1
 * @param {Grid} grid
 */
export function photoPixels(lattice, { image, uvs, colors }, grid) {
  const values = image && uvs ? uvs : colors ?? [];
  const channels = image && uvs ? 2 : 3;
  const count = lattice.rows * lattice.cols;
  const planes = Array.from({ length: channels }, (_, k) =>
    interpolateToGrid(lattice, Float64Array.from({ length: count }, (_, i) => values[channels * i + k]), grid));
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
 * The principal strain of larger magnitude of a triangle; positive where it is stretched.
 * @param {Float64Array} stretches singular values, two for each triangle
 * @param {number} t index of the triangle
 */
function triangleStrain(stretches, t) {
  const [large, small] = [stretches[2 * t] - 1, stretches[2 * t + 1] - 1];
  return Math.abs(large) >= Math.abs(small) ? large : small;
}

/**
 * A flat sheet coloured by strain, with an outline, and the strain of each pixel.
 * @param {Uint32Array} triangles
 * @param {Float64Array} places
 * @param {Float64Array} stretches singular values, two for each triangle
 */
export function sheetStrainImage(triangles, places, stretches) {
  const extent = extentOf(places);
  const pixelsPerUnit = SHEET_SIDE_PIXELS / Math.max(extent.width, extent.height);
  const [width, height] = [extent.width, extent.height].map((side) => Math.max(1, Math.ceil(side * pixelsPerUnit)) + 2 * SHEET_MARGIN_PIXELS);
  const onImage = places.map((value, i) => SHEET_MARGIN_PIXELS + (i % 2 === 0 ? value - extent.left : extent.top - value) * pixelsPerUnit);
  const strains = Float64Array.from({ length: triangles.length / 3 }, (_, t) => triangleStrain(stretches, t));
  const maxStrain = Math.max(MIN_STRAIN_RANGE, magnitudeQuantile([strains], COLOUR_SCALE_QUANTILE));
  const colours = Uint32Array.from(strains, (strain) => divergingPixel(strain / maxStrain));
  const pixels = new Uint32Array(width * height);
  const values = new Float32Array(width * height).fill(NaN);
  fillTriangles({ width, height }, triangles, onImage, (pixel, triangle) => {
    pixels[pixel] = colours[triangle];
    values[pixel] = strains[triangle];
  });
  drawOutline(pixels, width);
  return { width, height, pixels, values, maxStrain, extent, pixelsPerUnit };
}

/** Draws a line where the pixels of an image end. @param {Uint32Array} pixels with empty ones along the border @param {number} width */
function drawOutline(pixels, width) {
  const filled = pixels.slice();
  for (let i = 0; i < filled.length; i++) {
    if (filled[i] === 0) continue;
    for (const step of [-1, 1, -width, width]) if (filled[i + step] === 0) pixels[i] = pixels[i + step] = OUTLINE_PIXEL;
  }
}

/** A flat mesh coloured by strain. @param {{ positions: Float64Array, places: Float64Array, triangles: Uint32Array }} mesh */
export function meshStrainImage(mesh) {
  return sheetStrainImage(mesh.triangles, mesh.places, principalStretches(mesh));
}
