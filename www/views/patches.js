/** The view of the patches, each in a colour, and of the creases between them. */
import { make } from '../dom.js';
import { count, number, percent } from '../format.js';
import { toPixel, CREASE_COLOUR, toCss, patchColour } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { canvasFromPixels, valueAt } from '../surface/layer.js';
import { callWorker } from '../surface/worker-client.js';
import { figures, key } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {ViewContent} from './view-content.js' */

/** Maximum number of patches in the legend. */
const MAX_NAMED_PATCHES = 12;

/**
 * Figures and legend of patches.
 * @param {readonly { area: number }[]} patches the largest first
 * @param {number} creases
 * @param {string | null} [unit]
 */
export function aboutPatches(patches, creases, unit) {
  const total = patches.reduce((sum, { area }) => sum + area, 0);
  return [
    figures([['Patches', count(patches.length)], ['Creases', count(creases)], ['Area', `${number(total)} ${unit ? `${unit}²` : 'square units'}`]]),
    make('p', 'keys', ...patches.slice(0, MAX_NAMED_PATCHES).map(({ area }, i) => key(toCss(patchColour(i)), `${i + 1}: ${percent(area / total)}`))),
  ];
}

/**
 * The view of patches and creases.
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<ViewContent>}
 */
export async function patches(analyses, result) {
  const map = await analyses.patches(result);
  const { creases, rows, cols, spacing, origin } = map;
  const { input } = result;
  const grid = gridOf(input);
  const colours = map.patches.map((_, i) => toPixel(patchColour(i)));
  return {
    result: {
      grid,
      image: canvasFromPixels(grid, await callWorker('labelPixels', { rows, cols, spacing, origin }, map.labels, grid, colours)),
      // The line is wider where the fold angle is larger.
      lines: creases.map(({ points, fold }) => ({ points, colour: CREASE_COLOUR, width: 1 + 2 * Math.min(1, fold) })),
      read: (x, y) => {
        const patch = valueAt({ ...map, values: map.labels }, x, y);
        return patch >= 0 ? `patch ${patch + 1}` : '';
      },
    },
    about: aboutPatches(map.patches, creases.length, input.unit),
  };
}
