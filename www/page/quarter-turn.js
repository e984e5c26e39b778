/** Turns pictures by right angles. */

/** @typedef {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} Pixels RGBA */

/**
 * A picture turned clockwise.
 * @param {Pixels} picture
 * @param {number} quarters number of quarter turns
 * @returns {Pixels}
 */
export function turnPicture(picture, quarters) {
  if (quarters % 4 === 0) return picture;
  const { width, height, data } = picture;
  const from = new Uint32Array(data.buffer, data.byteOffset, width * height);
  const to = new Uint32Array(width * height);
  // One quarter turn moves the lower left pixel to the upper left.
  for (let row = 0; row < height; row++) {
    for (let col = 0; col < width; col++) to[col * height + height - 1 - row] = from[row * width + col];
  }
  return turnPicture({ width: height, height: width, data: new Uint8ClampedArray(to.buffer) }, quarters - 1);
}
