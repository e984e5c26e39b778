/** The lines along which the surface is straight, over its shading. */
import { breath } from '../dom.js';
import { count, number, percent } from '../format.js';
import { css } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { figures, key } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Ruling} from '../api.js' */
/** @import {Colour} from '../surface/colours.js' */
/** @import {Line} from '../surface/layer.js' */
/** @import {Shown} from './shown.js' */

/** Seen on bright steel as on dark. @type {Colour} */
const COLOUR = [232, 89, 12];

/**
 * @param {Analyses} analyses
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function rulings(analyses, result) {
  const { lines } = await analyses.rulings(result);
  await breath();
  const { input } = result;
  const ruled = ruledBy(lines, input.unit);
  return { result: { grid: gridOf(input), lines: ruled.lines }, about: ruled.about };
}

/**
 * Rulings of whatever surface: how they are drawn, and what is told of them.
 * @param {readonly Ruling[]} lines
 * @param {string | null} [unit]
 * @returns {{ lines: Line[], about: Node[] }}
 */
export function ruledBy(lines, unit) {
  const bent = lines.map(({ deviation }) => deviation).sort((a, b) => a - b);
  return {
    lines: lines.map(({ points }) => ({ points, colour: COLOUR, width: 1.25 })),
    about: [
      key(css(COLOUR), 'Rulings'),
      figures([
        ['Lines', count(lines.length)],
        ['Longest', lines.length > 0 ? `${number(lines.reduce((most, { length }) => Math.max(most, length), 0))} ${unit ?? 'units'}` : '–'],
        ['Median deviation from straight', bent.length > 0 ? `${percent(bent[bent.length >> 1])} of the length` : '–'],
      ]),
    ],
  };
}
