/** The view of the rulings over the shaded surface. */
import { nextTask } from '../dom.js';
import { count, number, percent } from '../format.js';
import { toCss } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { figures, key } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Ruling} from '../api.js' */
/** @import {Colour} from '../surface/colours.js' */
/** @import {Line} from '../surface/layer.js' */
/** @import {ViewContent} from './view-content.js' */

/** Colour of rulings, visible on bright and dark steel. @type {Colour} */
const RULING_COLOUR = [232, 89, 12];

/**
 * The view of the rulings.
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<ViewContent>}
 */
export async function rulings(analyses, result) {
  const { lines } = await analyses.rulings(result);
  await nextTask();
  const { input } = result;
  const ruled = rulingContent(lines, input.unit);
  return { result: { grid: gridOf(input), lines: ruled.lines }, about: ruled.about };
}

/**
 * The lines and figures of the rulings of a heightfield or mesh.
 * @param {readonly Ruling[]} lines
 * @param {string | null} [unit]
 * @returns {{ lines: Line[], about: Node[] }}
 */
export function rulingContent(lines, unit) {
  const deviations = lines.map(({ deviation }) => deviation).sort((a, b) => a - b);
  return {
    lines: lines.map(({ points }) => ({ points, colour: RULING_COLOUR, width: 1.25 })),
    about: [
      key(toCss(RULING_COLOUR), 'Rulings'),
      figures([
        ['Lines', count(lines.length)],
        ['Longest', lines.length > 0 ? `${number(lines.reduce((most, { length }) => Math.max(most, length), 0))} ${unit ?? 'units'}` : '–'],
        ['Median deviation from straight', deviations.length > 0 ? `${percent(deviations[deviations.length >> 1])} of the length` : '–'],
      ]),
    ],
  };
}
