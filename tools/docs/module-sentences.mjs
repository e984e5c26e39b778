/** The first sentence of each module's documentation in the Rust sources. */
import { readFileSync } from 'node:fs';
import { rustFiles } from './sources.mjs';

/** @returns {{ path: string, sentence: string }[]} paths below `src/`; an empty sentence for a module without documentation */
export function moduleSentences() {
  return rustFiles(['src']).map((path) => ({ path: path.slice('src/'.length), sentence: firstSentence(readFileSync(path, 'utf8')) }));
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
