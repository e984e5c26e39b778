/** Pixels that are marked on top of a surface. */

/**
 * @typedef {object} Marks
 * @property {number} width
 * @property {number} height
 * @property {ArrayLike<number> & Iterable<number>} pixels
 * @property {string} colour
 */

/** Least side of a mark, in pixels of the page: a single one is still seen. */
const LEAST = 4;

/**
 * All marks on a canvas of the surface's size on the screen.
 * @param {readonly Marks[]} marks
 * @param {number} width
 * @param {number} height
 * @param {number} ratio pixels of the screen for one of the page
 */
export function markedCanvas(marks, width, height, ratio) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d');
  if (!context) return canvas;
  for (const { width: cols, height: rows, pixels, colour } of marks) {
    context.fillStyle = colour;
    const [across, down] = [width / cols, height / rows];
    const [w, h] = [Math.max(across, LEAST * ratio), Math.max(down, LEAST * ratio)];
    for (const i of pixels) {
      const [x, y] = [(i % cols + 0.5) * across, (Math.floor(i / cols) + 0.5) * down];
      context.fillRect(x - w / 2, y - h / 2, w, h);
    }
  }
  return canvas;
}
