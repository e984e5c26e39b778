/** The views of Gaussian curvature and of κ₂, with input and result on one colour scale. */
import { number, numberAgainst, percent } from '../format.js';
import { COLOUR_SCALE_QUANTILE, divergingColour, logarithmicScale, magnitudeQuantile } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { canvasFromPixels, valueAt } from '../surface/layer.js';
import { interpolateAt, vertexColors } from '../surface/triangles.js';
import { callWorker } from '../surface/worker-client.js';
import { figures } from './legend.js';

/** @import {Curvatures} from '../analyses.js' */
/** @import {Layer} from '../surface/layer.js' */

/** @typedef {{ gaussian: ArrayLike<number>, kappa2?: ArrayLike<number>, medianKappa1?: number, summary: { size: number, threshold: number, gaussianAbove: number, medianGaussian: number, medianKappa2?: number } }} Analysis */
/** @typedef {'gaussian' | 'kappa2'} Curvature */
/** @typedef {{ limit: number, maximum: number, place: (value: number) => number, read: (value: number) => string }} Scale `limit`: end of the linear part, the curvature of a surface that bends once over its own size */

/** @type {Record<Curvature, { symbol: string, title: string, power: number, facts: (analysis: Analysis, result: Analysis, limit: number, unit: string) => [string, string][] }>} */
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
    facts: ({ summary: { medianKappa2 = NaN }, medianKappa1 = NaN }, _, limit, unit) => [
      [`Median |κ₂| in ${unit}`, numberAgainst(medianKappa2 * limit, limit)],
      ['Median |κ₁|, the larger one', numberAgainst(medianKappa1, limit)],
    ],
  },
};

/**
 * The view of a curvature.
 * @template {Analysis} A
 * @param {Curvature} what
 * @param {string | null | undefined} unit of lengths
 * @param {{ before: A, after: A }} analyses of the input and of the result
 * @param {(analysis: A, scale: Scale, side: 0 | 1) => Promise<Layer>} layerOf lays the values over a surface
 * @returns {Promise<ViewContent>}
 */
export async function curvature(what, unit, { before, after }, layerOf) {
  const { symbol, title, power, facts } = CURVATURES[what];
  const limit = after.summary.size ** -power;
  const inverse = `1/${unit ?? 'unit'}${power === 2 ? '²' : ''}`;
  const maximum = magnitudeQuantile([after[what] ?? [], before[what] ?? []], COLOUR_SCALE_QUANTILE);
  const scale = logarithmicScale(limit, maximum);
  const read = (/** @type {number} */ value) => (Number.isNaN(value) ? '' : `${symbol} ${numberAgainst(value, limit)} ${inverse}`);
  const [inputs, results] = [before, after].map((analysis) => facts(analysis, after, limit, inverse));
  return {
    layers: [await layerOf(before, { limit, maximum, place: scale.place, read }, 0), await layerOf(after, { limit, maximum, place: scale.place, read }, 1)],
    colours: { title: `${title} in ${inverse}; figures: input → result`, scale },
    about: [figures(inputs.map(([name, value], i) => [name, `${value} → ${results[i][1]}`]))],
  };
}

/** Lays the values of a lattice over the heights. @param {Input} input @param {Curvature} what */
export const overHeights = (input, what) => async (/** @type {Curvatures} */ { rows, cols, spacing, origin, [what]: values }, /** @type {Scale} */ { limit, maximum, read }) => {
  const [grid, lattice] = [gridOf(input), { rows, cols, spacing, origin }];
  return {
    image: canvasFromPixels(grid, await callWorker('valuePixels', lattice, values, grid, limit, maximum)),
    read: (/** @type {import('../surface/scene.js').Place} */ { point: [x, y] }) => read(valueAt({ ...lattice, values }, x, y)),
  };
};

/** Colours the vertices of meshes. @param {readonly [Mesh, Mesh]} meshes input and result */
export const overMeshes = (meshes) => async (/** @type {Analysis} */ { gaussian }, /** @type {Scale} */ { place, read }, /** @type {0 | 1} */ side) => ({
  surface: { positions: meshes[side].positions, triangles: meshes[side].triangles, colors: vertexColors(gaussian.length, (i) => divergingColour(Number.isNaN(gaussian[i]) ? 0 : place(gaussian[i]))) },
  // At a border only some corners have a value.
  read: (/** @type {import('../surface/scene.js').Place} */ at) => read(interpolateAt(meshes[side], at, (vertex) => gaussian[vertex])),
});
