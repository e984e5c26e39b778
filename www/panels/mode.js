/** Switch between the two parts of the page: heights, and photos of pages. */
import { element, elements } from '../dom.js';

/** @typedef {'heights' | 'photo'} Mode */

/** Addresses of the guide to each part. @type {Record<Mode, string>} */
const GUIDES = { heights: './guide/docs/page.html', photo: './guide/docs/dewarp.html' };

/** @param {(mode: Mode) => void} onEnter */
export function modePanel(onEnter) {
  const radios = elements('input[name="mode"]', HTMLInputElement);
  const sides = { heights: element('heights-side', HTMLElement), photo: element('page-side', HTMLElement) };
  /** @param {Mode} mode */
  const show = (mode) => {
    for (const radio of radios) radio.checked = radio.value === mode;
    sides.heights.hidden = mode !== 'heights';
    sides.photo.hidden = mode !== 'photo';
    for (const [id, own] of /** @type {const} */ ([['open', 'heights'], ['page-open', 'photo']])) element(id, HTMLElement).hidden = own !== mode;
    element('guide', HTMLAnchorElement).href = GUIDES[mode];
  };
  /** @param {Mode} mode */
  const enter = (mode) => {
    show(mode);
    onEnter(mode);
  };
  for (const radio of radios) radio.addEventListener('change', () => enter(/** @type {Mode} */ (radio.value)));
  return {
    /** Shows a part of the page, and calls `onEnter`. */
    enter,
    /** Shows a part of the page without calling `onEnter`. */
    show,
    /** @returns {Mode} */
    get now() {
      return sides.photo.hidden ? 'heights' : 'photo';
    },
  };
}
