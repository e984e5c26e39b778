/** Marked pixels on top of a surface. */

/**
 * @typedef {object} PixelMarks
 * @property {number} width
 * @property {number} height
 * @property {ArrayLike<number> & Iterable<number>} pixels
 * @property {string} colour
 */

/** Minimum side of a mark in CSS pixels, so that a single one is visible. */
const MIN_MARK_SIDE_PIXELS = 4;

/**
 * Draws marks on a canvas of the size that the surface has on the screen.
 * @param {readonly PixelMarks[]} marks
 * @param {number} width
 * @param {number} height
 * @param {number} ratio device pixels per CSS pixel
 */
export function drawMarks(marks, width, height, ratio) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d');
  if (!context) return canvas;
  for (const { width: cols, height: rows, pixels, colour } of marks) {
    context.fillStyle = colour;
    const [across, down] = [width / cols, height / rows];
    const [w, h] = [Math.max(across, MIN_MARK_SIDE_PIXELS * ratio), Math.max(down, MIN_MARK_SIDE_PIXELS * ratio)];
    for (const i of pixels) {
      const [x, y] = [(i % cols + 0.5) * across, (Math.floor(i / cols) + 0.5) * down];
      context.fillRect(x - w / 2, y - h / 2, w, h);
    }
  }
  return canvas;
}
