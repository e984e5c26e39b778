/** Makes a function of a wasm module trap, to see what becomes of the rest. */

/**
 * The same module, but that the exported function ends in `unreachable` as soon as it is called.
 * @param {Uint8Array} module
 * @param {string} name
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function trapping(module, name) {
  const bytes = new Uint8Array(module);
  /** @type {Map<number, number>} where the sections' contents begin */
  const sections = new Map();
  for (let at = 8; at < bytes.length; ) {
    const id = bytes[at];
    const [size, start] = integer(bytes, at + 1);
    sections.set(id, start);
    at = start + size;
  }
  const index = exported(bytes, need(sections.get(7)), name) - importedFunctions(bytes, need(sections.get(2)));
  let [, at] = integer(bytes, need(sections.get(10)));
  for (let i = 0; i < index; i += 1) {
    const [size, start] = integer(bytes, at);
    at = start + size;
  }
  const [size, start] = integer(bytes, at);
  // No locals, `unreachable`, then `nop` up to the `end` that is there.
  bytes.fill(0x01, start, start + size - 1);
  bytes.set([0x00, 0x00], start);
  return bytes;
}

/**
 * The same module, but that its memory does not grow to more than this.
 * @param {Uint8Array} module
 * @param {number} kib beyond what it has at the start
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function limited(module, kib) {
  for (let at = 8; at < module.length; ) {
    const [size, start] = integer(module, at + 1);
    if (module[at] === 5) {
      // One memory, with or without a limit: its flags, and its size at the start.
      const [least] = integer(module, start + 2);
      const content = [1, 1, ...leb128(least), ...leb128(least + Math.ceil(kib / 64))];
      return Uint8Array.from([
        ...module.subarray(0, at), 5, ...leb128(content.length), ...content, ...module.subarray(start + size),
      ]);
    }
    at = start + size;
  }
  throw new Error('the module has no memory of its own');
}

/** @param {number} value @returns {number[]} */
function leb128(value) {
  return value < 128 ? [value] : [(value & 127) | 128, ...leb128(value >> 7)];
}

/**
 * @param {Uint8Array} bytes
 * @param {number} start
 * @param {string} wanted
 */
function exported(bytes, start, wanted) {
  let [count, at] = integer(bytes, start);
  for (; count > 0; count -= 1) {
    const name = text(bytes, at);
    const [index, next] = integer(bytes, name.end + 1);
    if (name.text === wanted) return index;
    at = next;
  }
  throw new Error(`the module does not export ${wanted}`);
}

/**
 * @param {Uint8Array} bytes
 * @param {number} start
 */
function importedFunctions(bytes, start) {
  let [count, at] = integer(bytes, start);
  for (let left = count; left > 0; left -= 1) {
    at = text(bytes, text(bytes, at).end).end;
    if (bytes[at] !== 0x00) throw new Error('only functions are expected to be imported');
    [, at] = integer(bytes, at + 1);
  }
  return count;
}

/**
 * @param {Uint8Array} bytes
 * @param {number} start
 */
function text(bytes, start) {
  const [length, at] = integer(bytes, start);
  return { text: new TextDecoder().decode(bytes.subarray(at, at + length)), end: at + length };
}

/**
 * An unsigned LEB128 number, and what comes after it.
 * @param {Uint8Array} bytes
 * @param {number} at
 * @returns {[number, number]}
 */
function integer(bytes, at) {
  let value = 0;
  for (let shift = 0; ; shift += 7, at += 1) {
    value += (bytes[at] & 0x7f) * 2 ** shift;
    if (bytes[at] < 0x80) return [value, at + 1];
  }
}

/** @param {number | undefined} section */
function need(section) {
  if (section === undefined) throw new Error('the module lacks a section');
  return section;
}
