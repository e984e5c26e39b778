/** The views of Gaussian curvature and of κ₂, with input and result on one colour scale. */
import { number, numberAgainst, percent } from '../format.js';
import { COLOUR_SCALE_QUANTILE, divergingColour, logarithmicScale, magnitudeQuantile } from '../surface/colours.js';
import { colouredBy } from '../surface/layer.js';
import { figures } from './legend.js';

/** @import {MeshAnalysis} from '../../pkg/types.js' */
/** @import {Field} from '../surface/layer.js' */

/** @typedef {Pick<MeshAnalysis, 'gaussian' | 'kappa1' | 'kappa2' | 'summary'>} Curvatures of heights or a mesh */
/** @typedef {'gaussian' | 'kappa2'} Curvature */

/** @type {Record<Curvature, { symbol: string, title: string, power: number, facts: (analysis: Curvatures, result: Curvatures, limit: number, unit: string) => [string, string][] }>} */
const CURVATURES = {
  gaussian: {
    symbol: 'K', title: 'Gaussian curvature K', power: 2,
    facts: ({ summary: { medianGaussian, gaussianAbove } }, { summary: { threshold } }, limit, unit) => [
      [`Median |K| in ${unit}`, numberAgainst(medianGaussian * limit, limit)],
      [`|K| above ${number(threshold * limit, 2)}`, percent(gaussianAbove)],
    ],
  },
  kappa2: {
    symbol: 'κ₂', title: 'κ₂, the smaller principal curvature,', power: 1,
    facts: ({ summary: { medianKappa2 }, kappa1 }, _, limit, unit) => [
      [`Median |κ₂| in ${unit}`, numberAgainst(medianKappa2 * limit, limit)],
      ['Median |κ₁|, the larger one', numberAgainst(magnitudeQuantile([kappa1], 0.5), limit)],
    ],
  },
};

/**
 * The view of a curvature.
 * @template {Curvatures} A
 * @param {Curvature} what
 * @param {string | null | undefined} unit of lengths
 * @param {{ before: A, after: A }} analyses of the input and of the result
 * @param {(analysis: A) => Field} fieldOf lays the values over a surface
 * @returns {ViewContent}
 */
export function curvature(what, unit, { before, after }, fieldOf) {
  const { symbol, title, power, facts } = CURVATURES[what];
  // The scale is linear up to the curvature of a surface that bends once over its own size.
  const limit = after.summary.size ** -power;
  const inverse = `1/${unit ?? 'unit'}${power === 2 ? '²' : ''}`;
  const scale = logarithmicScale(limit, magnitudeQuantile([after[what], before[what]], COLOUR_SCALE_QUANTILE));
  const [inputs, results] = [before, after].map((analysis) => facts(analysis, after, limit, inverse));
  /** @param {A} analysis */
  const layerOf = (analysis) => {
    const { at, read } = fieldOf(analysis);
    return {
      surface: colouredBy(at, (value) => divergingColour(scale.place(value))),
      read: (/** @type {import('../surface/scene.js').Place} */ place) => (Number.isNaN(read(place)) ? '' : `${symbol} ${numberAgainst(read(place), limit)} ${inverse}`),
    };
  };
  return {
    layers: [layerOf(before), layerOf(after)],
    colours: { title: `${title} in ${inverse}; figures: input → result`, scale },
    about: [figures(inputs.map(([name, value], i) => [name, `${value} → ${results[i][1]}`]))],
  };
}
