/** The types of options, `pkg/option-types.d.ts`, made from the schema: its kinds, its defaults, and the comments above its rows. */
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from '../util/paths.mjs';
import { main } from '../util/problem.mjs';

/** @typedef {import('../../pkg/schema/kinds.js').Options} Options */

const schema = join(root, 'pkg/schema');
export const optionTypesFile = join(root, 'pkg/option-types.d.ts');

/** The modules with rows, and the interface of each set of options. */
const MODULES = {
  fit: { threading: 'ThreadOptions', solver: 'SolverOptions', meshSolver: 'MeshSolverOptions', occlusions: 'OcclusionOptions' },
  shape: {
    analyze: 'AnalyzeOptions', analyzeMesh: 'MeshAnalyzeOptions', patches: 'PatchOptions', rulings: 'RulingOptions',
    meshRulings: 'MeshRulingOptions', unroll: 'UnrollOptions', picture: 'PictureOptions',
  },
  pattern: { pattern: 'PatternOptions', unrollMesh: 'MeshUnrollOptions', patternMesh: 'MeshPatternOptions', writePdf: 'WritePdfOptions' },
  photo: {
    depths: 'DepthOptions', paint: 'PaintOptions', dewarp: 'DewarpOptions', dewarpPage: 'DewarpPageOptions', flattenPhoto: 'FlattenPhotoOptions',
    writePhoto: 'WritePhotoOptions',
  },
  file: { read: 'ReadOptions', readMesh: 'ReadMeshOptions', sampleMesh: 'SampleMeshOptions', example: 'ExampleOptions' },
};

/** A set of rows, and a row, each after the comment above it. */
const SET = /^\/\*\*((?:(?!\*\/)[^])*)\*\/\nexport const (\w+) = (?:\{ .*|\{\n[^]*?\n)\};$/gm;
const ROW = /^ {2}\/\*\*((?:(?!\*\/)[^])*)\*\/\n {2}(\w+): \{/gm;

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
    for (const [whole, about, name] of (await readFile(path, 'utf8')).matchAll(SET)) {
      docs.set(sets[name], textOf(about));
      for (const [, comment, option] of whole.matchAll(ROW)) docs.set(sets[name][option], textOf(comment));
    }
    for (const [name, type] of Object.entries(interfaces)) found.push({ type, options: sets[name] });
  }
  const types = found.map(({ type, options }) => {
    const members = Object.entries(options).map(([name, option]) => member(`${type}.${name}`, option, docs.get(option)));
    return `\n${comment(docs.get(options) ?? '')}export interface ${type} {\n${members.join('')}}\n`;
  });
  const declared = (await readFile(join(root, 'pkg/types.d.ts'), 'utf8')).matchAll(/^export (?:interface|type) (\w+)/gm);
  const used = Array.from(declared, ([, name]) => name).filter((name) => new RegExp(`\\?: .*\\b${name}\\b`).test(types.join('')));
  const head = '/** Options of all calls. Made of `schema/` by `tools/build/option-types.mjs`. */\n';
  return `${head}import type { ${used.sort().join(', ')} } from './types.js';\n${types.join('')}`;
}

/** The text of a comment, without what is for the compiler. @param {string} comment */
const textOf = (comment) => comment.replace(/@\w+ \{.*\}/, '').replace(/^ *\* ?/gm, '').trim();

/** A text as a comment. @param {string} text @param {string} [indent] */
function comment(text, indent = '') {
  if (text === '') return '';
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

/** Writes the types of options into the package. */
export async function buildOptionTypes() {
  await writeFile(optionTypesFile, await optionTypes());
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) await main(buildOptionTypes);
