/** Heights in space: their surface, bounding box, and the height at a place. */
import { sortedSample } from './colours.js';
import { downsample } from './downsampling.js';
import { gridOf } from './lattice.js';

/** @import {Box, Surface} from './scene.js' */

/** @typedef {{ width: number, height: number, heights: ArrayLike<number>, heightScale: number, extent: { left: number, top: number, width: number, height: number } }} Relief heights row by row, NaN for no data; `heightScale`: unit of length for each of theirs; `extent` in that unit */

/**
 * Maximum number of vertices along a side of a drawn surface: about the pixels of a screen. Without a graphics card the processor
 * draws six times fewer, so that a picture takes about a fifth of a second.
 */
const MAX_SIDE_VERTICES = 512;
const MAX_SLOW_SIDE_VERTICES = 200;
/** Quantile of the heights at the top of the box; the bottom is at the opposite quantile. */
const BOX_HEIGHT_SHARE = 0.998;

/**
 * The surface of an image of heights on the grid of an input.
 * @param {Input} input
 * @param {{ width: number, height: number, data: ArrayLike<number> }} image
 * @param {number} heightScale
 * @returns {Relief}
 */
export function reliefOf(input, { width, height, data }, heightScale) {
  const grid = gridOf(input);
  const extent = { left: grid.left, top: grid.top, width: grid.width * grid.pixelSize, height: grid.height * grid.pixelSize };
  return { width, height, heights: data, heightScale, extent };
}

/** The height at a place of the plane, NaN outside. @param {Relief} relief @param {number} x @param {number} y */
export function heightAt({ width, height, heights, heightScale, extent }, x, y) {
  const col = Math.floor(((x - extent.left) / extent.width) * width);
  const row = Math.floor(((extent.top - y) / extent.height) * height);
  if (col < 0 || row < 0 || col >= width || row >= height) return NaN;
  return heights[row * width + col] * heightScale;
}

/**
 * The mesh of heights, of the means of blocks if there are too many; null if no three of them are neighbours.
 * @param {Relief} relief
 * @param {boolean} [isFast] whether there is a graphics card
 * @returns {Surface | null}
 */
export function reliefMesh({ width, height, heights, heightScale, extent }, isFast = true) {
  const [image, most] = [{ width, height, data: heights }, isFast ? MAX_SIDE_VERTICES : MAX_SLOW_SIDE_VERTICES];
  const { width: cols, height: rows, data } = Math.max(width, height) > most ? downsample(image, most) : image;
  const positions = new Float64Array(3 * cols * rows);
  const isHole = new Uint8Array(cols * rows);
  const triangles = new Uint32Array(6 * (cols - 1) * (rows - 1));
  // Holes are no higher or lower than the heights, so that the view fits these.
  let filling = 0;
  for (let i = 0; i < data.length && Number.isNaN((filling = data[i] * heightScale)); i++);
  let corners = 0;
  /** @param {number} a @param {number} b @param {number} c */
  const add = (a, b, c) => {
    if (isHole[a] || isHole[b] || isHole[c]) return;
    triangles[corners++] = a;
    triangles[corners++] = b;
    triangles[corners++] = c;
  };
  for (let row = 0, i = 0; row < rows; row++) {
    for (let col = 0; col < cols; col++, i++) {
      const z = data[i] * heightScale;
      isHole[i] = Number(Number.isNaN(z));
      positions[3 * i] = extent.left + ((col + 0.5) / cols) * extent.width;
      positions[3 * i + 1] = extent.top - ((row + 0.5) / rows) * extent.height;
      positions[3 * i + 2] = isHole[i] ? filling : z;
      if (row === 0 || col === 0) continue;
      add(i - cols - 1, i - 1, i - cols);
      add(i - cols, i - 1, i);
    }
  }
  return corners > 0 ? { positions, triangles: triangles.subarray(0, corners) } : null;
}

/** The bounding box of an input's heights without outliers, which would make the rest small. @param {Input} input @returns {Box} */
export function heightfieldBox(input) {
  const { width, height, pixelSize, left, top } = gridOf(input);
  const sorted = sortedSample([input.data], (value) => value * input.heightScale);
  const most = sorted.length - 1;
  const [low, high] = [sorted[Math.ceil((1 - BOX_HEIGHT_SHARE) * most)] ?? 0, sorted[Math.floor(BOX_HEIGHT_SHARE * most)] ?? 0];
  return { low: [left, top - height * pixelSize, low], high: [left + width * pixelSize, top, high] };
}
