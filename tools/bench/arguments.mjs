/** The command line of `npm run bench`. */
import { parseArgs } from 'node:util';
import { Problem } from '../util/problem.mjs';
import { document, documentTables, peers as peerTables, tables } from './tables.mjs';

/** @param {string[]} args */
export function parse(args) {
  const { values: { quick = false, write = false, peers = false }, positionals } = split(args);
  const unknown = positionals.find((name) => !(name in tables));
  if (unknown !== undefined) throw new Problem(`There is no table "${unknown}": there are ${Object.keys(tables).join(', ')}.`);
  const chosen = [...positionals, ...(peers ? peerTables : [])];
  const names = new Set(chosen.length > 0 ? chosen : Object.keys(documentTables));
  if (write && (quick || !Object.keys(documentTables).every((table) => names.has(table)))) {
    throw new Problem(`${document.path} has all of its tables in full: leave --quick away, and name none.`);
  }
  return { quick, names: [...names], write };
}

/** @param {string[]} args */
function split(args) {
  const flag = /** @type {const} */ ({ type: 'boolean' });
  try {
    return parseArgs({ args, options: { quick: flag, write: flag, peers: flag }, allowPositionals: true });
  } catch (error) {
    throw new Problem(error instanceof Error ? error.message : String(error));
  }
}
