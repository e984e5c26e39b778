/**
 * The types of the calls of the synchronous API, `pkg/direct-calls.d.ts`, made from those of the promise API: without promises, and
 * without what only a worker can be given.
 */
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { pkg } from '../util/paths.mjs';

/** @typedef {{ type: string, start: number, end: number, [field: string]: any }} Node of the syntax tree */

/** What a direct call takes instead of these types; nothing instead of those that are empty. @type {Record<string, string>} */
const INSTEAD = { Abortable: '', Blob: '', Drawable: '', HandOver: '', PhotoSource: 'Uint8Array | ArrayBuffer', Watchable: 'Watched' };

export const directTypesFile = join(pkg, 'direct-calls.d.ts');

/** The text of the file. */
export async function directTypes() {
  const [given, own, types, options, results] = await Promise.all(['index', 'direct', 'types', 'option-types', 'result-types'].map((name) => parsed(name)));
  const names = namesIn([...types.nodes, ...options.nodes, ...results.nodes]);
  const isOwn = namesIn(own.nodes);
  const calls = await directCalls();
  const functions = given.nodes.filter(({ declaration }) => declaration.type === 'TSDeclareFunction' && calls.has(declaration.id.name) && !isOwn.has(declaration.id.name));
  const texts = functions.map((node) => `${commentOf(given, node)}${signature(given.source, node.declaration)}`);
  const used = new Set(texts.join('\n').replace(/\/\*\*[^]*?\*\//g, '').match(/\b[A-Z]\w+\b/g));
  /** @param {Set<string>} known */
  const imported = (known) => [...known].filter((name) => used.has(name)).sort().join(', ');
  return `/** Calls of the synchronous API. Made of \`index.d.ts\` by \`tools/build/direct-types.mjs\`. */\n` +
    `import type { ${imported(names)} } from './types.js';\nimport type { ${imported(isOwn)} } from './direct.js';\n\n${texts.join('\n')}\n`;
}

/** The names that the synchronous API exports. */
async function directCalls() {
  const { nodes } = await parsed('direct', 'js');
  return new Set(nodes.flatMap(({ declaration, specifiers }) => [
    ...specifiers.map((/** @type {Node} */ { exported }) => exported.name),
    ...(declaration?.declarations ?? (declaration ? [declaration] : [])).flatMap((/** @type {Node} */ { id }) =>
      (id.type === 'ObjectPattern' ? id.properties.map((/** @type {Node} */ { key }) => key.name) : [id.name])),
  ]));
}

/** The exports of a file of the package. @param {string} name @param {string} [ending] */
async function parsed(name, ending = 'd.ts') {
  const path = join(pkg, `${name}.${ending}`);
  const source = await readFile(path, 'utf8');
  // Before `npm install` there is none.
  const { parse } = await import('rolldown/utils');
  const { program, comments, errors } = await parse(path, source);
  if (errors.length > 0) throw new Error(`${path}: ${errors[0].message}`);
  const nodes = program.body.filter((/** @type {Node} */ node) => node.type === 'ExportNamedDeclaration' && (ending === 'js' || node.declaration));
  return { source, comments, nodes: /** @type {Node[]} */ (/** @type {unknown} */ (nodes)) };
}

/** The names of declarations. @param {Node[]} nodes @returns {Set<string>} */
const namesIn = (nodes) => new Set(nodes.map(({ declaration }) => declaration.id.name));

/** The comment above a declaration: what rejects throws here. @param {Awaited<ReturnType<typeof parsed>>} file @param {Node} node */
function commentOf({ source, comments }, { start }) {
  const above = comments.find(({ end }) => end < start && source.slice(end, start).trim() === '');
  return above ? `${source.slice(above.start, above.end).replace(/\breject(s?)\b/g, 'throw$1')}\n` : '';
}

/** @param {string} source @param {Node} declaration of a function */
function signature(source, { id, typeParameters, params, returnType }) {
  const own = params.flatMap((/** @type {Node} */ { name, optional, typeAnnotation }) => {
    const type = typeText(source, typeAnnotation.typeAnnotation);
    return type === '' ? [] : [`${name}${optional ? '?' : ''}: ${type}`];
  });
  const generic = typeParameters ? source.slice(typeParameters.start, typeParameters.end) : '';
  return `export function ${id.name}${generic}(${own.join(', ')}): ${typeText(source, returnType.typeAnnotation)};`;
}

/** The text of a type without promises and what only a worker takes. @param {string} source @param {Node} type @returns {string} */
function typeText(source, { type, start, end, typeName, typeArguments, types, typeAnnotation }) {
  if (type === 'TSParenthesizedType') return `(${typeText(source, typeAnnotation)})`;
  if (type === 'TSUnionType' || type === 'TSIntersectionType') {
    const parts = types.map((/** @type {Node} */ part) => typeText(source, part)).filter((/** @type {string} */ text) => text !== '');
    return parts.join(type === 'TSUnionType' ? ' | ' : ' & ');
  }
  if (type === 'TSTypeReference' && typeName.name === 'Promise') return typeText(source, typeArguments.params[0]);
  const text = source.slice(start, end);
  return INSTEAD[text] ?? text;
}
