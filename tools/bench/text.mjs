/** Numbers and tables for people to read. */

/**
 * @typedef {object} Table
 * @property {string} title
 * @property {string} text what is compared, and how
 * @property {string[]} columns
 * @property {string[][]} rows
 * @property {string} [summary] what the table comes to, in one sentence
 */

/** @param {number} value */
export const count = (value) => value.toLocaleString('en');

/** @param {number} value */
export const seconds = (value) => (value < 1 ? `${digits(1000 * value)} ms` : `${digits(value)} s`);

/** @param {number} value */
export const ratio = (value) => `${digits(value)} ×`;

/**
 * The range of some ratios, as "2.0 to 3.1".
 * @param {number[]} values
 */
export function range(values) {
  const [least, most] = [Math.min(...values), Math.max(...values)].map((value) => value.toPrecision(2)).map(Number);
  return least === most ? count(least) : `${count(least)} to ${count(most)}`;
}

/** @param {number} value */
export const percent = (value) => (value < 1e-4 ? value.toExponential(1) : `${digits(100 * value)} %`);

/** @param {number} value */
export const micros = (value) => digits(1e6 * value);

/** @param {number} value */
export const lambdaOf = (value) => `1e${Math.log10(value)}`;

/**
 * Three significant digits, all of them before the point where they are more.
 * @param {number} value
 */
export function digits(value) {
  return Math.abs(value) >= 100 ? count(Math.round(value)) : value.toPrecision(3);
}

/** @param {Table} table */
export function asText({ title, columns, rows }) {
  const lines = aligned([columns, ...rows]).map((cells) => cells.join('  '));
  const rule = '-'.repeat(Math.max(...lines.map((line) => line.length)));
  return [`\n=== ${title}`, lines[0], rule, ...lines.slice(1)].join('\n');
}

/** @param {Table} table */
export function asMarkdown({ title, text, columns, rows }) {
  const rule = columns.map((_, column) => (column === 0 ? ':---' : '---:'));
  const lines = aligned([columns, rule, ...rows]).map((cells) => `| ${cells.join(' | ')} |`);
  return [`## ${title}`, '', text, '', ...lines].join('\n');
}

/**
 * Cells of one width in each column, the first to the left, as names are, the others to the right.
 * @param {string[][]} rows
 */
function aligned(rows) {
  const widths = rows[0].map((_, column) => Math.max(...rows.map((row) => row[column].length)));
  return rows.map((row) => row.map((cell, column) =>
    (column === 0 ? cell.padEnd(widths[column]) : cell.padStart(widths[column]))));
}
