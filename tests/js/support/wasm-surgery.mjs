/** Makes a function of a wasm module trap, to see what becomes of the rest, or its memory small. */
import { exportedIndex, numberAt, sectionOf, textAt } from '../../../tools/util/wasm-module.mjs';

/**
 * The same module, but that the exported function ends in `unreachable` as soon as it is called.
 * @param {Uint8Array} module
 * @param {string} name
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function trapping(module, name) {
  const bytes = new Uint8Array(module);
  const index = exportedIndex(bytes, name) - importedFunctions(bytes);
  let [, at] = numberAt(bytes, sectionOf(bytes, 10).start);
  for (let i = 0; i < index; i += 1) {
    const [size, start] = numberAt(bytes, at);
    at = start + size;
  }
  const [size, start] = numberAt(bytes, at);
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
  const { at, start, end } = sectionOf(module, 5);
  // One memory, with or without a limit: its flags, and its size at the start.
  const [least] = numberAt(module, start + 2);
  const content = [1, 1, ...leb128(least), ...leb128(least + Math.ceil(kib / 64))];
  return Uint8Array.from([...module.subarray(0, at), 5, ...leb128(content.length), ...content, ...module.subarray(end)]);
}

/** @param {number} value @returns {number[]} */
function leb128(value) {
  return value < 128 ? [value] : [(value & 127) | 128, ...leb128(value >> 7)];
}

/** @param {Uint8Array} bytes */
function importedFunctions(bytes) {
  let [count, at] = numberAt(bytes, sectionOf(bytes, 2).start);
  for (let left = count; left > 0; left -= 1) {
    const [, module] = textAt(bytes, at);
    const [, name] = textAt(bytes, module);
    if (bytes[name] !== 0x00) throw new Error('only functions are expected to be imported');
    [, at] = numberAt(bytes, name + 1);
  }
  return count;
}
