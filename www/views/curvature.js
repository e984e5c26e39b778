/** The views of Gaussian curvature and of κ₂, with input and result on one colour scale. */
import { number, numberAgainst, percent } from '../format.js';
import { COLOUR_SCALE_QUANTILE, logarithmicScale, magnitudeQuantile } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { canvasFromPixels, valueAt } from '../surface/layer.js';
import { callWorker } from '../surface/worker-client.js';
import { figures } from './legend.js';

/** @import {Analyses, Curvatures} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {ViewContent} from './view-content.js' */

/** Symbols of the curvatures. */
const NAMES = { gaussian: 'K', kappa2: 'κ₂' };

/** @typedef {{ before: Curvatures, after: Curvatures }} InputAndResult */

/**
 * The view of Gaussian curvature.
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<ViewContent>}
 */
export async function gaussian(analyses, result) {
  const both = await analyses.curvatures(result);
  const { size, threshold } = both.after.summary;
  const area = size ** 2;
  const inverse = `1/${result.input.unit ?? 'unit'}²`;
  return curvatureContent(result, both, 'gaussian', inverse, 1 / area, `Gaussian curvature K in ${inverse}; figures: input → result`, [
    [`Median |K| in ${inverse}`, fromInputToResult(both, ({ summary }) => numberAgainst(summary.medianGaussian / area, 1 / area))],
    [`|K| above ${number(threshold / area, 2)}`, fromInputToResult(both, ({ summary }) => percent(summary.gaussianAbove))],
  ]);
}

/**
 * The view of the smaller principal curvature.
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<ViewContent>}
 */
export async function kappa2(analyses, result) {
  const both = await analyses.curvatures(result);
  const { size } = both.after.summary;
  const inverse = `1/${result.input.unit ?? 'unit'}`;
  return curvatureContent(result, both, 'kappa2', inverse, 1 / size, `κ₂, the smaller principal curvature, in ${inverse}; figures: input → result`, [
    [`Median |κ₂| in ${inverse}`, fromInputToResult(both, ({ summary }) => numberAgainst(summary.medianKappa2 / size, 1 / size))],
    [`Median |κ₁|, the larger one`, fromInputToResult(both, ({ medianKappa1 }) => numberAgainst(medianKappa1, 1 / size))],
  ]);
}

/**
 * The view of a curvature.
 * @param {Result} result
 * @param {InputAndResult} both
 * @param {'gaussian' | 'kappa2'} what
 * @param {string} inverse unit of the curvature
 * @param {number} linearLimit end of the linear part of the scale: the curvature of a surface that bends once over its own size
 * @param {string} title
 * @param {readonly (readonly [string, string])[]} facts
 * @returns {Promise<ViewContent>}
 */
async function curvatureContent({ input }, { before, after }, what, inverse, linearLimit, title, facts) {
  const grid = gridOf(input);
  const maximum = magnitudeQuantile([after, before].map((analysis) => analysis[what]), COLOUR_SCALE_QUANTILE);
  /** @param {Curvatures} analysis */
  const layer = async ({ rows, cols, spacing, origin, [what]: values }) => {
    const lattice = { rows, cols, spacing, origin };
    const field = { ...lattice, values };
    return {
      grid,
      image: canvasFromPixels(grid, await callWorker('valuePixels', lattice, values, grid, linearLimit, maximum)),
      read: (/** @type {number} */ x, /** @type {number} */ y) => `${NAMES[what]} ${numberAgainst(valueAt(field, x, y), linearLimit)} ${inverse}`,
    };
  };
  return {
    input: await layer(before),
    result: await layer(after),
    colours: { title, scale: logarithmicScale(linearLimit, maximum) },
    about: [figures(facts)],
  };
}

/**
 * A figure of the input and of the result.
 * @param {InputAndResult} both
 * @param {(analysis: Curvatures) => string} figure
 */
function fromInputToResult({ before, after }, figure) {
  return `${figure(before)} → ${figure(after)}`;
}
