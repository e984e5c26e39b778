/** The verdict on a flat page in words. */

import { DevelopableError } from './errors.js';
import { record } from './values.js';

/** @typedef {import('./types.js').PageReport} PageReport */

/** Smallest disagreement that is told as a share of the page's width, in %: less is no reason. */
const MIN_TOLD_DISAGREEMENT = 0.005;

/** A percentage with two digits. @param {number} value in % */
const percent = (value) => `${Number(value.toPrecision(2))} %`;

/**
 * Why a flat page is doubtful, with the words before what it means.
 * @param {PageReport} report
 * @param {string} disagreement that its edges disagree, and by how much
 */
function doubtWords({ doubt, linesFound }, disagreement) {
  switch (doubt) {
    case 'hiddenPart': return 'a part of it hides another part; ';
    case 'disagreement': return `${disagreement}; `;
    case 'fewLines':
      return linesFound === 0 ? 'it shows no lines of text, and its outline alone does not tell how it is bent; '
        : `few lines of text (${linesFound}) tell how it is bent; `;
    case 'crumpled': return 'it is crumpled; ';
    case 'strongBend': return 'it is bent strongly; ';
    case 'outline': return 'its outline may be wrong; if it is right, ';
    default: return '';
  }
}

/** Figures of a report that sentences state. */
const FIGURES = /** @type {const} */ (['error', 'pinholeErrorBound', 'disagreement', 'residual', 'lines', 'linesFound']);

/** @type {typeof import('./index.js').describePage} */
export function describePage(given) {
  const said = record('INPUT', 'the report', given, [...FIGURES, 'verdict', 'doubt', 'model']);
  if (!FIGURES.every((name) => typeof said[name] === 'number')) {
    throw new DevelopableError('INPUT', 'the report must be that of a page, as `dewarpPage` returns it');
  }
  const report = /** @type {PageReport} */ (said);
  const { verdict, model, error, pinholeErrorBound, disagreement, residual, lines, linesFound } = report;
  const isSheet = model === 'sheet' || model === 'softSheet';
  const text = lines + linesFound > 0 ? ' and lines of text' : '';
  const likely = `expected error ${percent(error)} of its width (95 %: below ${percent(pinholeErrorBound)}, for an undistorted lens)`;
  // Where both edges agree on the whole, single points are off.
  const off = disagreement < MIN_TOLD_DISAGREEMENT ? `by ${residual.toFixed(1)} pixels` : `by ${percent(disagreement)} of its width`;
  switch (verdict) {
    case 'flat':
      if (model === 'plane') return 'the page lay flat: only the perspective was taken out';
      return 'both edges are straight: only the perspective was taken out; folds that run along them do not show in them';
    case 'unchecked':
      return "nothing checks the page's bend, for too few points were traced, or one edge looks straight " +
        `however the page is bent; if it is curled one way: ${likely}`;
    case 'doubtful':
      return `the flat page is doubtful: ${doubtWords(report, `its edges${text} disagree (${off})`)}${likely}`;
    case 'notThisKind':
      if (isSheet) return `no sheet of paper has these edges (off ${off}): correct them`;
      return `this is no page that is curled one way: its edges${text} disagree (${off}); ` +
        'it is folded or crumpled, for which depth is needed, or an edge is traced wrongly';
    default:
      return `the page is flat; ${likely}`;
  }
}
