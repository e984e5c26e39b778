/** The documents of the repository as pages, in the folders that they have there, and `llms.txt` about them. */
import { copyFile, mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, extname, join, posix, relative, sep } from 'node:path';
import { root, www } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';

/**
 * @typedef {{ path: string, text: string, title: string, about: string, html: string, pictures: string[] }} Document
 * `path`: in the repository, with slashes
 * @typedef {{ name: string, path: string }} Entry of the navigation
 */

/** Where everything begins. */
const START = 'README.md';

/** The guides, in the order of the navigation; they are kept for use without a network as soon as the page is. */
export const GUIDES = [
  { name: 'Overview', path: START },
  { name: 'Scans', path: 'docs/scans.md' },
  { name: 'Photos of pages', path: 'docs/dewarp.md' },
  { name: 'Paper and metal models', path: 'docs/patterns.md' },
  { name: 'Meshes', path: 'docs/meshes.md' },
  { name: 'Command', path: 'docs/command.md' },
  { name: 'Web page', path: 'docs/page.md' },
  { name: 'npm package', path: 'pkg/README.md' },
  { name: 'Glossary', path: 'docs/glossary.md' },
];

const REFERENCES = [
  { name: 'npm package', path: 'reference/package/index.html' },
  { name: 'Rust crate', path: 'reference/rust/developable/index.html' },
];

/** For people who change the code. */
const MORE = [
  { name: 'Benchmarks', path: 'benches/README.md' },
  { name: 'Architecture', path: 'ARCHITECTURE.md' },
  { name: 'Contributing', path: 'CONTRIBUTING.md' },
  { name: 'Changes', path: 'CHANGELOG.md' },
  { name: 'Security', path: 'docs/SECURITY.md' },
];

/** @param {string} path of a document */
const pageOf = (path) => path.replace(/\.md$/, '.html');

/** The pages that are kept for use without a network at once. */
export const KEPT = ['guide.css', 'offline.html', ...GUIDES.map(({ path }) => pageOf(path))].map((path) => `guide/${path}`);

/** @param {string} text */
const escaped = (text) => text.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);

/**
 * Writes `guide/` and `llms.txt`.
 * @param {string} folder the site's
 * @param {{ references: boolean }} options whether there are references to be linked
 */
export async function writeGuide(folder, { references }) {
  const documents = await collect();
  for (const document of documents) {
    const { path, text, title, html, pictures } = document;
    await put(folder, `guide/${path}`, text);
    await put(folder, `guide/${pageOf(path)}`, framed({ path: pageOf(path), title, html, references }));
    for (const picture of pictures) await copy(picture, join(folder, 'guide', picture));
  }
  const missing = [...GUIDES, ...MORE].filter(({ path }) => !documents.some((one) => one.path === path));
  if (missing.length > 0) throw new Problem(`No document links to ${missing.map(({ path }) => path).join(', ')}.`);
  await put(folder, 'guide/offline.html', framed({ path: 'offline.html', title: 'Not kept', references, html: UNKEPT }));
  const styles = await Promise.all(['css/base.css', 'site/guide.css'].map((name) => readFile(join(www, name), 'utf8')));
  await put(folder, 'guide/guide.css', styles.join('\n'));
  await put(folder, 'llms.txt', about(documents, references));
}

const UNKEPT = '<h1>Not kept</h1>\n<p>This page was not opened before, and there is no network to get it from. '
  + 'The guides are kept; pages of the reference are once they were opened.</p>';

/** The start and every document that links lead to. */
async function collect() {
  /** @type {Map<string, Document>} */
  const documents = new Map();
  const waiting = [START];
  for (let path = waiting.pop(); path !== undefined; path = waiting.pop()) {
    if (documents.has(path)) continue;
    const { linked, ...document } = await rendered(path);
    documents.set(path, document);
    waiting.push(...linked);
  }
  return [...documents.values()].sort((a, b) => (a.path < b.path ? -1 : 1));
}

/**
 * A document as HTML, with links to other documents leading to their pages.
 * @param {string} path
 * @returns {Promise<Document & { linked: string[] }>}
 */
async function rendered(path) {
  // Only now: on a fresh clone they have just been installed.
  const [{ Marked }, { gfmHeadingId }] = await Promise.all([import('marked'), import('marked-gfm-heading-id')]);
  const text = await readFile(join(root, path), 'utf8');
  /** @type {string[]} */
  const linked = [];
  /** @type {string[]} */
  const pictures = [];
  /** @param {string} target */
  const inRepository = (target) => posix.normalize(posix.join(posix.dirname(path), target));
  const marked = new Marked(gfmHeadingId(), {
    walkTokens(token) {
      if (token.type === 'image') pictures.push(inRepository(token.href));
      if (token.type === 'code') token.lang = token.lang?.split(',')[0];
      if (token.type !== 'link' || /^(?:[a-z]+:|#)/.test(token.href)) return;
      const [file, anchor] = token.href.split('#');
      if (extname(file) !== '.md') throw new Problem(`${path} links to ${file}, which is no document.`);
      linked.push(inRepository(file));
      token.href = pageOf(file) + (anchor ? `#${anchor}` : '');
    },
  });
  const html = (await marked.parse(text))
    // Wide ones scroll by themselves, also by keyboard.
    .replaceAll('<table>', '<div class="wide" tabindex="0" role="group" aria-label="Table"><table>')
    // A corner without words is no header.
    .replaceAll(/<th([^>]*)><\/th>/g, '<td$1></td>')
    .replaceAll('</table>', '</table></div>')
    .replaceAll('<pre>', '<pre tabindex="0">');
  const tokens = marked.lexer(text);
  /** The text of the first token of a kind. @param {'heading' | 'paragraph'} type */
  const first = (type) => {
    const token = tokens.find((one) => one.type === type);
    return token && 'text' in token ? String(token.text) : '';
  };
  return { path, text, title: first('heading') || path, about: plain(first('paragraph')), html, pictures, linked };
}

/** The first paragraph without marks and line breaks. @param {string} markdown */
const plain = (markdown) => markdown.replace(/\[([^\]]*)\]\([^)]*\)/g, '$1').replace(/\s+/g, ' ').replace(/[*`]/g, '').trim();

/**
 * A page around what it shows.
 * @param {{ path: string, title: string, html: string, references: boolean }} page `path`: in `guide/`
 */
function framed({ path, title, html, references }) {
  const up = '../'.repeat(path.split('/').length - 1);
  /** @param {Entry} entry @param {string} href */
  const item = ({ name, path: own }, href) =>
    `<li><a href="${href}"${pageOf(own) === path ? ' aria-current="page"' : ''}>${name}</a></li>`;
  /** @param {string} heading @param {string[]} items */
  const list = (heading, items) => `<h2>${heading}</h2>\n<ul>\n${items.join('\n')}\n</ul>`;
  const lists = [
    list('Guides', GUIDES.map((entry) => item(entry, up + pageOf(entry.path)))),
    ...(references ? [list('API reference', REFERENCES.map((entry) => item(entry, `${up}../${entry.path}`)))] : []),
    list('The project', MORE.map((entry) => item(entry, up + pageOf(entry.path)))),
  ];
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src 'self'; style-src 'self'">
<title>${escaped(title === 'developable' ? title : `${title} – developable`)}</title>
<link rel="icon" href="${up}../icon.svg" type="image/svg+xml">
<link rel="stylesheet" href="${up}guide.css">
</head>
<body class="guide">
<a class="skip" href="#text">Skip to the text</a>
<nav aria-label="Documentation">
<p><a href="${up}../index.html">Open the web page</a></p>
${lists.join('\n')}
</nav>
<main id="text">
${html}
</main>
</body>
</html>
`;
}

/**
 * What there is to read, for programs that read.
 * @param {Document[]} documents
 * @param {boolean} references
 */
function about(documents, references) {
  /** @param {Entry} entry */
  const line = ({ name, path }) => `- [${name}](guide/${path}): ${documents.find((one) => one.path === path)?.about}`;
  const start = documents.find(({ path }) => path === START);
  return [
    `# ${start?.title}`,
    `> ${start?.about}`,
    '## Guides',
    GUIDES.filter(({ path }) => path !== START).map(line).join('\n'),
    ...(references ? ['## API reference', REFERENCES.map(({ name, path }) => `- [${name}](${path})`).join('\n')] : []),
    '## Optional',
    MORE.map(line).join('\n'),
  ].join('\n\n') + '\n';
}

/** @param {string} folder @param {string} path @param {string} text */
async function put(folder, path, text) {
  const place = join(folder, path);
  await mkdir(dirname(place), { recursive: true });
  await writeFile(place, text);
}

/** @param {string} path in the repository @param {string} place */
async function copy(path, place) {
  if (relative(root, join(root, path)).split(sep)[0] === '..') throw new Problem(`${path} is outside of the repository.`);
  await mkdir(dirname(place), { recursive: true });
  await copyFile(join(root, path), place);
}
