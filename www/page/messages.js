/** Texts about photos of pages and their flat pages. */
import { count, number } from '../format.js';

/** @import {PageReport} from '../../pkg/types.js' */

/** Texts about a photo of a page. */
export const PAGE_WORDS = {
  unfound: 'I found no page in this photo. If it shows one, drag the four corners onto it.',
  takeWhole: 'Take the whole photo',
  /** @param {number} corners that are not placed yet */
  unplaced: (corners) => `The flat page appears when ${corners === 4 ? 'all four are placed' : corners === 1 ? 'the last one is placed' : `the other ${count(corners)} are placed, too`}.`,
  noFlat: 'No flat page from this outline.',
  unflattened: 'This outline cannot be made flat.',
  several: 'I found several pages. Take',
  choosePage: (/** @type {number} */ n) => `Page ${n}`,
  tooFarOutside: (/** @type {string} */ edge) => `The ${edge} edge lies too far outside the photo. Take the photo anew, with the whole page in it`,
  looksLike: (/** @type {string} */ paper) => `Looks like ${paper}: use it`,
  light: 'Removes shadows and colour casts. Very pale print may vanish.',
  unfoundFlat: 'No page was found in this photo',
  keptLight: 'Little of the page is plain, light paper, so I kept its light.',
};

/** Texts about several photos that become one PDF. */
export const BOOK_WORDS = {
  photos: (/** @type {number} */ n) => `${count(n)} photos, one PDF:`,
  /** @param {number} n @param {string} name @param {string} [problem] */
  page: (n, name, problem) => `Photo ${n}, ${name}${problem ? ` (not in the PDF: ${problem})` : ''}`,
  ownOptions: ' Format and light are those of this photo; photos that you have not looked at yet begin with this light.',
  earlier: '‹ Earlier',
  later: 'Later ›',
  remove: 'Remove photo',
  undo: 'Undo',
  removed: (/** @type {string} */ name) => `“${name}” is removed.`,
  /** @param {number} added @param {number} all */
  added: (added, all) => `${added === 1 ? 'The photo is' : `${count(added)} photos are`} added: ${count(all)} photos, one PDF.`,
  alone: 'Open it alone',
  unfound: 'no page was found there; show the photo, and drag the four corners onto the page',
  /** @param {readonly string[]} names @param {string} reason */
  without: (names, reason) => `${list.format(names.map((name) => `“${name}”`))}: ${reason}`,
  zip: 'a picture of each page',
  pdf: (/** @type {number} */ n) => `of ${n === 2 ? 'both' : `all ${count(n)}`} photos that show a page`,
  /** @param {number} n @param {number} all */
  writing: (n, all) => `Flattening photo ${n} of ${all}…`,
};

/** Joins words by commas and “and”. */
const list = new Intl.ListFormat('en-GB');

/** The verdict on a flat page, in a sentence. @param {PageReport} report */
export function pageVerdict({ verdict, model, lines }) {
  const text = lines > 0 ? ' and lines of text' : '';
  switch (verdict) {
    case 'flat': return 'Made flat: the page lay flat, and only the perspective was removed.';
    case 'unrolled': return model === 'sheet' || model === 'softSheet' ? `Made flat: folds and bends follow its edges${text}.` : `Made flat: its edges${text} agree.`;
    case 'unchecked': return 'Made flat, but nothing checks the bend.';
    case 'doubtful': return 'Flattened. Please check it against the photo.';
    default: return 'Not reliable: the edges do not fit one page.';
  }
}

/**
 * What may be wrong with a flat page, and what to do about it; the figures tell more.
 * @param {PageReport} report
 * @param {number} [width] of the page in millimetres, if it is known
 */
export function pageErrors(report, width) {
  const { verdict, error, lines, linesFound } = report;
  const text = lines + linesFound > 0 ? ' and lines of text' : '';
  const likely = width === undefined ? '' : ` Points are off by about ${number((error / 100) * width, 1)} mm.`;
  switch (verdict) {
    case 'flat': case 'unrolled': return likely.trim();
    case 'unchecked': return `${lines === 0 ? 'No line' : 'Too few lines'} of text ${lines === 0 ? 'checks' : 'check'} how the page is bent.${likely}`;
    case 'doubtful': return `${doubtWords(report)}.${likely} Correct the outline, or choose the page’s format.`;
    default: return `The edges${text} contradict each other. Correct the outline where it leaves the page.`;
  }
}

/** Why a flat page is doubtful. @param {PageReport} report */
function doubtWords({ doubt }) {
  switch (doubt) {
    case 'hiddenPart': return 'A part of the page hides another part';
    case 'crumpled': return 'The page is crumpled';
    case 'spread': return 'This may be an open book: choose two pages';
    case 'outline': return 'The outline may be wrong';
    default: return 'The photo leaves the bend uncertain';
  }
}

/**
 * Cautions about a flat page.
 * @param {object} about
 * @param {readonly string[]} about.outside names of the corners outside the photo
 * @param {readonly string[]} about.weak names of the edges that are hardly visible
 */
export function pageCautions({ outside, weak }) {
  return [
    ...(outside.length > 0 ? [outside.length === 1 ? `The ${outside[0]} corner is outside the photo.` : `The page is partly outside the photo: its ${list.format(outside)} corners.`] : []),
    ...(weak.length > 0 ? [`The ${list.format(weak)} ${weak.length === 1 ? 'edge is' : 'edges are'} hard to see.`] : []),
  ];
}
