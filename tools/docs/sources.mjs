/** The Rust sources of the checkout. */
import { existsSync, readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { root } from '../util/paths.mjs';

/**
 * Paths, relative to the checkout, of all Rust files at or below some of its paths, without files of tests.
 * @param {string[]} under
 */
export function rustFiles(under) {
  process.chdir(root);
  return under.filter((path) => existsSync(path)).flatMap(walk);
}

/**
 * @param {string} path
 * @returns {string[]}
 */
function walk(path) {
  if (statSync(path).isFile()) return path.endsWith('.rs') ? [path] : [];
  return readdirSync(path)
    .filter((name) => !['target', 'tests', 'tests.rs', 'node_modules'].includes(name))
    .sort()
    .flatMap((name) => walk(join(path, name)));
}
