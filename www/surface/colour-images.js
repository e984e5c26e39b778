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
  // The principal strain of larger magnitude, positive where a triangle is stretched.
  const strains = Float64Array.from({ length: triangles.length / 3 }, (_, t) => {
    const [large, small] = [stretches[2 * t] - 1, stretches[2 * t + 1] - 1];
    return Math.abs(large) >= Math.abs(small) ? large : small;
  });
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
