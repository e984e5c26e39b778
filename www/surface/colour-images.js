/** Images of flat sheets in the colours of their strain, as pixels of a canvas; a pixel without a sheet is 0. */
import { COLOUR_SCALE_QUANTILE, divergingColour, magnitudeQuantile, toPixel } from './colours.js';
import { boxOf, fillTriangles } from './triangles.js';

/** Length of the longer side of a sheet's image, in pixels. */
const SHEET_SIDE_PIXELS = 1600;
/** Margin around a sheet in its image, in pixels. */
const SHEET_MARGIN_PIXELS = 24;
/** Colour of a sheet's outline. */
const OUTLINE_PIXEL = toPixel([90, 98, 106]);
/** Minimum strain at the end of the colour scale; a smaller one would show rounding errors. */
const MIN_STRAIN_RANGE = 1e-3;

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
  const { low: [left, bottom], high: [right, top] } = boxOf(places, 2);
  const extent = { width: right - left, height: top - bottom };
  const pixelsPerUnit = SHEET_SIDE_PIXELS / Math.max(extent.width, extent.height);
  const [width, height] = [extent.width, extent.height].map((side) => Math.max(1, Math.ceil(side * pixelsPerUnit)) + 2 * SHEET_MARGIN_PIXELS);
  const onImage = places.map((value, i) => SHEET_MARGIN_PIXELS + (i % 2 === 0 ? value - left : top - value) * pixelsPerUnit);
  const strains = Float64Array.from({ length: triangles.length / 3 }, (_, t) => triangleStrain(stretches, t));
  const maxStrain = Math.max(MIN_STRAIN_RANGE, magnitudeQuantile([strains], COLOUR_SCALE_QUANTILE));
  const colours = Uint32Array.from(strains, (strain) => toPixel(divergingColour(strain / maxStrain)));
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

/**
 * The singular values of each triangle's map from space to the plane, the larger one first.
 * @param {{ positions: Float64Array, places: Float64Array, triangles: Uint32Array }} mesh
 */
function principalStretches({ positions, places, triangles }) {
  const stretches = new Float64Array((2 * triangles.length) / 3);
  for (let t = 0; t < triangles.length; t += 3) {
    const [i, j, k] = triangles.subarray(t, t + 3);
    const edge = (/** @type {number} */ to) => [0, 1, 2].map((d) => positions[3 * to + d] - positions[3 * i + d]);
    const [e, f] = [edge(j), edge(k)];
    const [ax, ay, bx, by] = [j, k].flatMap((to) => [places[2 * to] - places[2 * i], places[2 * to + 1] - places[2 * i + 1]]);
    const dot = (/** @type {number[]} */ p, /** @type {number[]} */ q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    const [ee, ef, ff] = [dot(e, e), dot(e, f), dot(f, f)];
    const determinant = ee * ff - ef * ef;
    // Eigenvalues of the sheet's metric relative to the surface's metric: the squares of the singular values.
    const [p, q, r] = [ax * ax + ay * ay, ax * bx + ay * by, bx * bx + by * by];
    const half = (ff * p - 2 * ef * q + ee * r) / (2 * determinant);
    const root = Math.sqrt(Math.max(0, half * half - (p * r - q * q) / determinant));
    stretches[(2 * t) / 3] = determinant > 0 ? Math.sqrt(half + root) : 1;
    stretches[(2 * t) / 3 + 1] = determinant > 0 ? Math.sqrt(Math.max(0, half - root)) : 1;
  }
  return stretches;
}

/** A flat mesh coloured by strain. @param {{ positions: Float64Array, places: Float64Array, triangles: Uint32Array }} mesh */
export function meshStrainImage(mesh) {
  return sheetStrainImage(mesh.triangles, mesh.places, principalStretches(mesh));
}
