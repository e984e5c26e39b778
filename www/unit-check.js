/** A check of the scale of a file's heights, with a message that says what to do. */
import { GUESS_WORDS } from './messages.js';
import { ASSUMED_RELIEF_SHARE, reliefOf } from './metadata-guess.js';

/** @import {Input} from './session.js' */

/** Minimum relief that is accepted without a question, as a share of the longer side. */
const MIN_PLAUSIBLE_RELIEF_SHARE = 1e-3;
/** Maximum relief that is accepted without a question, as a share of the longer side. */
const MAX_PLAUSIBLE_RELIEF_SHARE = 1;

/**
 * A question about the scale of an input, if its relief is implausible or its height scale was assumed.
 * @param {Input} input
 * @returns {string} empty if the scale is plausible
 */
export function scaleQuestion(input) {
  const { kind, lattice, design, data, width, height, pixelSize, heightScale, dataType = '' } = input;
  if (kind === undefined || lattice || design) return '';
  const side = Math.max(width, height) * pixelSize;
  const [, bits] = /^u(\d+)$/.exec(dataType) ?? [];
  if (bits && Math.abs(heightScale / ((ASSUMED_RELIEF_SHARE * side) / (2 ** Number(bits) - 1)) - 1) < 1e-9) {
    return GUESS_WORDS.levels;
  }
  const share = (reliefOf(data) * Math.abs(heightScale)) / side;
  if (share === 0 || (share >= MIN_PLAUSIBLE_RELIEF_SHARE && share <= MAX_PLAUSIBLE_RELIEF_SHARE)) return '';
  return GUESS_WORDS.relief(share < 1);
}
