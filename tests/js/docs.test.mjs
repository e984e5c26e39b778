/** The documents: links that resolve, commands and options that exist, names that the package exports. */
import assert from 'node:assert/strict';
import { mkdir, readFile, readdir, stat, writeFile } from 'node:fs/promises';
import { dirname, join, relative, resolve } from 'node:path';
import { test } from 'node:test';
import * as api from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { parse, temporaryFolder } from './support/command.mjs';
import { root } from './support/paths.mjs';

const skipped = new Set(['node_modules', 'target', 'site', 'test-results', '.git']);

/** @param {string} folder @returns {Promise<string[]>} all Markdown files of the repository */
async function documents(folder) {
  const entries = await readdir(folder, { withFileTypes: true });
  const found = await Promise.all(entries.filter(({ name }) => !skipped.has(name)).map((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return documents(path);
    return entry.name.endsWith('.md') ? [path] : [];
  }));
  return found.flat();
}

// What is there while the package is packed is a copy.
const paths = (await documents(root)).filter((path) => !path.startsWith(join(root, 'pkg/docs')));
const texts = new Map(await Promise.all(paths.map(async (path) => /** @type {const} */ ([path, await readFile(path, 'utf8')]))));

/** @param {string} text */
const withoutCode = (text) => text.replace(/^```[^]*?^```/gm, '').replace(/`[^`\n]*`/g, '`');

/** The anchors that GitHub gives to the headings of a document. @param {string} text */
function anchors(text) {
  const headings = text.replace(/^```[^]*?^```/gm, '').matchAll(/^#+ +(.+)$/gm);
  return new Set([...headings].map(([, heading]) =>
    heading.trim().toLowerCase().replace(/[^\p{L}\p{N}\p{M} _-]/gu, '').replaceAll(' ', '-')));
}

/** @param {string} kind @param {string} text */
const blocks = (kind, text) => [...text.matchAll(new RegExp(`^\`\`\`${kind}\\n([^]*?)^\`\`\``, 'gm'))].map(([, code]) => code);

test('links in documents lead to files and headings that exist', async () => {
  assert.ok(paths.length > 10, `${paths.length} documents`);
  const broken = [];
  let links = 0;
  for (const [path, text] of texts) {
    for (const [, target] of withoutCode(text).matchAll(/\]\(([^()\s]+)\)/g)) {
      if (/^[a-z]+:/.test(target)) continue;
      links += 1;
      const [file, anchor] = target.split('#');
      const there = file ? resolve(dirname(path), file) : path;
      const exists = await stat(there).then(() => true, () => false);
      const known = exists && (!anchor || anchors(texts.get(there) ?? '').has(anchor));
      if (!known) broken.push(`${relative(root, path)}: ${target}`);
    }
  }
  assert.ok(links > 50, `${links} links`);
  assert.deepEqual(broken, []);
});

test('every document of docs/ is linked from the README', () => {
  const readme = texts.get(join(root, 'README.md')) ?? '';
  const direct = [...texts.keys()].filter((path) => dirname(path) === join(root, 'docs')).map((path) => relative(root, path));
  // The pictures of scenes are linked where energies are compared.
  const missing = direct.filter((path) => path !== 'docs/scenes.md' && !readme.includes(`(${path})`));
  assert.deepEqual(missing, []);
});

test('the README stays short', () => {
  const lines = texts.get(join(root, 'README.md'))?.trimEnd().split('\n').length ?? Infinity;
  assert.ok(lines <= 150, `${lines} lines`);
});

test('commands in documents are understood', async () => {
  // Patterns of the documents match something here.
  const folder = await temporaryFolder();
  await mkdir(join(folder, 'scans'));
  await writeFile(join(folder, 'scans/scan.npy'), '');
  process.chdir(folder);
  const wrong = [];
  let count = 0;
  for (const [path, text] of texts) {
    for (const line of blocks('sh', text).flatMap((block) => block.split('\n'))) {
      const [, words] = /^(?:npx )?developable (.*)$/.exec(line.replace(/ +#.*$/, '').trim()) ?? [];
      if (!words) continue;
      count += 1;
      try {
        const args = words.split(' ').map((word) => word.replace(/^'(.*)'$/, '$1'));
        parse(args);
      } catch (error) {
        wrong.push(`${relative(root, path)}: ${line}: ${error instanceof Error ? error.message : error}`);
      }
    }
  }
  assert.ok(count > 30, `${count} commands`);
  assert.deepEqual(wrong, []);
});

test('examples import what the package exports', () => {
  const exported = { developable: api, 'developable/direct': direct };
  const wrong = [];
  let count = 0;
  for (const [path, text] of texts) {
    for (const code of [...blocks('js', text), ...blocks('html', text)]) {
      for (const [, names, from] of code.matchAll(/import \{([^}]+)\} from '(developable(?:\/direct)?)'/g)) {
        for (const name of names.split(',').map((one) => one.trim()).filter(Boolean)) {
          count += 1;
          if (!(name in exported[/** @type {keyof typeof exported} */ (from)])) wrong.push(`${relative(root, path)}: ${name}`);
        }
      }
    }
  }
  assert.ok(count > 20, `${count} names`);
  assert.deepEqual(wrong, []);
});
