/** The lines along which the surface is straight, over its shading. */
import { breath } from '../dom.js';
import { count, number, percent } from '../format.js';
import { css } from '../surface/colours.js';
import { gridOf } from '../surface/lattice.js';
import { figures, key } from './legend.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result} from '../session.js' */
/** @import {Colour} from '../surface/colours.js' */
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
  const unit = input.unit ?? 'units';
  const bent = lines.map(({ deviation }) => deviation).sort((a, b) => a - b);
  return {
    result: {
      grid: gridOf(input),
      lines: lines.map(({ points }) => ({ points, colour: COLOUR, width: 1.25 })),
    },
    about: [
      key(css(COLOUR), 'rulings: straight lines on the surface, across which alone it bends'),
      figures([
        ['Lines', count(lines.length)],
        ['Longest', lines.length > 0 ? `${number(Math.max(...lines.map(({ length }) => length)))} ${unit}` : '–'],
        ['Off straight, median', bent.length > 0 ? `${percent(bent[bent.length >> 1])} of length` : '–'],
      ]),
    ],
  };
}
