/** Small pictures of heights, lit from the upper left. */

/** Pixels along the longer side of heights that a small picture shows, and the duality gap at which their solve stops. */
export const THUMBNAIL_SIDE_PIXELS = 120;
export const THUMBNAIL_GAP = 0.05;
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
  const image = context.createImageData(width, height);
  for (let i = 0; i < width * height; i++) {
    const [z, col] = [data[i], i % width];
    if (Number.isNaN(z)) continue;
    const x = -slope * difference(col > 0 ? data[i - 1] : NaN, z, col + 1 < width ? data[i + 1] : NaN);
    const y = -slope * difference(data[i + width] ?? NaN, z, data[i - width] ?? NaN);
    const light = (x * LIGHT_DIRECTION[0] + y * LIGHT_DIRECTION[1] + LIGHT_DIRECTION[2]) / Math.hypot(x, y, 1);
    const grey = 40 + 205 * Math.max(0, light) ** 1.3;
    image.data.set([grey * 0.94, grey * 0.97, grey, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
}

/** The difference between neighbours, one-sided beside NaN. @param {number} before @param {number} here @param {number} after */
function difference(before, here, after) {
  if (Number.isNaN(before)) return Number.isNaN(after) ? 0 : after - here;
  return Number.isNaN(after) ? here - before : (after - before) / 2;
}
