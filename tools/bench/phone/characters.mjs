/** What an OCR program reads, against what is printed. */
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { run } from '../../util/process.mjs';

/** The program, from the package tesseract-ocr of Debian and Ubuntu, or tesseract of Homebrew. */
const program = 'tesseract';

/** Why there is none, in plain words, or nothing. */
export async function missingReader() {
  const { ok, failure } = await run(program, ['--version']);
  return ok ? undefined : `${program} cannot be used (${failure}): to have character errors, install it with its English `
    + 'data (apt install tesseract-ocr, or brew install tesseract); they are left out.';
}

/**
 * @param {string} folder for the image and its text
 * @param {Uint8Array} png
 * @param {number} dpi
 */
export async function read(folder, png, dpi) {
  const [file, text] = [join(folder, 'read.png'), join(folder, 'text')];
  await writeFile(file, png);
  // To a file: what it says of the image goes to the same terminal as the text, and would be counted as errors.
  const args = [file, text, '--dpi', String(dpi), '-l', 'eng', 'txt'];
  const { ok, failure } = await run(program, args, { env: { ...process.env, OMP_THREAD_LIMIT: '1' } });
  // A page on which it finds no text at all is one, too.
  if (!ok) return failure.startsWith('exit') ? '' : Promise.reject(new Error(failure));
  return readFile(`${text}.txt`, 'utf8');
}

/** Each gap one space, and quotation marks and dashes of one kind. @param {string} text */
export function plain(text) {
  return text.replace(/[\u2018\u2019]/g, "'").replace(/[\u201c\u201d]/g, '"').replace(/[\u2013\u2014]/g, '-')
    .replace(/\s+/g, ' ').trim();
}

/**
 * Levenshtein's: least number of characters to put in, leave out or change.
 * @param {string} from
 * @param {string} to
 */
export function distance(from, to) {
  let last = Uint32Array.from({ length: to.length + 1 }, (_, j) => j);
  let row = new Uint32Array(to.length + 1);
  for (let i = 1; i <= from.length; i += 1) {
    row[0] = i;
    for (let j = 1; j <= to.length; j += 1) {
      const changed = last[j - 1] + Number(from[i - 1] !== to[j - 1]);
      row[j] = Math.min(changed, last[j] + 1, row[j - 1] + 1);
    }
    [last, row] = [row, last];
  }
  return last[to.length];
}

/**
 * Character error rate: errors for each character that is printed.
 * @param {string} found
 * @param {string} printed
 */
export function errorRate(found, printed) {
  const truth = plain(printed);
  return distance(plain(found), truth) / truth.length;
}
