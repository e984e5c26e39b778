/**
 * The formats that heights can be written to: the endings of their files, the usual one first, the media type, and what is in them.
 * A format to write is a row here.
 */
export const IMAGE_FILES = /** @type {const} */ ({
  npy: { endings: ['.npy'], type: 'application/octet-stream', about: '64-bit floats, for NumPy' },
  png: { endings: ['.png'], type: 'image/png', about: '16-bit grey, with their scale recorded' },
  tiff: { endings: ['.tif', '.tiff'], type: 'image/tiff', about: '32-bit floats' },
  exr: { endings: ['.exr'], type: 'image/x-exr', about: '32-bit floats' },
});

/** @typedef {keyof typeof IMAGE_FILES} ImageFile */
