/** λ on a logarithmic slider with the paper's presets, and the further options. */
import { energyFor } from '../design.js';
import { element, elements } from '../dom.js';
import { shortest } from '../format.js';
import { BY_NOISE, ENERGIES, NO_FIDELITY, lambdaFound, lambdaHint, wholeLambdaFound } from '../messages.js';

/** @import {Energy} from '../api.js' */
/** @import {Session, Settings} from '../session.js' */
/** @import {Whole} from '../mesh-fit.js' */

/** @param {Session} session @param {Whole} whole */
export function settingsPanel(session, whole) {
  const slider = element('lambda', HTMLInputElement);
  const field = element('lambda-value', HTMLInputElement);
  const hint = element('lambda-hint', HTMLElement);
  const fieldset = element('fidelity', HTMLFieldSetElement);
  const presets = elements('button[data-exponent]', HTMLButtonElement);

  const auto = element('lambda-auto', HTMLButtonElement);

  /** What λ means, or how it came about. */
  const explain = () => {
    const { input, result, settings: { lambda } } = session;
    if (input?.design) hint.textContent = NO_FIDELITY;
    else if (lambda !== 'auto') hint.textContent = lambdaHint(lambda);
    else if (whole.mesh) hint.textContent = (whole.surface && wholeLambdaFound(whole.surface.report)) || BY_NOISE;
    else hint.textContent = (result?.settings.lambda === 'auto' && lambdaFound(result.surface.report)) || BY_NOISE;
  };
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
    auto.setAttribute('aria-pressed', 'false');
    if (lambda !== session.settings.lambda) session.set({ lambda });
  };
  // To the digits that are shown.
  const fromSlider = () => Number(shortest(10 ** slider.valueAsNumber));

  // While the pointer or a key is held, what it says may be another in a moment.
  let held = false;
  slider.addEventListener('keydown', ({ repeat }) => (held = repeat));
  slider.addEventListener('keyup', () => {
    if (held) session.set({ lambda: fromSlider() });
    held = false;
  });
  slider.addEventListener('input', () => {
    display(fromSlider());
    auto.setAttribute('aria-pressed', 'false');
    session.follow({ lambda: fromSlider() });
  });
  slider.addEventListener('change', () => {
    if (!held) session.set({ lambda: fromSlider() });
  });
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
  if (session.settings.lambda !== 'auto') display(session.settings.lambda);
  session.on('input', ({ design, lattice }) => {
    fieldset.disabled = design === true;
    coarsening.disabled = lattice !== undefined;
    explain();
  });
  session.on('cleared', explain);
  session.on('result', ({ settings, surface }) => {
    // Where the slider goes on from.
    if (settings.lambda === 'auto' && session.settings.lambda === 'auto' && !whole.mesh) display(surface.report.lambda);
    explain();
  });
  whole.on('start', explain);
  whole.on('result', ({ report }) => {
    if (whole.lambda === 'auto' && session.settings.lambda === 'auto') display(report.lambda);
    explain();
  });
  whole.on('left', () => {
    if (session.result && session.settings.lambda === 'auto') display(session.result.surface.report.lambda);
    explain();
  });

  const gap = element('gap', HTMLSelectElement);
  gap.addEventListener('change', () => session.set({ gap: Number(gap.value) }));
  const schedule = element('schedule', HTMLSelectElement);
  // The paper's schedule stops on its residuals.
  const showSchedule = () => {
    gap.disabled = schedule.value === 'paper';
  };
  schedule.addEventListener('change', () => {
    showSchedule();
    session.set({ schedule: schedule.value === 'paper' ? 'paper' : 'default' });
  });
  const coarsening = element('coarsening', HTMLSelectElement);
  coarsening.addEventListener('change', () => session.set({ coarsening: Number(coarsening.value) }));

  const reweighting = element('reweighting', HTMLSelectElement);
  const energy = element('energy', HTMLSelectElement);
  const energyHint = element('energy-hint', HTMLElement);
  const chosen = () => /** @type {Energy} */ (energy.value);
  energy.addEventListener('change', () => {
    energyHint.textContent = ENERGIES[chosen()];
    // It has passes of its own.
    reweighting.disabled = chosen() === 'huber';
    session.set({ energy: chosen(), reweighting: reweighting.disabled ? 0 : Number(reweighting.value) });
  });
  /** @param {Settings['energy']} wanted */
  const showEnergy = (wanted) => {
    energy.value = energyFor(session.input, wanted);
    energyHint.textContent = ENERGIES[chosen()];
    reweighting.disabled = chosen() === 'huber';
  };
  showEnergy(session.settings.energy);
  session.on('input', () => showEnergy(session.settings.energy));
  auto.addEventListener('click', () => {
    auto.setAttribute('aria-pressed', 'true');
    for (const preset of presets) preset.setAttribute('aria-pressed', 'false');
    session.set({ lambda: 'auto' });
    explain();
  });
  reweighting.addEventListener('change', () => session.set({ reweighting: Number(reweighting.value) }));

  const find = element('find-occlusions', HTMLInputElement);
  const threshold = element('threshold', HTMLInputElement);
  const tear = () => {
    element('threshold-field', HTMLElement).hidden = !find.checked;
    const value = Number(threshold.value.trim() || NaN);
    const sound = value > 0 && Number.isFinite(value);
    threshold.setCustomValidity(sound || !find.checked ? '' : 'It must be a number above 0, such as 4e4.');
    if (threshold.reportValidity()) session.set({ occlusionThreshold: find.checked ? value : undefined });
  };
  find.addEventListener('change', tear);
  threshold.addEventListener('change', tear);

  return {
    /** Takes settings from elsewhere, into the controls, too. @param {Settings} settings */
    adopt(settings) {
      const { lambda, energy: wanted, occlusionThreshold } = settings;
      if (lambda !== 'auto') display(lambda);
      auto.setAttribute('aria-pressed', String(lambda === 'auto'));
      gap.value = String(settings.gap);
      schedule.value = settings.schedule;
      showSchedule();
      coarsening.value = String(settings.coarsening);
      reweighting.value = String(settings.reweighting);
      showEnergy(wanted);
      find.checked = occlusionThreshold !== undefined;
      element('threshold-field', HTMLElement).hidden = !find.checked;
      if (occlusionThreshold !== undefined) threshold.value = shortest(occlusionThreshold);
      session.set(settings);
      explain();
    },
  };
}
