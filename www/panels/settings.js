/** λ on a logarithmic slider with the paper's presets, and the further options. */
import { element, elements } from '../dom.js';
import { shortest } from '../format.js';
import { lambdaHint } from '../words.js';

/** @import {Session} from '../session.js' */

/** @param {Session} session */
export function settingsPanel(session) {
  const slider = element('lambda', HTMLInputElement);
  const field = element('lambda-value', HTMLInputElement);
  const hint = element('lambda-hint', HTMLElement);
  const presets = elements('button[data-exponent]', HTMLButtonElement);

  /** @param {number} lambda */
  const display = (lambda) => {
    slider.value = String(Math.log10(lambda));
    slider.setAttribute('aria-valuetext', `λ = ${shortest(lambda)}`);
    if (Number(field.value) !== lambda) field.value = shortest(lambda);
    field.setCustomValidity('');
    hint.textContent = lambdaHint(lambda);
    for (const preset of presets) {
      preset.setAttribute('aria-pressed', String(10 ** Number(preset.dataset.exponent) === lambda));
    }
  };
  /** @param {number} lambda */
  const choose = (lambda) => {
    display(lambda);
    if (lambda !== session.settings.lambda) session.set({ lambda });
  };
  // To the digits that are shown.
  const fromSlider = () => Number(shortest(10 ** slider.valueAsNumber));

  slider.addEventListener('input', () => display(fromSlider()));
  slider.addEventListener('change', () => choose(fromSlider()));
  for (const preset of presets) {
    preset.addEventListener('click', () => choose(10 ** Number(preset.dataset.exponent)));
  }
  field.addEventListener('change', () => {
    const lambda = Number(field.value.trim() || NaN);
    const sound = lambda > 0 && Number.isFinite(lambda);
    field.setCustomValidity(sound ? '' : 'λ must be a number above 0, such as 2.5e6.');
    if (sound) choose(lambda);
    else field.reportValidity();
  });
  display(session.settings.lambda);

  const gap = element('gap', HTMLSelectElement);
  gap.addEventListener('change', () => session.set({ gap: Number(gap.value) }));
  const schedule = element('schedule', HTMLSelectElement);
  schedule.addEventListener('change', () =>
    session.set({ schedule: schedule.value === 'paper' ? 'paper' : 'default' }));
  const coarsening = element('coarsening', HTMLSelectElement);
  coarsening.addEventListener('change', () => session.set({ coarsening: Number(coarsening.value) }));
}
