/** Pictures as pixels. */

/**
 * Whatever pictures the browser knows.
 * @param {File} file
 */
export async function pixelsOf(file) {
  const bitmap = await createImageBitmap(file).catch(() => {
    throw new Error('it is no picture that this browser can read');
  });
  const pixels = drawn(bitmap, bitmap.width, bitmap.height);
  bitmap.close();
  return pixels;
}

/**
 * @param {ImageBitmap} bitmap
 * @param {number} wide what the whole picture is drawn to
 * @param {number} high
 * @returns {ImageData} of whole pixels, so that both directions have the same scale
 */
export function drawn(bitmap, wide, high) {
  const [width, height] = [Math.floor(wide), Math.floor(high)];
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) throw new Error('the browser gives no canvas of that size');
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, wide, high);
  return context.getImageData(0, 0, width, height);
}
