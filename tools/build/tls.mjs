/** A correction of modules for several threads that have no thread-local storage, as wasm-bindgen expects some. */
import { Problem } from '../util/problem.mjs';
import { exportedIndex, numberAt, sectionOf } from '../util/wasm-module.mjs';

const GLOBAL_SECTION = 6;
const I32_CONST = 0x41;

/**
 * Sets the alignment of thread-local storage, the exported global `__tls_align`, from 0 to 1: wasm-bindgen allocates the
 * storage when the module starts, and no memory has the alignment 0.
 * @param {Uint8Array} module without imported globals; is changed
 */
export function alignStorage(module) {
  const index = exportedIndex(module, '__tls_align');
  let [, at] = numberAt(module, sectionOf(module, GLOBAL_SECTION).start);
  // A global has its type, whether it can change, the operator and the value of an expression, and the end of that.
  for (let i = 0; i < index; i += 1) at = numberAt(module, at + 3)[1] + 1;
  if (module[at + 2] !== I32_CONST || module[at + 3] > 1) throw new Problem('The module has thread-local storage: see tools/build/tls.mjs.');
  module[at + 3] = 1;
}
