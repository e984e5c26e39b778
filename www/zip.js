/** Writes ZIP files. */

/** Version of ZIP that a reader needs, 2.0, and the method of compression, deflate. */
const [ZIP_VERSION, DEFLATE_METHOD] = [20, 8];

/**
 * @param {Record<string, string>} files texts by their paths
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 */
export async function zip(files) {
  /** @type {BlobPart[]} */
  const bodies = [];
  /** @type {BlobPart[]} */
  const directory = [];
  let [offset, size] = [0, 0];
  for (const [path, text] of Object.entries(files)) {
    const [name, bytes] = [path, text].map((words) => new TextEncoder().encode(words));
    // Between a header of ten bytes and the length, gzip has what ZIP needs: the compressed bytes and their checksum.
    const gzip = new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new CompressionStream('gzip'))).arrayBuffer());
    const [deflated, checksum] = [gzip.subarray(10, -8), gzip.subarray(-8, -4)];
    // Version, flags, method, time and date, checksum, lengths.
    const common = Uint8Array.of(...littleEndian([[2, ZIP_VERSION], [2, 0], [2, DEFLATE_METHOD], [4, 0]]), ...checksum, ...littleEndian([[4, deflated.length], [4, bytes.length], [2, name.length], [2, 0]]));
    bodies.push('PK\x03\x04', common, name, deflated);
    directory.push('PK\x01\x02', littleEndian([[2, ZIP_VERSION]]), common, littleEndian([[2, 0], [2, 0], [2, 0], [4, 0], [4, offset]]), name);
    offset += 4 + common.length + name.length + deflated.length;
    size += 46 + name.length;
  }
  const count = Object.keys(files).length;
  const end = littleEndian([[2, 0], [2, 0], [2, count], [2, count], [4, size], [4, offset], [2, 0]]);
  return new Uint8Array(await new Blob([...bodies, ...directory, 'PK\x05\x06', end]).arrayBuffer());
}

/** Whole numbers of so many bytes each. @param {readonly (readonly [number, number])[]} fields */
function littleEndian(fields) {
  return Uint8Array.from(fields.flatMap(([length, value]) => Array.from({ length }, (_, i) => (value >>> (8 * i)) & 255)));
}
