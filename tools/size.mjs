/**
 * `node tools/size.mjs`: counts the lines and the tuned constants of each room of the repository, and writes
 * `benches/size.md`. A room that is larger than `tools/size-budget.json` allows is an error.
 *
 *     node tools/size.mjs --constants         prints each numeric constant with what chose it
 *     node tools/size.mjs --raise "REASON"    sets the budgets of larger rooms to what they have now, with that reason
 *
 * Lines are those of files of code that git tracks, comments, blank ones and unit tests included; files that a program of
 * `tools/` has made are left out. A numeric constant (in
 * Rust outside of tests, and with an upper-case name at the top of a JavaScript module) is tuned unless its documentation
 * says what chose it: a table in `benches/`, or a source outside of the program ({@link GIVEN}).
 */
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { TEST_ITEM } from './docs/modules.mjs';
import { root } from './util/paths.mjs';
import { main, Problem } from './util/problem.mjs';

/** @typedef {{ room: string, path: string, line: number, name: string, value: string, by: string }} Constant */
/** @typedef {{ lines: number, constants: number }} Size */
/** @typedef {Size & { why: string }} Budget */

const CODE = new Set(['.rs', '.js', '.mjs', '.ts', '.css', '.html', '.py', '.sh']);

/** Words by which a constant's documentation says that it was not chosen here: it is the paper's, a format's or a unit's. */
const GIVEN = /\bEq\. \d+|\bApp\. \w|\bthe paper's|\b(?:formats?|specification|protocol|bits?|bytes|in an? (?:inch|point|metre))\b/i;

/** First line of a file that a program has made. */
const GENERATED = /^\/\*\* [^\n]*\bMade of\b[^\n]* by `tools\//;

/** A constant in Rust, with the documentation above it. */
const RUST_CONSTANT = /^((?: *\/\/\/.*\n)*)(?: *(?:#\[|\/\/(?!\/)).*\n)* *(?:pub(?:\([^)]*\))? )?(?:const|static) (\w+):[^=]*=\s*([^]*?);/gm;
/** One in JavaScript likewise. */
const SCRIPT_CONSTANT = /^(?:\/\*\*((?:(?!\*\/)[^])*)\*\/\n)?(?:export )?const ([A-Z][A-Z0-9_]*) = ([^;]*);/gm;

const BENCHES = /`(benches\/[\w-]+\.md)`(?:, ([A-Z][\w -]*))?/;

const budgetFile = join(root, 'tools/size-budget.json');
const sizeFile = join(root, 'benches/size.md');

/** The room of a file: a folder of `src`, or else the folder at the top. @param {string} path */
function roomOf(path) {
  const [top, second, ...rest] = path.split('/');
  if (top === 'src') return rest.length > 0 ? `src/${second}` : 'src';
  return ['benches', 'examples'].includes(top) ? 'benches' : top;
}

/** What chose a constant; empty if its documentation does not say. @param {string} doc */
function chosenBy(doc) {
  const [, table, row] = BENCHES.exec(doc) ?? [];
  if (table !== undefined) return row === undefined ? table : `${table}, ${row.trim()}`;
  const [word] = GIVEN.exec(doc) ?? [];
  return word ?? '';
}

/** Whether a value is made of numbers. @param {string} value */
const isNumeric = (value) => /^[-[({\s]*(?:\w+\s*[({[]\s*|\w+:\s*|1\s*<<\s*)*[-\d]/.test(value) && /\d/.test(value) && !/["'`]/.test(value);

/** @param {string} path @param {string} text @returns {Constant[]} */
export function constantsOf(path, text) {
  const room = roomOf(path);
  // Tests are left out, and lines keep their numbers.
  const code = path.endsWith('.rs') ? text.replace(TEST_ITEM, (tests) => tests.replace(/[^\n]+/g, '')) : text;
  const found = code.matchAll(path.endsWith('.rs') ? RUST_CONSTANT : SCRIPT_CONSTANT);
  return Array.from(found).filter(([, , , value]) => isNumeric(value)).map(({ 0: whole, 1: doc = '', 2: name, 3: value, index }) => {
    const line = code.slice(0, index + whole.search(/\b(?:const|static) /)).split('\n').length;
    return { room, path, line, name, value: value.replace(/\s+/g, ' '), by: chosenBy(doc.replace(/\s*\n *(?:\*|\/\/\/) ?|^ *\/\/\/ ?/g, ' ')) };
  });
}

/** The sizes of all rooms, and the numeric constants of those that make the program. */
export function measure() {
  /** @type {Record<string, Size>} */
  const rooms = {};
  /** @type {Constant[]} */
  const constants = [];
  const paths = execFileSync('git', ['ls-files', '-z'], { cwd: root, encoding: 'utf8' }).split('\0');
  for (const path of paths.filter((one) => CODE.has(extname(one)) && one.includes('/')).sort()) {
    const text = readFileSync(join(root, path), 'utf8');
    if (GENERATED.test(text)) continue;
    const room = (rooms[roomOf(path)] ??= { lines: 0, constants: 0 });
    room.lines += text.split('\n').length - 1;
    if (!/^(?:src|wasm|pkg|www)\//.test(path) || !/\.(?:rs|js)$/.test(path)) continue;
    const own = constantsOf(path, text);
    room.constants += own.filter(({ by }) => by === '').length;
    constants.push(...own);
  }
  return { rooms, constants };
}

/**
 * What is larger than its budget, in sentences.
 * @param {Record<string, Size>} rooms
 * @param {Record<string, Budget>} budgets
 */
export function excesses(rooms, budgets) {
  return Object.entries(rooms).flatMap(([room, size]) => (/** @type {const} */ (['lines', 'constants'])).flatMap((what) => {
    const allowed = budgets[room]?.[what] ?? 0;
    return size[what] > allowed ? [`${room} has ${size[what]} ${what === 'lines' ? 'lines' : 'tuned constants'} and may have ${allowed}`] : [];
  }));
}

/** @param {Record<string, Size>} rooms @param {Constant[]} constants @param {Record<string, Budget>} budgets */
function report(rooms, constants, budgets) {
  const sum = (/** @type {keyof Size} */ what) => Object.values(rooms).reduce((total, size) => total + size[what], 0);
  const told = constants.filter(({ by }) => by !== '');
  return [
    '# Size', '',
    'Lines of code and tuned constants of each room, beside what `tools/size-budget.json` allows. Made by `node tools/size.mjs`,',
    'which says what counts; `node tools/size.mjs --constants` lists each constant with the table that chose it.', '',
    '| room | lines | allowed | tuned constants | allowed |', '|---|---|---|---|---|',
    ...Object.entries(rooms).map(([room, { lines, constants: tuned }]) =>
      `| ${room} | ${lines} | ${budgets[room]?.lines ?? 0} | ${tuned} | ${budgets[room]?.constants ?? 0} |`),
    `| **all** | ${sum('lines')} | | ${sum('constants')} | |`, '',
    `Of ${constants.length} numeric constants ${told.filter(({ by }) => by.startsWith('benches/')).length} cite a table in \`benches/\`, and `
    + `${told.filter(({ by }) => !by.startsWith('benches/')).length} the paper, a format or a unit.`, '',
  ].join('\n');
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  await main(async () => {
    const { values } = parseArgs({ options: { constants: { type: 'boolean' }, raise: { type: 'string' } } });
    const { rooms, constants } = measure();
    if (values.constants) {
      console.log('| constant | value | chosen by |\n|---|---|---|');
      for (const { path, line, name, value, by } of constants) console.log(`| ${path}:${line} ${name} | ${value} | ${by} |`);
      return;
    }
    /** @type {Record<string, Budget>} */
    const budgets = JSON.parse(readFileSync(budgetFile, 'utf8'));
    if (values.raise) {
      for (const [room, { lines, constants: tuned }] of Object.entries(rooms)) {
        const { lines: allowed = 0, constants: allowedTuned = 0, why = '' } = budgets[room] ?? {};
        const isLarger = lines > allowed || tuned > allowedTuned;
        budgets[room] = { lines: Math.max(lines, allowed), constants: Math.max(tuned, allowedTuned), why: isLarger ? values.raise : why };
      }
      const rows = Object.entries(budgets).map(([room, budget]) => `  ${JSON.stringify(room)}: ${JSON.stringify(budget)}`);
      writeFileSync(budgetFile, `{\n${rows.join(',\n')}\n}\n`);
    }
    writeFileSync(sizeFile, report(rooms, constants, budgets));
    const excess = excesses(rooms, budgets);
    if (excess.length > 0) {
      throw new Problem(`${excess.join('; ')}. Delete as much, or raise the budget in the same commit: node tools/size.mjs --raise "REASON".`);
    }
  });
}
