/** The schema of options beside what is made of it: the types, the flags and the help. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { parse } from 'rolldown/utils';
import { commands } from '../../pkg/cli/commands.js';
import { helpOn } from '../../pkg/cli/command-line.js';
import { flagName } from '../../pkg/cli/flags.js';
import { OPTIONS } from '../../pkg/options.js';
import { directTypes, directTypesFile } from '../../tools/build/direct-types.mjs';
import { optionTypes, optionTypesFile } from '../../tools/build/option-types.mjs';

/** Functions that do something else in each API. */
const APART = ['init'];

/** @typedef {import('../../pkg/schema/kinds.js').Options} Options */

test('the types of options are those of the schema', async () => {
  const text = await readFile(optionTypesFile, 'utf8');
  assert.equal(text, await optionTypes(), 'build the package again');
});

test('the types of direct calls are those of the promise API, without promises and what only a worker takes', async () => {
  const text = await readFile(directTypesFile, 'utf8');
  assert.equal(text, await directTypes(), 'build the package again');
  assert.doesNotMatch(text, /Promise|Blob|Abortable|HandOver|reject/);
  assert.ok(text.includes('export function unroll(input: HeightImage | Heightfield, options?: UnrollOptions & Watched): Unrolling;'));
  assert.ok(text.includes('export function findPage(photo: Photo | Uint8Array | ArrayBuffer): PageOutlines;'));
});

/** Names that inherit what is said of them, as their types are only narrower. */
const INHERITED = ['LatticeSurface.image', 'SampledMesh.origin', 'SampledMesh.heights', 'SampledMesh.frame'];

test('every type, field and function has a comment, and a function says the same in both APIs', async () => {
  /** What is said of a function, and of what it takes first, by the first API. @type {Map<string, string>} */
  const functions = new Map();
  let count = 0;
  for (const file of ['types', 'option-types', 'result-types', 'index', 'direct-calls', 'direct', 'sync', 'errors', 'camera-file']) {
    const source = await readFile(new URL(`../../pkg/${file}.d.ts`, import.meta.url), 'utf8');
    const { program, comments } = await parse(`${file}.d.ts`, source);
    /** @param {{ start: number }} node @param {string} name */
    const said = ({ start }, name) => {
      const above = comments.find(({ end }) => end < start && source.slice(end, start).trim() === '');
      assert.ok(above?.value.startsWith('*') || INHERITED.includes(name), `${file}.d.ts: ${name} has no comment`);
      count += 1;
      return above?.value ?? '';
    };
    for (const node of program.body) {
      if (node.type !== 'ExportNamedDeclaration' || !node.declaration) continue;
      const { declaration } = node;
      if (declaration.type === 'TSDeclareFunction') {
        const name = declaration.id?.name ?? '';
        const [sentence] = said(node, name).replace(/^ ?\*+ ?/gm, '').trim().split(/\.\s/);
        if (APART.includes(name)) continue;
        const own = `${name} of ${source.slice(declaration.params[0]?.start, declaration.params[0]?.end)}`;
        assert.equal(functions.get(own) ?? sentence, sentence, `${own} in ${file}.d.ts`);
        functions.set(own, sentence);
      } else if ('id' in declaration && declaration.id?.type === 'Identifier') {
        const { name } = declaration.id;
        // A second declaration, as of a class and of what it has besides, may leave it to the first.
        said(node, name);
        const members = 'body' in declaration && declaration.body && 'body' in declaration.body ? declaration.body.body : [];
        for (const member of members) {
          if ('key' in member && member.key.type === 'Identifier' && !('computed' in member && member.computed)) said(member, `${name}.${member.key.name}`);
        }
      }
    }
  }
  assert.ok(count > 500, `${count} comments`);
});

test('each flag of the schema is in the help of a command, with its value and what it does', () => {
  const told = /** @type {import('../../pkg/cli/commands.js').CommandName[]} */ (Object.keys(commands)).map(helpOn).join('').replace(/\s+/g, ' ');
  let count = 0;
  for (const options of /** @type {Options[]} */ (Object.values(OPTIONS))) {
    for (const [name, option] of Object.entries(options)) {
      const { flag } = option;
      if (flag === undefined) continue;
      count += 1;
      const spelled = `--${flagName(name, option)}${flag.value === undefined ? '' : ` <${flag.value}>`}`;
      assert.ok(told.includes(spelled), spelled);
      // A command may have words of its own for it.
      assert.ok(told.includes(flag.help) || name === 'threshold', flag.help);
    }
  }
  assert.ok(count > 60, `${count} flags`);
});
