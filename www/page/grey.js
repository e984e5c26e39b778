/** The reduced grey image of a photo in which edges are traced. */

/**
 * @typedef {object} GreyImage
 * @property {number} width
 * @property {number} height
 * @property {number} scale pixels of the grey image per pixel of the photo
 * @property {Float32Array} data brightness from 0 to 255
 */

/**
 * Converts a reduced photo to grey (ITU-R BT.601 luma).
 * @param {{ width: number, height: number, data: Uint8ClampedArray }} pixels RGBA
 * @param {number} scale pixels of the grey image per pixel of the photo
 * @returns {GreyImage}
 */
export function toGrey({ width, height, data }, scale) {
  const grey = new Float32Array(width * height);
  for (let i = 0; i < grey.length; i++) grey[i] = 0.299 * data[4 * i] + 0.587 * data[4 * i + 1] + 0.114 * data[4 * i + 2];
  return { width, height, scale, data: grey };
}

/**
 * Brightness at a place, bilinear between pixel centres; outside the image that of the nearest border pixel.
 * @param {GreyImage} grey
 * @param {number} x in pixels of the grey image
 * @param {number} y
 */
export function brightnessAt({ width, height, data }, x, y) {
  const u = Math.min(Math.max(x, 0), width - 1);
  const v = Math.min(Math.max(y, 0), height - 1);
  const [i, j] = [Math.min(Math.floor(u), width - 2), Math.min(Math.floor(v), height - 2)];
  const [a, b] = [u - i, v - j];
  const at = j * width + i;
  return (1 - b) * ((1 - a) * data[at] + a * data[at + 1]) + b * ((1 - a) * data[at + width] + a * data[at + width + 1]);
}

/**
 * Converts a pixel coordinate to that of the same image at another scale. Coordinate 0 is the centre of the first pixel.
 * @param {number} coordinate
 * @param {number} scale new pixels per old pixel
 */
export function rescalePixel(coordinate, scale) {
  return (coordinate + 0.5) * scale - 0.5;
}
