/** Which of the two wasm files for images reads a file: the smaller one knows few formats, and the other one all others. */

/** First bytes of a PNG, NPY and JPEG file, as Latin-1. */
const [PNG, NPY, JPEG] = ['\x89PNG\r\n\x1a\n', '\x93NUMPY', '\xff\xd8\xff'];

/** Whether the smaller wasm file reads and writes a format of heights. @param {unknown} format */
export const isBasic = (format) => format === 'png' || format === 'npy';

/**
 * Whether the wasm of the images is to read these heights.
 * @param {Uint8Array} bytes
 * @param {unknown} [options] those of `read`
 */
export function isImage(bytes, options) {
  const { format } = Object(options);
  return format === undefined ? !beginsWith(bytes, PNG, NPY) : !isBasic(format);
}

/** Whether the wasm of the images is to read this photo. @param {Uint8Array} bytes */
export const isImagePhoto = (bytes) => !beginsWith(bytes, PNG, JPEG);

/** Whether a file begins with one of these texts. @param {Uint8Array} bytes @param {string[]} texts */
const beginsWith = (bytes, ...texts) => texts.some((text) => [...text].every((letter, i) => bytes[i] === letter.charCodeAt(0)));
