/**
 * The table of all modules of the Rust sources, by the first sentence of each module's documentation.
 * `node tools/docs/module-table.mjs` writes it to `MODULES.md`.
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { rustFiles } from './sources.mjs';

const TARGET = 'MODULES.md';

/** @returns {{ path: string, sentence: string }[]} paths below `src/`; an empty sentence for a module without documentation */
export function moduleSentences() {
  return rustFiles(['src']).map((path) => ({ path: path.slice('src/'.length), sentence: firstSentence(readFileSync(path, 'utf8')) }));
}

/** @returns {string} */
export function moduleTable() {
  /** @type {Map<string, string[]>} */
  const rooms = new Map();
  for (const { path, sentence } of moduleSentences()) {
    const [room] = path.replace(/\.rs$/, '').split('/');
    rooms.set(room, [...(rooms.get(room) ?? []), `| \`${path}\` | ${sentence.replaceAll('|', '\\|')} |`]);
  }
  const sections = [...rooms].map(([room, rows]) => `## ${room}\n\n| file | what it is |\n|---|---|\n${rows.join('\n')}\n`);
  return `# Modules\n\nThe files of \`src/\`, each with the first sentence of its documentation. Made by \`npm run modules\`; how they work
together, [ARCHITECTURE.md](ARCHITECTURE.md) says.\n\n${sections.join('\n')}`;
}

/** @param {string} text */
function firstSentence(text) {
  const paragraph = [];
  for (const line of text.split('\n')) {
    if (!line.startsWith('//!') || (line === '//!' && paragraph.length > 0)) break;
    paragraph.push(line.slice(3).trim());
  }
  // Links of rustdoc lead nowhere in a document.
  const plain = paragraph.join(' ').replace(/\[([^\]]+)\]\([^)]*\)/g, '$1').replace(/\[(`[^`]+`)\]/g, '$1');
  return (/^.*?(?<!\b(?:Sec|Eq|Fig|App))[.:](?= [A-Z`]|$)/.exec(plain)?.[0] ?? plain).replace(/:$/, '.');
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) writeFileSync(TARGET, moduleTable());
