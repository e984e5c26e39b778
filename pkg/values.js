/**
 * Values of the caller's, read once each and before anything is called: an object of theirs can run code of theirs
 * when it is read, and an exception from there must not cross the wasm.
 */
import { DevelopableError, messageOf } from './errors.js';
import { nearest, unknownName } from './nearest.js';

/**
 * @typedef {import('./errors.js').ErrorCode} ErrorCode
 * @typedef {Exclude<import('./types.js').Numbers, readonly number[]>} NumericArray
 */

/**
 * Runs what reads an object of the caller's; whatever that throws becomes an error of the package.
 * @template T
 * @param {ErrorCode} code
 * @param {string} what is read, as in `the input`
 * @param {() => T} read
 * @returns {T}
 */
export function reading(code, what, read) {
  try {
    return read();
  } catch (cause) {
    if (cause instanceof DevelopableError) throw cause;
    throw new DevelopableError(code, `${what} could not be read: ${messageOf(cause)}`, { cause });
  }
}

/**
 * What an object says under these names.
 * @template {string} N
 * @param {ErrorCode} code of what may go wrong
 * @param {string} what the object is, as in `the input`
 * @param {unknown} given
 * @param {readonly N[]} names
 * @returns {Partial<Record<N, unknown>>}
 */
export function record(code, what, given, names) {
  /** @type {Partial<Record<N, unknown>>} */
  const values = {};
  for (const name of names) {
    const value = reading(code, `${name} of ${what}`, () => /** @type {Record<N, unknown>} */ (Object(given))[name]);
    if (value !== undefined) values[name] = value;
  }
  return values;
}

/**
 * Refuses an object with names that are not known. What it inherits is not looked at.
 * @param {ErrorCode} code
 * @param {string} what such a name is of, as in `option`
 * @param {unknown} given
 * @param {readonly string[]} known
 */
export function refuseUnknown(code, what, given, known) {
  if (!isRecord(given)) return; // what it must be instead is said where it is used
  const stray = reading(code, `what is given as ${what}`, () => Object.keys(Object(given)).find((name) => !known.includes(name)));
  if (stray !== undefined) throw new DevelopableError(code, unknownName(what, stray, known));
}

/**
 * Refuses an input with a property that nearly is one that there is, or that is for another kind of input. Others are the caller's own.
 * @param {string} what such a property is of, as in `the image`
 * @param {unknown} given
 * @param {readonly string[]} known
 * @param {readonly string[]} [foreign] properties of other kinds of input
 */
export function refuseMisspelled(what, given, known, foreign = []) {
  if (!isRecord(given)) return;
  const names = reading('INPUT', `what is given as ${what}`, () => Object.keys(Object(given)));
  const slip = names.find((name) => !known.includes(name) && (foreign.includes(name) || nearest(name, known) !== undefined));
  if (slip !== undefined) throw new DevelopableError('INPUT', unknownName(`property of ${what}`, slip, known));
}

/**
 * A copy of nested lists and objects, and of nothing else.
 * @template T
 * @param {string} what
 * @param {T} value
 * @returns {T}
 */
export function plainCopy(what, value) {
  return reading('INPUT', what, () => structuredClone(value));
}

/**
 * @param {ErrorCode} code
 * @param {string} what
 * @param {unknown} value
 */
export function asText(code, what, value) {
  if (typeof value === 'string') return value;
  throw new DevelopableError(code, `${what} must be a text, but is ${show(value)}`);
}

/** Whether it is an object that can say something, and no list. @param {unknown} value */
export function isRecord(value) {
  try {
    return typeof value === 'object' && value !== null && !Array.isArray(value);
  } catch {
    return false; // a proxy that has been revoked
  }
}

/** @type {(prototype: object, name: PropertyKey) => (array: unknown) => unknown} */
const getter = (prototype, name) => {
  const get = /** @type {() => unknown} */ (Object.getOwnPropertyDescriptor(prototype, name)?.get);
  return (array) => get.call(array);
};

// Those that all typed arrays share, which nothing that an array says of itself can replace.
const shared = Object.getPrototypeOf(Uint8Array.prototype);
const tagOf = getter(shared, Symbol.toStringTag);
const bufferOf = getter(shared, 'buffer');
const offsetOf = getter(shared, 'byteOffset');
const lengthOf = getter(shared, 'length');

/** The name of its type, if it is a typed array, of whatever page or realm. @param {unknown} value */
export function typeOf(value) {
  return /** @type {string | undefined} */ (tagOf(value));
}

/**
 * A typed array of this realm over the same memory, without anything that was done to the given one.
 * @param {string} name
 * @param {unknown} array
 * @returns {NumericArray}
 */
export function viewOf(name, array) {
  const type = /** @type {string} */ (typeOf(array));
  /** @type {unknown} */
  const constructor = Reflect.get(globalThis, type);
  const View = /** @type {new (buffer: unknown, offset: unknown, length: unknown) => NumericArray} */ (constructor);
  try {
    return new View(bufferOf(array), offsetOf(array), lengthOf(array));
  } catch {
    throw new DevelopableError('INPUT', `${name} has no memory any more: its buffer was handed over, or made smaller`);
  }
}

/** Maximum number of items of a list that a message shows. */
const MAX_SHOWN_ITEMS = 6;

/**
 * A value in an error message.
 * @param {unknown} value
 * @returns {string}
 */
export function show(value) {
  if (typeof value === 'string') return JSON.stringify(value.length > 80 ? `${value.slice(0, 80)}…` : value);
  if (typeof value === 'bigint') return `${value}n`;
  if (typeof value === 'function') return 'a function';
  if (typeof value === 'number') return String(value).replace('e+', 'e');
  if (typeof value !== 'object' || value === null) return String(value);
  try {
    if (Array.isArray(value)) {
      const items = Array.from({ length: Math.min(value.length, MAX_SHOWN_ITEMS) }, (_, i) => value[i]);
      const texts = items.map((item) => (typeof item === 'object' && item !== null ? '…' : show(item)));
      return `[${texts.join(', ')}${value.length > MAX_SHOWN_ITEMS ? ', …' : ''}]`;
    }
    return typeOf(value) ?? Object.prototype.toString.call(value).slice(8, -1);
  } catch {
    return 'an object';
  }
}
