/** Gaussian curvature and κ₂ by colour, of input and result on one scale. */
import { number, numberAgainst, percent } from '../format.js';
import { logarithmic, magnitude } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { canvasOf, valueAt } from '../surface/layer.js';
import { work } from '../surface/work.js';
import { colourBar, figures } from './legend.js';

/** @import {Analyses, Curvatures} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Shown} from './shown.js' */

const NAMES = { gaussian: 'K', kappa2: 'κ₂' };
/** The share of the values that the scale spans. */
const SPAN = 0.99;

/** @typedef {{ before: Curvatures | null, after: Curvatures }} Both */

/** Explanation of the arrow between two figures. */
const ARROW = '; figures: input → result';

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function gaussian(analyses, result) {
  const both = await analyses.curvatures(result);
  const { size, threshold } = both.after.summary;
  const area = size ** 2;
  const inverse = `1/${result.input.unit ?? 'unit'}²`;
  return coloured(result, both, 'gaussian', inverse, 1 / area, `Gaussian curvature K in ${inverse}${both.before ? ARROW : ''}`, [
    [`Median |K| in ${inverse}`, inBoth(both, ({ summary }) => numberAgainst(summary.medianGaussian / area, 1 / area))],
    [`|K| above ${number(threshold / area, 2)}`, inBoth(both, ({ summary }) => percent(summary.gaussianAbove))],
  ]);
}

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function kappa2(analyses, result) {
  const both = await analyses.curvatures(result);
  const { size } = both.after.summary;
  const inverse = `1/${result.input.unit ?? 'unit'}`;
  return coloured(result, both, 'kappa2', inverse, 1 / size, `κ₂, the smaller principal curvature, in ${inverse}${both.before ? ARROW : ''}`, [
    [`Median |κ₂| in ${inverse}`, inBoth(both, ({ summary }) => numberAgainst(summary.medianKappa2 / size, 1 / size))],
    [`Median |κ₁|, the larger one`, inBoth(both, ({ medianKappa1 }) => numberAgainst(medianKappa1, 1 / size))],
  ]);
}

/**
 * @param {Result} result
 * @param {Both} both
 * @param {'gaussian' | 'kappa2'} what
 * @param {string} inverse unit
 * @param {number} knee what is practically none: that of a surface which bends once over its own size
 * @param {string} title
 * @param {readonly (readonly [string, string])[]} facts
 * @returns {Promise<Shown>}
 */
async function coloured({ input }, { before, after }, what, inverse, knee, title, facts) {
  const grid = gridOf(input);
  const most = magnitude([after, ...(before ? [before] : [])].map((analysis) => analysis[what]), SPAN);
  /** @param {Curvatures} analysis */
  const layer = async ({ rows, cols, spacing, origin, [what]: values }) => {
    const lattice = { rows, cols, spacing, origin };
    const field = { ...lattice, values };
    return {
      grid,
      image: canvasOf(grid, await work('valuePixels', lattice, values, grid, knee, most)),
      read: (/** @type {number} */ x, /** @type {number} */ y) => `${NAMES[what]} ${numberAgainst(valueAt(field, x, y), knee)} ${inverse}`,
    };
  };
  return {
    input: before ? await layer(before) : undefined,
    result: await layer(after),
    about: [colourBar(title, logarithmic(knee, most)), figures(facts)],
  };
}

/**
 * A figure of the input, if there is one, and of the result.
 * @param {Both} both
 * @param {(analysis: Curvatures) => string} figure
 */
function inBoth({ before, after }, figure) {
  return before ? `${figure(before)} → ${figure(after)}` : figure(after);
}
