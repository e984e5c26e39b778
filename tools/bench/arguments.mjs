/** The command line of `npm run bench`. */
import { existsSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { Problem } from '../util/problem.mjs';
import { document, documentTables, peers as peerTables, tables } from './tables.mjs';

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
  const unknown = positionals.find((name) => !(name in tables));
  if (unknown !== undefined) throw new Problem(`There is no table "${unknown}": there are ${Object.keys(tables).join(', ')}.`);
  const chosen = [...positionals, ...(peers ? peerTables : [])];
  const names = new Set(chosen.length > 0 ? chosen : Object.keys(documentTables));
  if (write && (quick || !Object.keys(documentTables).every((table) => names.has(table)))) {
    throw new Problem(`${document.path} has all of its tables in full: leave --quick away, and name none.`);
  }
  return { quick, names: [...names], write, file: values.input === undefined ? undefined : file(values.input, values) };
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
