/** A photo in grey, reduced, in which edges are looked for. */

/**
 * @typedef {object} Grey
 * @property {number} width
 * @property {number} height
 * @property {number} scale its pixels for one of the photo
 * @property {Float32Array} data brightness from 0 to 255
 */

/**
 * @param {{ width: number, height: number, data: Uint8ClampedArray }} pixels RGBA
 * @param {number} scale
 * @returns {Grey}
 */
export function greyOf({ width, height, data }, scale) {
  const grey = new Float32Array(width * height);
  for (let i = 0; i < grey.length; i++) grey[i] = 0.299 * data[4 * i] + 0.587 * data[4 * i + 1] + 0.114 * data[4 * i + 2];
  return { width, height, scale, data: grey };
}

/**
 * Brightness between pixels, of the nearest one outside.
 * @param {Grey} grey
 * @param {number} x in pixels of the grey picture
 * @param {number} y
 */
export function brightness({ width, height, data }, x, y) {
  const u = Math.min(Math.max(x, 0), width - 1);
  const v = Math.min(Math.max(y, 0), height - 1);
  const [i, j] = [Math.min(Math.floor(u), width - 2), Math.min(Math.floor(v), height - 2)];
  const [a, b] = [u - i, v - j];
  const at = j * width + i;
  return (1 - b) * ((1 - a) * data[at] + a * data[at + 1]) + b * ((1 - a) * data[at + width] + a * data[at + width + 1]);
}

/**
 * From pixels of a photo to those of the same one at another scale: centres of pixels stay what they are.
 * @param {number} at
 * @param {number} scale
 */
export function rescaled(at, scale) {
  return (at + 0.5) * scale - 0.5;
}
