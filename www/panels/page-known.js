/** Options of a photo of a page: paper size, light, number of pages, and focal length of the camera. */
import { element, elements } from '../dom.js';
import { number } from '../format.js';
import { FOCAL_WORDS } from '../page/messages.js';
import { PAPERS } from '../page/paper.js';

/** @import {PageSession} from '../page/session.js' */
/** @typedef {import('../../pkg/types.js').DewarpPageOptions} Options */

/**
 * Ways to give the focal length, with their hints and upper bounds.
 * @type {Record<string, { hint: string, upperBound: number, options: (value: number) => Options }>}
 */
const FOCAL_LENGTH_KINDS = {
  fov: { hint: FOCAL_WORDS.fov, upperBound: 179, options: (fieldOfView) => ({ fieldOfView }) },
  film35: { hint: FOCAL_WORDS.film35, upperBound: Infinity, options: (film35) => ({ film35 }) },
  pixels: { hint: FOCAL_WORDS.pixels, upperBound: Infinity, options: (focalLength) => ({ focalLength }) },
};

/** @param {PageSession} session */
export function pageKnownPanel(session) {
  const format = element('page-format', HTMLSelectElement);
  const sides = element('page-sides', HTMLElement);
  const [wide, high] = ['page-wide', 'page-high'].map((id) => element(id, HTMLInputElement));
  const camera = element('focal', HTMLSelectElement);
  const field = element('focal-field', HTMLElement);
  const value = element('focal-value', HTMLInputElement);
  const hint = element('focal-hint', HTMLElement);
  const light = element('page-light', HTMLSelectElement);
  const pages = elements('input[name="pages"]', HTMLInputElement);

  /** @param {HTMLInputElement} input @param {number} [upperBound] */
  const isValid = (input, upperBound = Infinity) => {
    const number = input.valueAsNumber;
    input.setCustomValidity(input.value === '' || (number > 0 && number < upperBound) ? '' : `It must be a number above 0${upperBound < Infinity ? ` and below ${upperBound}` : ''}.`);
    return input.value !== '' && input.reportValidity();
  };
  /** The options that are chosen. @returns {Options} */
  const readOptions = () => {
    sides.hidden = format.value !== 'own';
    const kind = FOCAL_LENGTH_KINDS[camera.value];
    field.hidden = kind === undefined;
    const { photo } = session;
    hint.textContent = kind?.hint ?? (photo?.film35 === undefined
      ? FOCAL_WORDS.unknown
      : FOCAL_WORDS.told(number(photo.film35)));
    /** @type {Options} */
    const options = {};
    if (light.value === 'ink') options.ink = true;
    else if (light.value === 'keep') options.light = 'keep';
    if (format.value === 'a4' || format.value === 'letter') options.page = format.value;
    else if (format.value === 'own' && isValid(wide) && isValid(high)) options.page = [wide.valueAsNumber, high.valueAsNumber];
    else if (format.value === 'a4-wide' || format.value === 'letter-wide') options.page = [...PAPERS[format.value]];
    if (kind && isValid(value, kind.upperBound)) Object.assign(options, kind.options(value.valueAsNumber));
    return options;
  };
  const update = () => session.setOptions(readOptions());
  for (const control of [format, light, wide, high, value]) control.addEventListener('change', update);
  camera.addEventListener('change', () => {
    value.value = '';
    update();
  });
  for (const radio of pages) {
    radio.addEventListener('change', () => (radio.value === '2' ? session.addGutter() : session.removeGutter()));
  }

  session.on('photo', () => {
    // The next photo may be from another camera.
    camera.value = 'auto';
    session.options = readOptions();
  });
  session.on('outline', ({ outline }) => {
    for (const radio of pages) radio.checked = radio.value === String(outline.pages);
  });
}
