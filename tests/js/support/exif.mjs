/** Exif data as cameras write them. */

/** @param {number} tag @param {number} kind @param {number} value */
function entry(tag, kind, value) {
  const bytes = Buffer.alloc(12);
  bytes.writeUInt16LE(tag, 0);
  bytes.writeUInt16LE(kind, 2);
  bytes.writeUInt32LE(1, 4);
  bytes.writeUInt32LE(value, 8);
  return bytes;
}

/** @param {Buffer[]} entries */
function directory(...entries) {
  return Buffer.concat([Buffer.from([entries.length, 0]), ...entries, Buffer.alloc(4)]);
}

/**
 * A JPEG file with a focal length and which way up it is, put in before all else.
 * @param {Uint8Array} jpeg
 * @param {{ film35?: number, orientation?: number }} said
 */
export function withExif(jpeg, { film35, orientation }) {
  const own = orientation === undefined ? [] : [entry(0x112, 3, orientation)];
  const first = film35 === undefined ? directory(...own) : directory(...own, entry(0x8769, 4, 26 + 12 * own.length));
  const second = film35 === undefined ? [] : [directory(entry(0xa405, 3, film35))];
  const tiff = Buffer.concat([Buffer.from('II*\0\x08\0\0\0', 'latin1'), first, ...second]);
  const head = Buffer.from('\xff\xe1\0\0Exif\0\0', 'latin1');
  head.writeUInt16BE(8 + tiff.length, 2);
  return Buffer.concat([jpeg.subarray(0, 2), head, tiff, jpeg.subarray(2)]);
}
