/** What of a file's heights cannot be taken as it is, in words that say what to do. */
import { GUESS_WORDS } from './messages.js';
import { reliefOf } from './metadata-guess.js';

/** @import {Input} from './session.js' */

/** Shares of the longer side that a relief may well have. */
const PLAUSIBLE = [1e-3, 1];
/** What the package suggests for whole numbers: white is that share of the longer side above black. */
const GUESS = 1 / 4;

/**
 * @param {Input} input
 * @returns {string} nothing where all is in order
 */
export function doubtOf(input) {
  const { kind, lattice, design, data, width, height, pixelSize, heightScale, dataType = '' } = input;
  if (kind === undefined || lattice || design) return '';
  const side = Math.max(width, height) * pixelSize;
  const [, bits] = /^u(\d+)$/.exec(dataType) ?? [];
  if (bits && Math.abs(heightScale / ((GUESS * side) / (2 ** Number(bits) - 1)) - 1) < 1e-9) {
    return GUESS_WORDS.levels;
  }
  const share = (reliefOf(data) * Math.abs(heightScale)) / side;
  if (share === 0 || (share >= PLAUSIBLE[0] && share <= PLAUSIBLE[1])) return '';
  return GUESS_WORDS.relief(share < 1);
}
