/** Where things are in a wasm module. */

/**
 * An unsigned number (LEB128), and where what follows it begins.
 * @param {Uint8Array} bytes
 * @param {number} at
 * @returns {[value: number, next: number]}
 */
export function numberAt(bytes, at) {
  let value = 0;
  for (let shift = 0; ; shift += 7, at += 1) {
    value += (bytes[at] & 0x7f) * 2 ** shift;
    if (bytes[at] < 0x80) return [value, at + 1];
  }
}

/**
 * A section: where it begins, and where its contents begin and end.
 * @param {Uint8Array} bytes
 * @param {number} wanted its number
 */
export function sectionOf(bytes, wanted) {
  for (let at = 8; at < bytes.length; ) {
    const [size, start] = numberAt(bytes, at + 1);
    if (bytes[at] === wanted) return { at, start, end: start + size };
    at = start + size;
  }
  throw new Error(`the module has no section ${wanted}`);
}

/**
 * The text at a place, and where what follows it begins.
 * @param {Uint8Array} bytes
 * @param {number} at
 * @returns {[text: string, next: number]}
 */
export function textAt(bytes, at) {
  const [length, start] = numberAt(bytes, at);
  return [new TextDecoder().decode(bytes.subarray(start, start + length)), start + length];
}

/**
 * The index of what a module exports under a name.
 * @param {Uint8Array} bytes
 * @param {string} wanted
 */
export function exportedIndex(bytes, wanted) {
  let [count, at] = numberAt(bytes, sectionOf(bytes, 7).start);
  for (; count > 0; count -= 1) {
    const [name, end] = textAt(bytes, at);
    const [index, next] = numberAt(bytes, end + 1);
    if (name === wanted) return index;
    at = next;
  }
  throw new Error(`the module does not export ${wanted}`);
}
