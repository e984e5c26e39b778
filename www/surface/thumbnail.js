/** A small picture of heights, lit from the upper left. */
import { HOLE, normalsOf, UNIT } from './normals.js';

const LIGHT = [-0.5, 0.55, 0.67];
/** Pixels along a side of a picture of two: twice what it is shown with, for lines of text are fine. */
const BESIDE = 224;

/**
 * One surface on the left half of a picture, and another on the right half.
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLCanvasElement} before
 * @param {HTMLCanvasElement} after as large
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
 * Two whole pictures beside each other.
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLCanvasElement | HTMLImageElement} before
 * @param {HTMLCanvasElement | HTMLImageElement} after
 */
export function drawBeside(canvas, before, after) {
  Object.assign(canvas, { width: BESIDE, height: BESIDE });
  const context = canvas.getContext('2d');
  if (!context) return;
  const half = BESIDE / 2;
  context.fillStyle = '#fff';
  context.fillRect(half, 0, half, BESIDE);
  [before, after].forEach((picture, side) => {
    const scale = Math.min(half / picture.width, BESIDE / picture.height);
    const [width, height] = [scale * picture.width, scale * picture.height];
    context.drawImage(picture, side * half + (half - width) / 2, (BESIDE - height) / 2, width, height);
  });
  context.fillStyle = '#4a90c2';
  context.fillRect(half - 1, 0, 2, BESIDE);
}

/**
 * @param {HTMLCanvasElement} canvas becomes as large as the heights
 * @param {{ width: number, height: number, data: ArrayLike<number> }} heights
 * @param {number} slope height of a step over the side of a pixel
 */
export function drawThumbnail(canvas, { width, height, data }, slope) {
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d');
  if (!context) return;
  const { xy } = normalsOf(Float64Array.from(data), width, height, slope);
  const image = context.createImageData(width, height);
  for (let i = 0; i < width * height; i++) {
    if (xy[2 * i] === HOLE) continue;
    const [x, y] = [xy[2 * i] / UNIT, xy[2 * i + 1] / UNIT];
    const light = x * LIGHT[0] + y * LIGHT[1] + Math.sqrt(Math.max(0, 1 - x * x - y * y)) * LIGHT[2];
    const grey = 40 + 205 * Math.max(0, light) ** 1.3;
    image.data.set([grey * 0.94, grey * 0.97, grey, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
}
