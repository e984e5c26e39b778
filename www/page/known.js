/** What is known of the page in one photo: its format, and how its light is treated. */
import { numberIn } from '../format.js';
import { kept } from '../kept.js';
import { PAPERS } from './paper.js';

/** @typedef {{ format: string, wide: string, high: string, light: string }} Known as it was chosen and typed */

/** Of a photo that was not shown yet: no format, and the light that was chosen last. @returns {Known} */
export const firstKnown = () => ({ format: '', wide: '', high: '', light: kept('light', 'even') });

/** The options of flattening. @param {Known} [known] @returns {import('./flatten.js').Options} */
export function optionsOf({ format, wide, high, light } = firstKnown()) {
  const sides = /** @type {[number, number]} */ ([numberIn(wide), numberIn(high)]);
  return {
    ...(light === 'ink' ? { ink: true } : light === 'keep' && { light }),
    ...(format === 'a4' || format === 'letter' ? { page: format } : format === 'a4-wide' || format === 'letter-wide' ? { page: [...PAPERS[format]] } : format === 'own' && sides.every((side) => side > 0) && { page: sides }),
  };
}
