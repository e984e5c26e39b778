/** Which of the two wasm files for images knows a file, by its format's name or its first bytes. */

/** The formats that the wasm of the images reads; it is not loaded for any other. */
const IMAGES = ['tiff', 'exr', 'pfm', 'npz', 'jpeg', 'webp'];

/** First bytes of those formats, as Latin-1; a `?` stands for any byte. */
const MAGIC = [
  'II*\0', 'MM\0*', 'II+\0', 'MM\0+', '\x76\x2f\x31\x01', 'Pf\n', 'PF\n', 'PK\x03\x04', 'PK\x05\x06', '\xff\xd8\xff',
  'RIFF????WEBP',
];

/**
 * Whether the wasm of the images is to read this file. What nobody knows is left to the other one,
 * which says so.
 * @param {Uint8Array} bytes
 * @param {unknown} [options] those of `read`
 */
export function isImage(bytes, options) {
  const { format } = Object(options);
  if (format !== undefined) return IMAGES.includes(format);
  return MAGIC.some((magic) =>
    [...magic].every((letter, i) => letter === '?' || bytes[i] === letter.charCodeAt(0)));
}
