/** The types of options, `pkg/option-types.d.ts`, made from the schema: its kinds, its defaults, and the comments above its rows. */
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from '../util/paths.mjs';
import { main } from '../util/problem.mjs';
import { directTypes, directTypesFile } from './direct-types.mjs';
import { exportsOf } from './exports.mjs';

/** @typedef {import('../../pkg/schema/kinds.js').Options} Options */
/** @typedef {import('./exports.mjs').Node} Node */

const schema = join(root, 'pkg/schema');
export const optionTypesFile = join(root, 'pkg/option-types.d.ts');

/** The modules with rows, and the interface of each set of options. */
const MODULES = {
  fit: { threading: 'ThreadOptions', solver: 'SolverOptions', meshSolver: 'MeshSolverOptions', occlusions: 'OcclusionOptions' },
  shape: {
    analyze: 'AnalyzeOptions', analyzeMesh: 'MeshAnalyzeOptions', patches: 'PatchOptions', patchesMesh: 'MeshPatchOptions', rulings: 'RulingOptions',
    rulingsMesh: 'MeshRulingOptions', unroll: 'UnrollOptions', picture: 'PictureOptions',
  },
  pattern: { pattern: 'PatternOptions', unrollMesh: 'MeshUnrollOptions', patternMesh: 'MeshPatternOptions', writeSvg: 'WriteSvgOptions', writePdf: 'WritePdfOptions' },
  photo: {
    depths: 'DepthOptions', paint: 'PaintOptions', dewarp: 'DewarpOptions', dewarpPage: 'DewarpPageOptions', flattenPhoto: 'FlattenPhotoOptions',
    writePhoto: 'WritePhotoOptions', writeBook: 'WriteBookOptions',
  },
  file: { read: 'ReadOptions', writeImage: 'WriteImageOptions', readMesh: 'ReadMeshOptions', sampleMesh: 'SampleMeshOptions', example: 'ExampleOptions' },
};

/** The text of the file with the types of options. */
export async function optionTypes() {
  /** What is said of a set or a row. @type {Map<object, string>} */
  const docs = new Map();
  /** @type {{ type: string, options: Options }[]} */
  const found = [];
  for (const [module, interfaces] of Object.entries(MODULES)) {
    const path = join(schema, `${module}.js`);
    /** @type {Record<string, Options>} */
    const sets = await import(pathToFileURL(path).href);
    for (const { name, doc, rows } of await setsIn(path)) {
      docs.set(sets[name], doc);
      for (const row of rows.filter((one) => one.doc)) docs.set(sets[name][row.name], row.doc);
    }
    for (const [name, type] of Object.entries(interfaces)) found.push({ type, options: sets[name] });
  }
  const types = found.map(({ type, options }) => {
    const doc = docs.get(options);
    if (!doc) throw new Error(`${type} has no comment in the schema`);
    const members = Object.entries(options).map(([name, option]) => member(`${type}.${name}`, option, docs.get(option)));
    return `\n${comment(doc)}export interface ${type} {\n${members.join('')}}\n`;
  });
  const used = new Set(types.join('').match(/(?<=\?: [^\n]*)\b[A-Z]\w+\b/g));
  const known = [...(await declaredIn('types')), ...(await declaredIn('result-types'))].filter((name) => used.has(name)).sort();
  const head = '/**\n * Options of all calls. Made of `schema/` by `tools/build/option-types.mjs`. *The paper* is Sellán, Aigerman and Jacobson:\n' +
    ' * Developability of Heightfields via Rank Minimization, ACM Transactions on Graphics 39 (4), 2020, doi:10.1145/3386569.3392419.\n */\n';
  return `${head}import type { ${known.join(', ')} } from './types.js';\n${types.join('')}`;
}

/**
 * The sets of options that a module of the schema exports, each with what is said of it and of its rows.
 * @param {string} path
 */
async function setsIn(path) {
  const { nodes, above } = await exportsOf(path);
  /** @param {Node} node */
  const docOf = (node) => textOf(above(node)?.value ?? '');
  return nodes.flatMap((node) => {
    if (node.declaration?.type !== 'VariableDeclaration') return [];
    const [{ id, init }] = node.declaration.declarations;
    if (init?.type !== 'ObjectExpression') return [];
    /** @type {Node[]} */
    const properties = init.properties.filter((/** @type {Node} */ { type }) => type === 'Property');
    const rows = properties.map((row) => ({ name: row.key.name, doc: docOf(row) }));
    return [{ name: id.name, doc: docOf(node), rows }];
  });
}

/** The names of the types that a file declares. @param {string} file */
async function declaredIn(file) {
  const { nodes } = await exportsOf(join(root, `pkg/${file}.d.ts`));
  return nodes.flatMap(({ declaration }) =>
    declaration?.type === 'TSInterfaceDeclaration' || declaration?.type === 'TSTypeAliasDeclaration' ? [declaration.id.name] : []);
}

/** The text of a comment, without what is for the compiler. @param {string} comment */
const textOf = (comment) => comment.replace(/^\*/, '').replace(/@\w+ \{.*\}/, '').replace(/^ *\* ?/gm, '').trim();

/** A text as a comment. @param {string} text @param {string} [indent] */
function comment(text, indent = '') {
  if (!text.includes('\n')) return `${indent}/** ${text} */\n`;
  return `${indent}/**\n${text.split('\n').map((line) => `${indent} * ${line}`.trimEnd()).join('\n')}\n${indent} */\n`;
}

/**
 * An option in the types.
 * @param {string} name
 * @param {import('../../pkg/schema/kinds.js').Option} option
 * @param {string} [doc]
 */
function member(name, { default: value, type, kind }, doc) {
  if (!doc) throw new Error(`${name} has no comment in the schema`);
  const shown = typeof value === 'string' ? `\`'${value}'\`` : String(value);
  const told = value === undefined ? doc : `${doc}${/^- /m.test(doc) ? '\n\n' : doc.includes('\n') ? '\n' : ' '}Default ${shown}.`;
  return `${comment(told, '  ')}  ${name.split('.')[1]}?: ${type ?? kind.type};\n`;
}

/** Writes the types of options into the package, and those of the calls that take them. */
export async function buildOptionTypes() {
  await writeFile(optionTypesFile, await optionTypes());
  await writeFile(directTypesFile, await directTypes());
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) await main(buildOptionTypes);
