/** Bytes of files that a caller has. */
import { DevelopableError, messageOf } from './errors.js';
import { asBytes } from './input.js';
import { reading } from './values.js';

/**
 * A copy of a file's bytes.
 * @param {Uint8Array | ArrayBuffer | Blob} bytes
 */
export async function copyOfFile(bytes) {
  if (!isBlob(bytes)) return new Uint8Array(asBytes(bytes));
  try {
    return new Uint8Array(await bytes.arrayBuffer());
  } catch (cause) {
    throw new DevelopableError('INPUT', `the file could not be read: ${messageOf(cause)}`, { cause });
  }
}

/**
 * @param {unknown} value
 * @returns {value is Blob}
 */
export function isBlob(value) {
  return typeof Blob === 'function' && reading('INPUT', 'the file', () => value instanceof Blob);
}
