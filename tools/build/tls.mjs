/** A correction of modules for several threads that have no thread-local storage, as wasm-bindgen expects some. */
import { Problem } from '../util/problem.mjs';

const EXPORT_SECTION = 7;
const GLOBAL_SECTION = 6;
const GLOBAL_KIND = 3;
const I32_CONST = 0x41;

/**
 * Sets the alignment of thread-local storage, the exported global `__tls_align`, from 0 to 1: wasm-bindgen allocates the
 * storage when the module starts, and no memory has the alignment 0.
 * @param {Uint8Array} module without imported globals; is changed
 */
export function alignStorage(module) {
  const index = exportedGlobal(module, '__tls_align');
  const reader = new Reader(module, sectionStart(module, GLOBAL_SECTION));
  const count = reader.number();
  for (let i = 0; i < count; i += 1) {
    reader.at += 2; // its type and whether it can change
    const opcode = module[reader.at];
    reader.at += 1;
    const place = reader.at;
    reader.number();
    reader.at += 1; // the end of the expression
    if (i !== index) continue;
    if (opcode !== I32_CONST || module[place] > 1) throw new Problem('The module has thread-local storage: see tools/build/tls.mjs.');
    module[place] = 1;
  }
}

/**
 * The index of an exported global.
 * @param {Uint8Array} module
 * @param {string} wanted
 */
function exportedGlobal(module, wanted) {
  const reader = new Reader(module, sectionStart(module, EXPORT_SECTION));
  for (let left = reader.number(); left > 0; left -= 1) {
    const length = reader.number();
    const name = new TextDecoder().decode(module.subarray(reader.at, reader.at + length));
    reader.at += length;
    const kind = reader.number();
    const index = reader.number();
    if (name === wanted && kind === GLOBAL_KIND) return index;
  }
  throw new Problem(`The module does not export ${wanted}: see the link arguments in tools/build/threads.mjs.`);
}

/**
 * Where a section's contents begin.
 * @param {Uint8Array} module
 * @param {number} wanted
 */
function sectionStart(module, wanted) {
  const reader = new Reader(module, 8);
  while (reader.at < module.length) {
    const id = reader.number();
    const size = reader.number();
    if (id === wanted) return reader.at;
    reader.at += size;
  }
  throw new Problem(`The module has no section ${wanted}: see tools/build/tls.mjs.`);
}

/** Numbers of a module, one after the other. */
class Reader {
  #bytes;

  /**
   * @param {Uint8Array} bytes
   * @param {number} at
   */
  constructor(bytes, at) {
    this.#bytes = bytes;
    this.at = at;
  }

  /** The next number (LEB128, unsigned). */
  number() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.#bytes[this.at];
      this.at += 1;
      value |= (byte & 0x7f) << shift;
      if (byte < 0x80) return value >>> 0;
    }
  }
}
