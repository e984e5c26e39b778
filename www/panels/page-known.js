/** Options of a photo of a page: paper size, light, and number of pages. */
import { element, elements } from '../dom.js';
import { PAPERS } from '../page/paper.js';

/** @import {PageSession} from '../page/session.js' */
/** @typedef {import('../../pkg/types.js').DewarpPageOptions} Options */

/** @param {PageSession} session */
export function pageKnownPanel(session) {
  const format = element('page-format', HTMLSelectElement);
  const sides = element('page-sides', HTMLElement);
  const [wide, high] = ['page-wide', 'page-high'].map((id) => element(id, HTMLInputElement));
  const light = element('page-light', HTMLSelectElement);
  const pages = elements('input[name="pages"]', HTMLInputElement);

  /** @param {HTMLInputElement} input */
  const isValid = (input) => {
    input.setCustomValidity(input.value === '' || input.valueAsNumber > 0 ? '' : 'It must be a number above 0.');
    return input.value !== '' && input.reportValidity();
  };
  /** The options that are chosen. @returns {Options} */
  const readOptions = () => {
    sides.hidden = format.value !== 'own';
    /** @type {Options} */
    const options = {};
    if (light.value === 'ink') options.ink = true;
    else if (light.value === 'keep') options.light = 'keep';
    if (format.value === 'a4' || format.value === 'letter') options.page = format.value;
    else if (format.value === 'own' && isValid(wide) && isValid(high)) options.page = [wide.valueAsNumber, high.valueAsNumber];
    else if (format.value === 'a4-wide' || format.value === 'letter-wide') options.page = [...PAPERS[format.value]];
    return options;
  };
  const update = () => session.setOptions(readOptions());
  for (const control of [format, light, wide, high]) control.addEventListener('change', update);
  for (const radio of pages) {
    radio.addEventListener('change', () => (radio.value === '2' ? session.addGutter() : session.removeGutter()));
  }

  session.on('photo', () => (session.options = readOptions()));
  session.on('outline', ({ outline }) => {
    for (const radio of pages) radio.checked = radio.value === String(outline.pages);
  });
}
