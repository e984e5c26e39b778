/**
 * `node tools/docs-sample.mjs`: prints doc comments of the Rust sources at random, with nothing around them but the kind
 * and the name of the item, so that somebody who has not seen the code can say which of them are understood. With
 * `--constants` it prints the constants instead whose names say neither a subject nor a quantity.
 *
 *     node tools/docs-sample.mjs [--count 60] [--seed 1] [--under src/fit] [--where]
 *     node tools/docs-sample.mjs --constants [--all] [--under src/fit]
 */
import { readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { isVague } from './docs/constants.mjs';
import { itemsOf } from './docs/items.mjs';
import { random, sample } from './docs/random.mjs';
import { rustFiles } from './docs/sources.mjs';
import { main, Problem } from './util/problem.mjs';

/** @typedef {import('./docs/items.mjs').Item} Item */

await main(async () => {
  const { count, seed, under, where, constants, all } = options();
  const items = rustFiles(under).flatMap((path) => itemsOf(path, readFileSync(path, 'utf8')));
  if (items.length === 0) throw new Problem(`There is no Rust source under ${under.join(', ')}.`);
  if (constants) {
    printConstants(items.filter(({ kind, path }) => kind === 'const' && path.startsWith('src/')), all);
  } else {
    const documented = items.filter(({ doc }) => doc.length > 0);
    for (const item of sample(documented, count, random(seed))) print(item, where);
  }
});

function options() {
  const values = parsed();
  const [count, seed] = [Number(values.count), Number(values.seed)];
  if (!Number.isInteger(count) || count < 1) throw new Problem(`--count must be a whole number above 0.`);
  if (!Number.isInteger(seed)) throw new Problem(`--seed must be a whole number.`);
  return { ...values, count, seed };
}

function parsed() {
  try {
    return parseArgs({
      options: {
        count: { type: 'string', default: '60' },
        seed: { type: 'string', default: '1' },
        under: { type: 'string', multiple: true, default: ['src', 'wasm'] },
        where: { type: 'boolean', default: false },
        constants: { type: 'boolean', default: false },
        all: { type: 'boolean', default: false },
      },
    }).values;
  } catch (problem) {
    throw new Problem(
      `${problem instanceof Error ? problem.message : problem}\n`
        + 'Usage: node tools/docs-sample.mjs [--count 60] [--seed 1] [--under FOLDER] [--where]\n'
        + '       node tools/docs-sample.mjs --constants [--all] [--under FOLDER]',
    );
  }
}

/**
 * @param {Item} item
 * @param {boolean} where
 */
function print({ kind, name, doc, path, line }, where) {
  console.log(`${kind} ${name}${where ? `    (${path}:${line})` : ''}`);
  console.log(`${doc.map((text) => `    ${text}`.trimEnd()).join('\n')}\n`);
}

/**
 * @param {Item[]} items
 * @param {boolean} all
 */
function printConstants(items, all) {
  const vague = items.filter(({ name }) => isVague(name));
  for (const { name, path, line, doc } of all ? items : vague) {
    console.log(`${path}:${line}  ${name}  ${doc[0] ?? ''}`.trimEnd());
  }
  const share = ((100 * vague.length) / Math.max(1, items.length)).toFixed(1);
  console.log(`${vague.length} of ${items.length} constants (${share} %) have a name without subject or quantity.`);
}
