/** Small pictures of heights, lit from the upper left. */
import { NO_NORMAL, normalsOf, NORMAL_SCALE } from './normals.js';

/** Unit vector to the light, y up. */
const LIGHT_DIRECTION = [-0.5, 0.55, 0.67];

/**
 * Draws the left half of one picture and the right half of another.
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLCanvasElement} before
 * @param {HTMLCanvasElement} after of the same size
 */
export function drawHalves(canvas, before, after) {
  const { width, height } = before;
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d');
  if (!context) return;
  const half = Math.floor(width / 2);
  context.drawImage(before, 0, 0, half, height, 0, 0, half, height);
  context.drawImage(after, half, 0, width - half, height, half, 0, width - half, height);
  context.fillStyle = '#4a90c2';
  context.fillRect(half, 0, 1, height);
}

/**
 * Draws shaded heights.
 * @param {HTMLCanvasElement} canvas gets the size of the heights
 * @param {{ width: number, height: number, data: ArrayLike<number> }} heights
 * @param {number} slope unit of the heights over the side of a pixel
 */
export function drawThumbnail(canvas, { width, height, data }, slope) {
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d');
  if (!context) return;
  const { xy } = normalsOf(Float64Array.from(data), width, height, slope);
  const image = context.createImageData(width, height);
  for (let i = 0; i < width * height; i++) {
    if (xy[2 * i] === NO_NORMAL) continue;
    const [x, y] = [xy[2 * i] / NORMAL_SCALE, xy[2 * i + 1] / NORMAL_SCALE];
    const light = x * LIGHT_DIRECTION[0] + y * LIGHT_DIRECTION[1] + Math.sqrt(Math.max(0, 1 - x * x - y * y)) * LIGHT_DIRECTION[2];
    const grey = 40 + 205 * Math.max(0, light) ** 1.3;
    image.data.set([grey * 0.94, grey * 0.97, grey, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
}
