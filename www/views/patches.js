/** The smooth patches in a colour each, and the creases between them. */
import { make } from '../dom.js';
import { count, degrees, number, percent } from '../format.js';
import { bytes, CREASE, css, patchColour } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { canvasOf, valueAt } from '../surface/layer.js';
import { work } from '../surface/work.js';
import { figures, key, table } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Shown} from './shown.js' */

/** Rows of each table. */
const MOST = 6;

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function patches(analyses, result) {
  const map = await analyses.patches(result);
  const { creases, rows, cols, spacing, origin } = map;
  const { input } = result;
  const unit = input.unit ?? 'units';
  const squared = input.unit ? `${unit}²` : 'square units';
  const grid = gridOf(input);
  const total = map.patches.reduce((sum, { area }) => sum + area, 0);
  const colours = map.patches.map((_, i) => bytes(patchColour(i)));
  const longest = creases.toSorted((a, b) => b.length - a.length).slice(0, MOST);
  /** @param {number} patch */
  const named = (patch) => key(css(patchColour(patch)), String(patch + 1));
  return {
    result: {
      grid,
      image: canvasOf(grid, await work('labelPixels', { rows, cols, spacing, origin }, map.labels, grid, colours)),
      // A sharper fold is a heavier line.
      lines: creases.map(({ points, fold }) => ({ points, colour: CREASE, width: 1 + 2 * Math.min(1, fold) })),
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
        table(map.patches.length > MOST ? `The ${MOST} largest patches` : 'Patches', ['Patch', `Area in ${squared}`, 'Share of the area'],
          map.patches.slice(0, MOST).map(({ area }, i) => [named(i), number(area), percent(area / total)])),
        ...(longest.length > 0 ? [table(creases.length > MOST ? `The ${MOST} longest creases` : 'Creases', ['Between', `Length in ${unit}`, 'Fold angle'],
          longest.map(({ patches: [a, b], length, fold }) => [make('span', 'keys', named(a), named(b)), number(length), degrees(fold)]))] : [])),
    ],
  };
}
