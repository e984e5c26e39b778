/** The documents as pages of the site: links within them, and `llms.txt`. */
import assert from 'node:assert/strict';
import { readFile, readdir, stat } from 'node:fs/promises';
import { dirname, join, relative, resolve } from 'node:path';
import { before, test } from 'node:test';
import { GUIDES, KEPT, writeGuide } from '../../tools/site/guide.mjs';
import { temporaryFolder } from './support/command.mjs';
import { root } from './support/paths.mjs';

const folder = await temporaryFolder();
before(() => writeGuide(folder, { references: true }));

/** @param {string} path */
const exists = (path) => stat(path).then(() => true, () => false);

test('links and pictures of all pages lead somewhere', async () => {
  const names = (await readdir(folder, { recursive: true })).filter((name) => name.endsWith('.html'));
  assert.ok(names.length > GUIDES.length, names.join());
  const pages = new Map(await Promise.all(names.map(async (name) =>
    /** @type {const} */ ([join(folder, name), await readFile(join(folder, name), 'utf8')]))));
  const broken = [];
  let count = 0;
  for (const [page, html] of pages) {
    for (const [, target] of html.matchAll(/(?:href|src)="([^"]+)"/g)) {
      if (/^[a-z]+:/.test(target)) continue;
      const [file, anchor] = target.split('#');
      const there = file ? resolve(dirname(page), file) : page;
      const path = relative(folder, there).replaceAll('\\', '/');
      // Written by others.
      if (path.startsWith('reference/') || path === 'index.html' || path === 'icon.svg') continue;
      count += 1;
      const known = pages.get(there) ?? '';
      if (!(await exists(there)) || (anchor && !known.includes(` id="${anchor}"`))) broken.push(`${relative(folder, page)}: ${target}`);
    }
  }
  assert.ok(count > 300, `${count} links`);
  assert.deepEqual(broken, []);
});

test('pages show what the documents say, without scripts', async () => {
  const html = await readFile(join(folder, 'guide/docs/scans.html'), 'utf8');
  assert.match(html, /<h1 id="clean-up-a-scan">Clean up a scan<\/h1>/);
  assert.match(html, /<a href="docs\/scans\.html"|<a href="\.\.\/docs\/scans\.html" aria-current="page"/);
  assert.match(html, /<th>|<td>/);
  assert.doesNotMatch(html, /<script/);
  for (const path of KEPT) assert.ok(await exists(join(folder, path)), path);
});

test('llms.txt names all guides, as the Markdown that the repository has', async () => {
  const text = await readFile(join(folder, 'llms.txt'), 'utf8');
  assert.match(text, /^# developable\n\n> \S/);
  const links = [...text.matchAll(/^- \[[^\]]+\]\(([^)]+)\)/gm)].map(([, path]) => path);
  for (const { path } of GUIDES.slice(1)) assert.ok(links.includes(`guide/${path}`), path);
  for (const path of links.filter((one) => one.endsWith('.md'))) {
    assert.equal(await readFile(join(folder, path), 'utf8'), await readFile(join(root, path.slice('guide/'.length)), 'utf8'));
  }
});
