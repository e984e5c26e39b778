/** Patterns in names of inputs, which not every shell expands. */
import { statSync } from 'node:fs';
import { sep } from 'node:path';
import { globSync } from '../vendor/tinyglobby.mjs';
import { Problem, status } from './problem.js';

/**
 * The files that an input stands for: those that match it, where it is a pattern that the shell did not expand.
 * @param {string} input
 * @returns {string[]}
 */
export function filesOf(input) {
  if (!/[*?]/.test(input) || statSync(input, { throwIfNoEntry: false }) !== undefined) return [input];
  const pattern = (sep === '/' ? input : input.replaceAll(sep, '/')).replace(/[[\]{}()!\\]/g, '\\$&');
  const matches = globSync(pattern, { expandDirectories: false }).sort();
  if (matches.length === 0) throw new Problem(status.input, `no file matches ${input}`);
  return matches;
}
