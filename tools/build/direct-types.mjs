/**
 * The types of the calls of the synchronous API, `pkg/direct-calls.d.ts`, made from those of the promise API: without promises, and
 * without what only a worker can be given.
 */
import { join } from 'node:path';
import { pkg } from '../util/paths.mjs';
import { exportsOf } from './exports.mjs';

/** @typedef {import('./exports.mjs').Node} Node */

/** What a direct call takes instead of these types; nothing instead of those that are empty. @type {Record<string, string>} */
const INSTEAD = { Abortable: '', Blob: '', Drawable: '', HandOver: '', PhotoSource: 'Uint8Array | ArrayBuffer', Watchable: 'Watched' };

export const directTypesFile = join(pkg, 'direct-calls.d.ts');

/** The text of the file. */
export async function directTypes() {
  const [given, own, types, options, results] = await Promise.all(['index', 'direct', 'types', 'option-types', 'result-types'].map(declared));
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
  const { nodes } = await exportsOf(join(pkg, 'direct.js'));
  return new Set(nodes.flatMap(({ declaration, specifiers }) => [
    ...specifiers.map((/** @type {Node} */ { exported }) => exported.name),
    ...(declaration?.declarations ?? (declaration ? [declaration] : [])).flatMap((/** @type {Node} */ { id }) =>
      (id.type === 'ObjectPattern' ? id.properties.map((/** @type {Node} */ { key }) => key.name) : [id.name])),
  ]));
}

/** The types that a file of the package declares. @param {string} name */
async function declared(name) {
  const { nodes, ...file } = await exportsOf(join(pkg, `${name}.d.ts`));
  return { ...file, nodes: nodes.filter(({ declaration }) => declaration) };
}

/** The names of declarations. @param {Node[]} nodes @returns {Set<string>} */
const namesIn = (nodes) => new Set(nodes.map(({ declaration }) => declaration.id.name));

/** The comment above a declaration: what rejects throws here. @param {Awaited<ReturnType<typeof declared>>} file @param {Node} node */
function commentOf({ source, above }, node) {
  const { start, end } = above(node) ?? { start: 0, end: 0 };
  return start < end ? `${source.slice(start, end).replace(/\breject(s?)\b/g, 'throw$1')}\n` : '';
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
