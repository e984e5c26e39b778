/** The two ways to start: from heights, or from a photo of a page alone. */
import { element, elements } from '../dom.js';

/** @typedef {'heights' | 'photo'} Mode */

/** @param {(mode: Mode) => void} entered */
export function modePanel(entered) {
  const radios = elements('input[name="mode"]', HTMLInputElement);
  const sides = { heights: element('heights-side', HTMLElement), photo: element('page-side', HTMLElement) };
  /** @param {Mode} mode */
  const show = (mode) => {
    for (const radio of radios) radio.checked = radio.value === mode;
    sides.heights.hidden = mode !== 'heights';
    sides.photo.hidden = mode !== 'photo';
    for (const [id, own] of /** @type {const} */ ([['open', 'heights'], ['page-open', 'photo']])) element(id, HTMLElement).hidden = own !== mode;
    for (const name of /** @type {const} */ (['heights', 'photo'])) element(`drop-${name}`, HTMLElement).hidden = name !== mode;
  };
  /** @param {Mode} mode */
  const enter = (mode) => {
    show(mode);
    entered(mode);
  };
  for (const radio of radios) radio.addEventListener('change', () => enter(/** @type {Mode} */ (radio.value)));
  return {
    enter,
    /** Without what else happens when it is entered: something is opened there anyway. */
    show,
    /** @returns {Mode} */
    get now() {
      return sides.photo.hidden ? 'heights' : 'photo';
    },
  };
}
