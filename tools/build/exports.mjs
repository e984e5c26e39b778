/** What the package's files export, with the comments above. */
import { readFile } from 'node:fs/promises';

/** @typedef {{ type: string, start: number, end: number, [field: string]: any }} Node of the syntax tree */

/** A file's text, its exports, and what finds the comment right above one of its nodes. @param {string} path */
export async function exportsOf(path) {
  const source = await readFile(path, 'utf8');
  // Before `npm install` there is none.
  const { parse } = await import('rolldown/utils');
  const { program, comments, errors } = await parse(path, source);
  if (errors.length > 0) throw new Error(`${path}: ${errors[0].message}`);
  /** @type {Node[]} */
  const nodes = program.body.filter(({ type }) => type === 'ExportNamedDeclaration');
  /** @param {Node} node */
  const above = ({ start }) => comments.find(({ end }) => end < start && source.slice(end, start).trim() === '');
  return { source, nodes, above };
}
