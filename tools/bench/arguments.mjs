/** The command line of `npm run bench`. */
import { existsSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { Problem } from '../util/problem.mjs';
import { documents, peers as peerTables, tables } from './tables.mjs';

const flags = /** @type {const} */ ({
  quick: { type: 'boolean' },
  write: { type: 'boolean' },
  peers: { type: 'boolean' },
  input: { type: 'string' },
  lattice: { type: 'string' },
  spacing: { type: 'string' },
  'no-data': { type: 'string' },
  'no-normalize': { type: 'boolean' },
});

/** @param {string[]} args */
export function parse(args) {
  const { values, positionals } = split(args);
  const { quick = false, write = false, peers = false } = values;
  const unknown = positionals.find((name) => !(name in tables) && !(name in documents));
  if (unknown !== undefined) {
    const known = [...Object.keys(tables), ...Object.keys(documents)];
    throw new Problem(`There is no table or document "${unknown}": there are ${known.join(', ')}.`);
  }
  const chosen = [...positionals, ...(peers ? peerTables : [])];
  const names = new Set((chosen.length > 0 ? chosen : Object.keys(documents))
    .flatMap((name) => (name in documents ? Object.keys(documents[name].tables) : [name])));
  const whole = Object.keys(documents).filter((name) => Object.keys(documents[name].tables).every((table) => names.has(table)));
  if (write && (quick || whole.length === 0)) {
    throw new Problem(`A document has all of its tables in full: leave --quick away, and name ${Object.keys(documents).join(' or ')}, or nothing.`);
  }
  return { quick, names: [...names], documents: write ? whole : [], file: values.input === undefined ? undefined : file(values.input, values) };
}

/**
 * The user's file, with the same flags and defaults as `developable fit`.
 * @param {string} path
 * @param {ReturnType<typeof split>['values']} values
 * @returns {import('./task.mjs').Input}
 */
function file(path, values) {
  if (!existsSync(path)) throw new Problem(`There is no file ${path}.`);
  const lattice = values.lattice ?? 'square';
  if (lattice !== 'hex' && lattice !== 'square') {
    throw new Problem(`--lattice must be square or hex, but is "${lattice}".`);
  }
  return {
    file: resolve(path),
    name: basename(path),
    lattice,
    spacing: number('spacing', values.spacing) ?? 1,
    noData: number('no-data', values['no-data']) ?? (lattice === 'hex' ? 0 : null),
    normalize: !values['no-normalize'],
  };
}

/** @param {string[]} args */
function split(args) {
  try {
    return parseArgs({ args, options: flags, allowPositionals: true });
  } catch (error) {
    throw new Problem(error instanceof Error ? error.message : String(error));
  }
}

/**
 * @param {string} name
 * @param {string | undefined} text
 */
function number(name, text) {
  if (text === undefined) return undefined;
  const value = text.trim() === '' ? NaN : Number(text);
  if (Number.isNaN(value)) throw new Problem(`--${name} must be a number, but is "${text}".`);
  return value;
}
