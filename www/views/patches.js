/** The view of the patches, each in a colour, and of the creases between them. */
import { make } from '../dom.js';
import { count, degrees, number, percent } from '../format.js';
import { toPixel, CREASE_COLOUR, toCss, patchColour } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { canvasFromPixels, valueAt } from '../surface/layer.js';
import { callWorker } from '../surface/worker-client.js';
import { figures, key, table } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {ViewContent} from './view-content.js' */

/** Maximum number of rows of each table. */
const MAX_TABLE_ROWS = 6;

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
  const unit = input.unit ?? 'units';
  const squared = input.unit ? `${unit}²` : 'square units';
  const grid = gridOf(input);
  const total = map.patches.reduce((sum, { area }) => sum + area, 0);
  const colours = map.patches.map((_, i) => toPixel(patchColour(i)));
  const longest = creases.toSorted((a, b) => b.length - a.length).slice(0, MAX_TABLE_ROWS);
  /** @param {number} patch */
  const named = (patch) => key(toCss(patchColour(patch)), String(patch + 1));
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
    about: [
      figures([
        ['Patches', count(map.patches.length)],
        ['Creases', count(creases.length)],
        ['Area', `${number(total)} ${squared}`],
      ]),
      make('div', 'tables',
        table(map.patches.length > MAX_TABLE_ROWS ? `The ${MAX_TABLE_ROWS} largest patches` : 'Patches', ['Patch', `Area in ${squared}`, 'Share of the area'],
          map.patches.slice(0, MAX_TABLE_ROWS).map(({ area }, i) => [named(i), number(area), percent(area / total)])),
        ...(longest.length > 0 ? [table(creases.length > MAX_TABLE_ROWS ? `The ${MAX_TABLE_ROWS} longest creases` : 'Creases', ['Between', `Length in ${unit}`, 'Fold angle'],
          longest.map(({ patches: [a, b], length, fold }) => [make('span', 'keys', named(a), named(b)), number(length), degrees(fold)]))] : [])),
    ],
  };
}
