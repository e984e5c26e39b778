/** The verdict on a flat page in words. */

import { DevelopableError } from './errors.js';
import { record } from './values.js';

/** @typedef {import('./types.js').PageReport} PageReport */

/** Smallest disagreement that is told as a share of the page's width, in %: less is no reason. */
const MIN_TOLD_DISAGREEMENT = 0.005;

/** A percentage with two digits. @param {number} value in % */
const percent = (value) => `${Number(value.toPrecision(2))} %`;

/** Why a flat page is doubtful, with the words before what it means. @param {PageReport} report */
function doubtWords({ doubt }) {
  switch (doubt) {
    case 'hiddenPart': return 'a part of it hides another part; ';
    case 'crumpled': return 'it is crumpled; ';
    case 'spread': return 'it may be both pages of an open book, which are to be given as two pages; ';
    case 'outline': return 'its outline may be wrong; if it is right, ';
    default: return '';
  }
}

/** Figures of a report that sentences state. */
const FIGURES = /** @type {const} */ (['error', 'errorBound', 'disagreement', 'residual', 'lines', 'linesFound']);

/** @type {typeof import('./index.js').describePage} */
export function describePage(given) {
  const said = record('INPUT', 'the report', given, [...FIGURES, 'verdict', 'doubt', 'model']);
  if (!FIGURES.every((name) => typeof said[name] === 'number')) {
    throw new DevelopableError('INPUT', 'the report must be that of a page, as `dewarpPage` returns it');
  }
  const report = /** @type {PageReport} */ (said);
  const { verdict, model, error, errorBound, disagreement, residual, lines, linesFound } = report;
  const text = lines + linesFound > 0 ? ' and lines of text' : '';
  const likely = `expected error ${percent(error)} of its width (95 %: below ${percent(errorBound)})`;
  // Where both edges agree on the whole, single points are off.
  const off = disagreement < MIN_TOLD_DISAGREEMENT ? `by ${residual.toFixed(1)} pixels` : `by ${percent(disagreement)} of its width`;
  switch (verdict) {
    case 'flat':
      return 'the page lay flat: only the perspective was taken out';
    case 'unchecked':
      return `${lines === 0 ? 'no line' : 'too few lines'} of text check${lines === 0 ? 's' : ''} how the page is bent; if its edges are right: ${likely}`;
    case 'doubtful':
      return `the flat page is doubtful: ${doubtWords(report)}${likely}`;
    case 'notThisKind':
      if (model !== 'cylinder') return `no sheet of paper has these edges (off ${off}): correct them`;
      return `this is no page that is curled one way: its edges${text} disagree (${off}); ` +
        'correct an edge that leaves the page, or give all four where only two were given';
    default:
      return `the page is flat; ${likely}`;
  }
}
