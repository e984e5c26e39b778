/** Coordinates of one picture at several resolutions. */

/**
 * Converts a pixel coordinate to that of the same image at another scale. Coordinate 0 is the centre of the first pixel.
 * @param {number} coordinate
 * @param {number} scale new pixels per old pixel
 */
export function rescalePixel(coordinate, scale) {
  return (coordinate + 0.5) * scale - 0.5;
}
