/**
 * Kinds of values that options have: the type, how a caller's value is checked and copied, and how one is read from a command line.
 * Ranges are checked in Rust, which all its users share; what gets there are plain numbers, texts and lists.
 */
import { DevelopableError } from '../errors.js';
import { isRecord, reading, record, refuseUnknown, show } from '../values.js';

/**
 * How a value is taken.
 * @typedef {object} Reading
 * @property {string} must what a value has to be, for messages
 * @property {(value: unknown) => unknown} take gives a copy of a value, and nothing for what is none
 *
 * @typedef {Reading & { type: string, typed?: Reading }} Kind
 *   `type` in TypeScript; `typed` reads the text after a flag, where that is not read as any other value
 *
 * @typedef {object} Option a row of the schema; the comment above it describes the option in the types
 * @property {Kind} kind
 * @property {string} [type] in TypeScript, where that of the kind has a name or says too little
 * @property {unknown} [default] what the option is where it is not given, decided in Rust; tests compare the two
 * @property {import('../cli/flags.js').FlagInfo} [flag] of the command, if the option has one of its own
 *
 * @typedef {Record<string, Option>} Options
 */

/** A number that stands after a flag. @type {Reading} */
const numeral = {
  must: 'must be a number',
  // `Number` takes blanks for 0.
  take: (text) => (typeof text !== 'string' || text.trim() === '' || Number.isNaN(Number(text)) ? undefined : Number(text)),
};

/** @type {Kind} */
export const number = {
  type: 'number',
  must: 'must be a number',
  take: (value) => (typeof value === 'number' && !Number.isNaN(value) ? value : undefined),
  typed: numeral,
};

/** What is checked here and not in Rust alone, since what the call is about may be handed over to a worker. @type {Kind} */
export const positive = {
  type: 'number',
  must: 'must be a finite number above zero',
  take: (value) => (Number.isFinite(value) && Number(value) > 0 ? value : undefined),
  typed: numeral,
};

/** @type {Kind} */
export const percentage = {
  type: 'number',
  must: 'must be a whole number from 1 to 100',
  take: (value) => (Number.isInteger(value) && Number(value) >= 1 && Number(value) <= 100 ? value : undefined),
  typed: numeral,
};

/** @type {Kind} */
export const threadCount = {
  type: 'number',
  must: 'must be a whole number from 1 to 64',
  take: (value) => (Number.isInteger(value) && Number(value) >= 1 && Number(value) <= 64 ? value : undefined),
  typed: numeral,
};

/** @type {Kind} */
export const whole = {
  type: 'number',
  must: 'must be a whole number from 0 to about 4 billion',
  take: (value) => (Number.isInteger(value) && Number(value) >= 0 && Number(value) < 2 ** 32 ? value : undefined),
  typed: numeral,
};

/** @type {Kind} */
export const flag = {
  type: 'boolean',
  must: 'must be true or false',
  take: (value) => (typeof value === 'boolean' ? value : undefined),
};

/** @type {Kind} */
export const text = { type: 'string', must: 'must be a text', take: (value) => (typeof value === 'string' ? value : undefined) };

/** @type {Kind} */
export const callback = {
  type: '(...given: any[]) => unknown',
  must: 'must be a function',
  take: (value) => (typeof value === 'function' ? value : undefined),
};

/** @type {Kind} */
export const address = {
  type: 'string | URL',
  must: 'must be a text or a URL',
  take: (value) => (typeof value === 'string' || value instanceof URL ? value : undefined),
};

/** What is checked by who takes it. @type {Kind} */
export const anything = { type: 'unknown', must: '', take: (value) => value };

/** One of several names, in whatever case. @type {(...names: string[]) => Kind} */
export const choice = (...names) => ({
  type: names.map((name) => `'${name}'`).join(' | '),
  must: `must be ${names.slice(0, -1).join(', ')} or ${names.at(-1)}`,
  take: (value) => names.find((name) => typeof value === 'string' && name.toLowerCase() === value.toLowerCase()),
});

/** A tuple of numbers. @type {(length: number, what: string) => Kind} */
export const numbers = (length, what) => ({
  type: `readonly [${Array.from({ length }, () => 'number').join(', ')}]`,
  must: `must be ${what}`,
  take: (value) => {
    const list = Array.isArray(value) ? Array.from({ length }, (_, i) => value[i]) : [];
    return list.length === Object(value).length && list.every(Number.isFinite) ? list : undefined;
  },
});

/** @type {(length: number, row: Kind, what: string) => Kind} */
export const rows = (length, row, what) => ({
  type: `readonly (${row.type})[]`,
  must: `must be ${what}`,
  take: (value) => {
    const list = Array.isArray(value) ? Array.from({ length }, (_, i) => row.take(value[i])) : [];
    return list.length === Object(value).length && !list.includes(undefined) ? list : undefined;
  },
});

/** Pairs of patches by their numbers on a drawing, which begin with 1; after a flag as `3-7,4-9`. @type {Kind} */
export const patchPairs = {
  type: 'readonly (readonly [number, number])[]',
  must: 'must be pairs of numbers of patches, from 1 on',
  take: (value) => {
    const isNumber = (/** @type {unknown} */ patch) => Number.isInteger(patch) && Number(patch) >= 1 && Number(patch) < 2 ** 32;
    const pairs = Array.isArray(value) ? value.map((pair) => (Array.isArray(pair) ? [...pair] : [])) : undefined;
    return pairs?.every((pair) => pair.length === 2 && pair.every(isNumber)) ? pairs : undefined;
  },
  typed: {
    must: 'must be pairs of numbers of patches, such as 3-7,4-9',
    take: (given) => (typeof given === 'string' && /^[1-9]\d{0,8}-[1-9]\d{0,8}(,[1-9]\d{0,8}-[1-9]\d{0,8})*$/.test(given)
      ? given.split(',').map((pair) => pair.split('-').map(Number))
      : undefined),
  },
};

/** The corners of a rectangle with an area. @type {Kind} */
export const extent = {
  type: 'readonly [number, number, number, number]',
  must: 'must be four numbers: left, bottom, right and top, left less than right and bottom less than top',
  take: (value) => {
    const sides = /** @type {number[] | undefined} */ (numbers(4, '').take(value));
    return sides && sides[0] < sides[2] && sides[1] < sides[3] ? sides : undefined;
  },
};

/** @type {(a: Reading, b: Reading) => Reading} */
const eitherReading = (a, b) => ({
  must: `${a.must.replace(/ or (?=\S+$)/, ', ')} or ${b.must.replace('must be ', '')}`,
  take: (value) => a.take(value) ?? b.take(value),
});

/** @type {(a: Kind, b: Kind) => Kind} */
export const either = (a, b) => ({
  type: `${a.type} | ${b.type}`,
  ...eitherReading(a, b),
  typed: eitherReading(a.typed ?? a, b.typed ?? b),
});

/** @type {Kind} */
export const signal = {
  type: 'AbortSignal',
  must: 'must be an AbortSignal',
  take: (value) => {
    const aborted = Object.getOwnPropertyDescriptor(AbortSignal.prototype, 'aborted')?.get;
    try {
      aborted?.call(value); // which throws for what is none, whatever it looks like
      const { throwIfAborted, addEventListener } = /** @type {AbortSignal} */ (value);
      return typeof throwIfAborted === 'function' && typeof addEventListener === 'function' ? value : undefined;
    } catch {
      return undefined;
    }
  },
};

/** The width of holes that are bridged; `false` for none. @type {Kind} */
export const bridging = {
  type: "number | boolean | 'none' | 'off'",
  must: 'must be a number, true for the default, or none (also off, 0 or false)',
  take: (value) => (value === 0 || choice('none', 'off').take(value) ? false : flag.take(value) ?? number.take(value)),
  typed: {
    must: 'must be none or a number',
    take: (text) => (choice('none', 'off').take(text) ? false : numeral.take(text)),
  },
};

/** The threshold for occlusions of the paper's authors. */
const AUTHORS_THRESHOLD = 4e4;

/** @type {Kind} */
export const threshold = {
  type: "number | 'auto'",
  must: 'must be auto or a number',
  take: (value) => (choice('auto').take(value) ? AUTHORS_THRESHOLD : number.take(value)),
  typed: {
    must: 'must be auto or a number',
    take: (text) => choice('auto').take(text) ?? numeral.take(text),
  },
};

/** A share of the height range, as text: `0.5%`. @type {Reading} */
const shareText = {
  must: 'must be a share such as 0.5%',
  take: (text) => (typeof text === 'string' && /^\s*(\d+\.?\d*|\.\d+)\s*%\s*$/.test(text) ? text : undefined),
};

/** A percentage as the wasm takes it, which has no parser of numbers; one that was read before stays. @type {Reading} */
const share = {
  must: shareText.must,
  take: (value) => {
    if (shareText.take(value) !== undefined) return { share: parseFloat(/** @type {string} */ (value)) / 100 };
    const known = number.take(/** @type {{ share?: unknown } | null | undefined} */ (value)?.share);
    return known === undefined ? undefined : { share: known };
  },
};

/** A distance, or a share of the height range. @type {Kind} */
export const tolerance = { type: 'number | `${number}%`', ...eitherReading(number, share), typed: eitherReading(numeral, shareText) };

/** @type {Kind} */
export const corners = {
  type: 'readonly (readonly [number, number])[]',
  must: 'must be a list of three or more corners [x, y]',
  take: (value) => {
    const corner = numbers(2, 'two numbers');
    const list = Array.isArray(value) ? Array.from(value, corner.take) : [];
    return list.length > 2 && !list.includes(undefined) ? list : undefined;
  },
};

/** @type {Kind} */
export const several = {
  type: 'readonly number[]',
  must: 'must be a list of one or more numbers',
  take: (value) => {
    const list = listOf(value);
    return list.length > 0 && list.every(Number.isFinite) ? list : undefined;
  },
};

/** @type {Kind} */
export const flags = {
  type: 'readonly (boolean | number)[] | Uint8Array',
  must: 'must be a list of true and false (or 1 and 0), one for each vertex',
  take: (value) => {
    const list = listOf(value);
    const known = list.every((one) => one === true || one === false || one === 1 || one === 0);
    return known && list.length > 0 ? Uint8Array.from(list, Number) : undefined;
  },
};

/**
 * A copy of a list or of a typed array.
 * @param {unknown} value
 */
function listOf(value) {
  return Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(/** @type {ArrayLike<unknown>} */ (value)) : [];
}

/** The options of another call, or what looks like them. @type {(options: Options, must?: string) => Kind} */
export const optionsIn = (options, must = 'must be an object of options') => ({
  type: 'object',
  must,
  take: (value) => (isRecord(value) ? readOptions(options, /** @type {object} */ (value)) : undefined),
});

/**
 * What is given of some options, as a plain object without anything that is undefined.
 * @param {Options} options
 * @param {object | undefined} given
 * @returns {object}
 */
export function readOptions(options, given) {
  if (given === undefined) return {};
  return reading('OPTION', 'the options', () => {
    if (!isRecord(given)) {
      throw new DevelopableError('OPTION', `the options must be an object, but are ${show(given)}`);
    }
    const names = Object.keys(options);
    refuseUnknown('OPTION', 'option', given, names);
    const entries = Object.entries(record('OPTION', 'the options', given, names));
    return Object.fromEntries(entries.map(([name, value]) => [name, taken(name, options[name].kind, value)]));
  });
}

/**
 * @param {string} name
 * @param {Kind} kind
 * @param {unknown} value
 */
function taken(name, kind, value) {
  const copy = reading('OPTION', `option \`${name}\``, () => kind.take(value));
  if (copy !== undefined) return copy;
  throw new DevelopableError('OPTION', `option \`${name}\` is ${show(value)}, but ${kind.must}`);
}
