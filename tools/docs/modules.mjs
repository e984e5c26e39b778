/**
 * Which module of the Rust sources depends on which: by the paths that begin with `crate`, `self`, `super` or a child module,
 * in `use` and elsewhere. Code of tests does not count. A path to a name that a module imports or re-exports is one to the
 * module that it comes from, and a re-export is no dependency itself.
 */
import { readFileSync, readdirSync } from 'node:fs';
import { join, sep } from 'node:path';
import { root } from '../util/paths.mjs';

/** @typedef {Map<string, Set<string>>} Graph  The modules that each module depends on, by their paths below `src/`. */
/**
 * @typedef {object} Module
 * @property {string[]} path
 * @property {string} code
 * @property {Map<string, string[]>} imported  Paths of the names that it imports or re-exports.
 */

/** An item that is compiled for tests only: the code of a module, a function or a line. */
export const TEST_ITEM = /^( *)#\[cfg\((?:all\()?test\b[^\n]*\] *\n(?:\1#\[[^\n]*\n)*\1[^\n]*(?:;\n|\{\n(?:[^\n]*\n)*?\1\}\n?|(?<=\})\n)/gm;

/** The sources of the library without files of tests, by their paths below `src/`, as in `fit/mod.rs`. */
export function librarySources() {
  const names = readdirSync(join(root, 'src'), { encoding: 'utf8', recursive: true }).map((name) => name.split(sep).join('/'));
  const own = names.filter((name) => name.endsWith('.rs') && !/(?:^|\/)tests(?:\.rs$|\/)/.test(name)).sort();
  return new Map(own.map((name) => [name, readFileSync(join(root, 'src', name), 'utf8')]));
}

/** The graph of the checkout. @returns {Graph} */
export function moduleGraph() {
  /** @type {Map<string, Module>} */
  const modules = new Map();
  for (const [file, text] of librarySources()) {
    const path = file.replace(/\.rs$/, '').replace(/(^|\/)(mod|lib)$/, '').split('/').filter(Boolean);
    modules.set(path.join('::'), { path, code: withoutTests(text), imported: new Map() });
  }
  for (const module of modules.values()) findImports(module, modules);
  return new Map([...modules].filter(([name]) => name !== '').map(([name, module]) => [name, dependencies(module, modules)]));
}

/**
 * Groups of modules that depend on each other in a circle.
 * @param {Graph} graph
 * @returns {string[][]}
 */
export function circles(graph) {
  const names = [...graph.keys()].sort();
  const reach = new Map(names.map((name) => [name, reachable(graph, name)]));
  const mutual = (/** @type {string} */ a, /** @type {string} */ b) => reach.get(a)?.has(b) && reach.get(b)?.has(a);
  /** @type {Set<string>} */
  const seen = new Set();
  return names.flatMap((name) => {
    if (seen.has(name) || !reach.get(name)?.has(name)) return [];
    const group = names.filter((other) => mutual(name, other));
    group.forEach((member) => seen.add(member));
    return [group];
  });
}

/**
 * @param {Graph} graph
 * @param {string} from
 */
function reachable(graph, from) {
  /** @type {Set<string>} */
  const found = new Set();
  const pending = [from];
  for (let name = pending.pop(); name !== undefined; name = pending.pop()) {
    for (const next of graph.get(name) ?? []) {
      if (!found.has(next)) {
        found.add(next);
        pending.push(next);
      }
    }
  }
  return found;
}

/**
 * A source without comments, strings and code of tests.
 * @param {string} text
 */
function withoutTests(text) {
  const code = text.replace(/\/\/[^\n]*/g, '').replace(/"(?:[^"\\]|\\.)*"/g, '""');
  return code.replace(TEST_ITEM, '');
}

/**
 * @param {Module} module
 * @param {Map<string, Module>} modules
 */
function findImports(module, modules) {
  for (const [, tree] of module.code.matchAll(/\buse ([^;]+);/g)) {
    for (const path of leaves(tree)) {
      const absolute = resolve(path, module, modules);
      if (absolute) module.imported.set(absolute[absolute.length - 1], absolute);
    }
  }
  module.code = module.code.replace(/\bpub(?:\([^)]*\))? use [^;]+;/g, '');
}

/**
 * @param {Module} module
 * @param {Map<string, Module>} modules
 */
function dependencies(module, modules) {
  const own = module.path.join('::');
  const used = [...module.code.matchAll(/\buse ([^;]+);/g)].flatMap(([, tree]) => leaves(tree));
  const inline = module.code.replace(/\buse [^;]+;/g, '').matchAll(/(?<![\w:])(\w+(?:::\w+)+)/g);
  /** @type {Set<string>} */
  const found = new Set();
  for (const path of [...used, ...[...inline].map(([, path]) => path.split('::'))]) {
    const absolute = resolve(path, module, modules);
    const target = absolute && owner(absolute, modules);
    if (target && target !== own) found.add(target);
  }
  return found;
}

/**
 * The paths of a tree like `a::{b, c::{d as e}}`.
 * @param {string} tree
 * @returns {string[][]}
 */
function leaves(tree) {
  const text = tree.replace(/\s+/g, ' ').trim();
  const open = text.indexOf('{');
  if (open < 0) return [text.replace(/ as .*/, '').split('::').map((part) => part.trim())];
  const prefix = text.slice(0, open).split('::').map((part) => part.trim()).filter(Boolean);
  /** @type {string[]} */
  const parts = [''];
  let depth = 0;
  for (const char of text.slice(open + 1, text.lastIndexOf('}'))) {
    if (char === '{') depth += 1;
    if (char === '}') depth -= 1;
    if (char === ',' && depth === 0) parts.push('');
    else parts[parts.length - 1] += char;
  }
  const inner = parts.filter((part) => part.trim() !== '').flatMap(leaves);
  return inner.map((path) => [...prefix, ...path.filter((part, i) => part !== 'self' || i > 0)]);
}

/**
 * A path from the crate's root; nothing for one of another crate.
 * @param {string[]} path
 * @param {Module} module
 * @param {Map<string, Module>} modules
 * @returns {string[] | undefined}
 */
function resolve(path, module, modules) {
  if (path[0] === 'crate') return path.slice(1);
  const base = [...module.path];
  let start = 0;
  for (; path[start] === 'super' || path[start] === 'self'; start += 1) {
    if (path[start] === 'super') base.pop();
  }
  const absolute = [...base, ...path.slice(start)];
  return start > 0 || modules.has([...base, path[0]].join('::')) ? absolute : undefined;
}

/**
 * The module that a name comes from, behind all re-exports.
 * @param {string[]} path
 * @param {Map<string, Module>} modules
 * @returns {string | undefined}
 */
function owner(path, modules) {
  for (let length = path.length; length > 0; length -= 1) {
    const module = modules.get(path.slice(0, length).join('::'));
    if (!module) continue;
    const imported = module.imported.get(path[length]);
    return imported ? owner(imported, modules) : path.slice(0, length).join('::');
  }
  const imported = modules.get('')?.imported.get(path[0]);
  return imported && owner(imported, modules);
}
