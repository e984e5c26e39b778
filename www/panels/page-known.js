/** What is known of a page and of the camera that took the photo. */
import { element, elements } from '../dom.js';
import { number } from '../format.js';
import { FOCAL_WORDS } from '../page/messages.js';
import { PAPERS } from '../page/paper.js';

/** @import {PageSession} from '../page/session.js' */
/** @typedef {import('../../pkg/types.js').DewarpPageOptions} Options */

/** What may be typed of the camera, and what of it can be. @type {Record<string, { hint: string, most: number, options: (value: number) => Options }>} */
const CAMERAS = {
  fov: { hint: FOCAL_WORDS.fov, most: 179, options: (fieldOfView) => ({ fieldOfView }) },
  film35: { hint: FOCAL_WORDS.film35, most: Infinity, options: (film35) => ({ film35 }) },
  pixels: { hint: FOCAL_WORDS.pixels, most: Infinity, options: (focalLength) => ({ focalLength }) },
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

  /** @param {HTMLInputElement} input @param {number} [most] */
  const sound = (input, most = Infinity) => {
    const number = input.valueAsNumber;
    input.setCustomValidity(input.value === '' || (number > 0 && number < most) ? '' : `It must be a number above 0${most < Infinity ? ` and below ${most}` : ''}.`);
    return input.value !== '' && input.reportValidity();
  };
  /** @returns {Options} */
  const read = () => {
    sides.hidden = format.value !== 'own';
    const known = CAMERAS[camera.value];
    field.hidden = known === undefined;
    const { photo } = session;
    hint.textContent = known?.hint ?? (photo?.film35 === undefined
      ? FOCAL_WORDS.unknown
      : FOCAL_WORDS.told(number(photo.film35)));
    /** @type {Options} */
    const options = {};
    if (light.value === 'ink') options.ink = true;
    else if (light.value === 'keep') options.light = 'keep';
    if (format.value === 'a4' || format.value === 'letter') options.page = format.value;
    else if (format.value === 'own' && sound(wide) && sound(high)) options.page = [wide.valueAsNumber, high.valueAsNumber];
    else if (format.value === 'a4-wide' || format.value === 'letter-wide') options.page = [...PAPERS[format.value]];
    if (known && sound(value, known.most)) Object.assign(options, known.options(value.valueAsNumber));
    return options;
  };
  const update = () => session.know(read());
  for (const control of [format, light, wide, high, value]) control.addEventListener('change', update);
  camera.addEventListener('change', () => {
    value.value = '';
    update();
  });
  for (const radio of pages) {
    radio.addEventListener('change', () => (radio.value === '2' ? session.divide() : session.join()));
  }

  session.on('photo', () => {
    // Another photo may be another camera's.
    camera.value = 'auto';
    session.options = read();
  });
  session.on('outline', ({ outline }) => {
    for (const radio of pages) radio.checked = radio.value === String(outline.pages);
  });
}
