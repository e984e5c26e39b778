/** The view of the rulings over the shaded surface, of heights and meshes. */
import { count, number, percent } from '../format.js';
import { toCss } from '../surface/colours.js';
import { figures, key } from './legend.js';

/** @import {Ruling} from '../../pkg/types.js' */

/** Colour of rulings, visible on bright and dark steel. @type {Colour} */
const RULING_COLOUR = [232, 89, 12];

/** @param {readonly Ruling[]} lines @param {string | null} [unit] @returns {ViewContent} */
export function rulings(lines, unit) {
  if (lines.length === 0) return { said: 'No rulings are drawn: in a flat face every straight line is one.' };
  const deviations = lines.map(({ deviation }) => deviation).sort((a, b) => a - b);
  return {
    layers: [undefined, { lines: lines.map(({ points }) => ({ points, colour: RULING_COLOUR, width: 1.25 })) }],
    about: [
      key(toCss(RULING_COLOUR), 'Rulings'),
      figures([
        ['Lines', count(lines.length)],
        ['Longest', `${number(lines.reduce((most, { length }) => Math.max(most, length), 0))} ${unit ?? 'units'}`],
        ['Median deviation from straight', `${percent(deviations[deviations.length >> 1])} of the length`],
      ]),
    ],
  };
}
