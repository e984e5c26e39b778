/** Settings of the solve: λ on a logarithmic slider, and further options. */
import { element } from '../dom.js';
import { shortLambda } from '../format.js';
import { AUTO_LAMBDA_HINT, ENERGIES, LAMBDA_WORDS, lambdaChoiceInWords, lambdaHint, meshLambdaChoiceInWords } from '../messages.js';

/** @import {Energy} from '../api.js' */
/** @import {Session, Settings} from '../session.js' */
/** @import {MeshFit} from '../mesh-fit.js' */

/** Bounds of λ, as the package checks them. */
const [MIN_LAMBDA, MAX_LAMBDA] = [1e-12, 1e15];

/** @param {Session} session @param {MeshFit} meshFit */
export function settingsPanel(session, meshFit) {
  const slider = element('lambda', HTMLInputElement);
  const field = element('lambda-value', HTMLInputElement);
  const hint = element('lambda-hint', HTMLElement);
  const wrong = element('lambda-wrong', HTMLElement);

  const auto = element('lambda-auto', HTMLButtonElement);
  /** Says at the field whether its λ is invalid. @param {boolean} isInvalid */
  const markField = (isInvalid) => {
    if (isInvalid) field.setAttribute('aria-invalid', 'true');
    else field.removeAttribute('aria-invalid');
    wrong.textContent = isInvalid ? LAMBDA_WORDS.invalid : '';
  };
  /** Whether λ is chosen automatically; the button offers that where it is not. @param {boolean} isAuto */
  const showAuto = (isAuto) => {
    if (isAuto && document.activeElement === auto) slider.focus();
    auto.setAttribute('aria-pressed', String(isAuto));
    auto.hidden = isAuto;
  };

  /** Shows what λ means, or how it was chosen. */
  const updateHint = () => {
    const { result, settings: { lambda } } = session;
    if (lambda !== 'auto') hint.textContent = lambdaHint(lambda);
    else if (meshFit.mesh) hint.textContent = (meshFit.surface && meshLambdaChoiceInWords(meshFit.surface.report)) || AUTO_LAMBDA_HINT;
    else hint.textContent = (result?.settings.lambda === 'auto' && lambdaChoiceInWords(result.surface.report)) || AUTO_LAMBDA_HINT;
  };
  /** Shows λ in the controls. @param {number} lambda */
  const showLambda = (lambda) => {
    slider.value = String(Math.log10(lambda));
    slider.setAttribute('aria-valuetext', `λ = ${shortLambda(lambda)}`);
    if (Number(field.value) !== lambda) field.value = shortLambda(lambda);
    markField(false);
    hint.textContent = lambdaHint(lambda);
  };
  /** Sets λ in the session. @param {number} lambda */
  const setLambda = (lambda) => {
    showLambda(lambda);
    showAuto(false);
    if (lambda !== session.settings.lambda) session.updateSettings({ lambda });
  };
  /** λ of the slider, rounded to the digits that are shown. */
  const sliderLambda = () => Number(shortLambda(10 ** slider.valueAsNumber));

  /** Whether an arrow key is held: the slider then changes repeatedly, and λ is set when the key is released. */
  let isKeyHeld = false;
  slider.addEventListener('keydown', ({ repeat }) => (isKeyHeld = repeat));
  slider.addEventListener('keyup', () => {
    if (isKeyHeld) session.updateSettings({ lambda: sliderLambda() });
    isKeyHeld = false;
  });
  slider.addEventListener('input', () => {
    showLambda(sliderLambda());
    showAuto(false);
    session.previewLambda(sliderLambda());
  });
  slider.addEventListener('change', () => {
    if (!isKeyHeld) session.updateSettings({ lambda: sliderLambda() });
  });
  field.addEventListener('change', () => {
    if (field.value.trim() === '') return auto.click();
    const lambda = Number(field.value.trim().replace(/^(\d*),(\d+)/, '$1.$2') || NaN);
    const isValid = lambda >= MIN_LAMBDA && lambda <= MAX_LAMBDA;
    if (isValid) setLambda(lambda);
    else markField(true);
  });
  if (session.settings.lambda !== 'auto') showLambda(session.settings.lambda);
  session.on('input', ({ lattice }) => {
    coarsening.disabled = lattice !== undefined;
    updateHint();
  });
  session.on('cleared', updateHint);
  session.on('result', ({ settings, surface }) => {
    // The slider moves to the λ that was chosen automatically.
    if (settings.lambda === 'auto' && session.settings.lambda === 'auto' && !meshFit.mesh) showLambda(surface.report.lambda);
    updateHint();
  });
  meshFit.on('start', updateHint);
  meshFit.on('result', ({ report }) => {
    if (meshFit.lambda === 'auto' && session.settings.lambda === 'auto') showLambda(report.lambda);
    updateHint();
  });
  meshFit.on('left', () => {
    if (session.result && session.settings.lambda === 'auto') showLambda(session.result.surface.report.lambda);
    updateHint();
  });

  const gap = element('gap', HTMLSelectElement);
  gap.addEventListener('change', () => session.updateSettings({ gap: Number(gap.value) }));
  const coarsening = element('coarsening', HTMLSelectElement);
  coarsening.addEventListener('change', () => session.updateSettings({ coarsening: Number(coarsening.value) }));

  const energy = element('energy', HTMLSelectElement);
  const energyHint = element('energy-hint', HTMLElement);
  /** @param {Energy} chosen */
  const showEnergy = (chosen) => {
    energy.value = chosen;
    energyHint.textContent = ENERGIES[chosen];
  };
  showEnergy(session.settings.energy);
  energy.addEventListener('change', () => {
    const chosen = /** @type {Energy} */ (energy.value);
    showEnergy(chosen);
    session.updateSettings({ energy: chosen });
  });
  auto.addEventListener('click', () => {
    showAuto(true);
    markField(false);
    session.updateSettings({ lambda: 'auto' });
    updateHint();
  });

  const findOcclusions = element('find-occlusions', HTMLInputElement);
  const threshold = element('threshold', HTMLInputElement);
  const updateThreshold = () => {
    element('threshold-field', HTMLElement).hidden = !findOcclusions.checked;
    const value = Number(threshold.value.trim() || NaN);
    const isValid = value > 0 && Number.isFinite(value);
    threshold.setCustomValidity(isValid || !findOcclusions.checked ? '' : 'It must be a number above 0, such as 4e4.');
    if (threshold.reportValidity()) session.updateSettings({ occlusionThreshold: findOcclusions.checked ? value : undefined });
  };
  findOcclusions.addEventListener('change', updateThreshold);
  threshold.addEventListener('change', updateThreshold);

  return {
    /** Sets all settings, in the session and in the controls. @param {Settings} settings */
    adopt(settings) {
      const { lambda, energy: wanted, occlusionThreshold } = settings;
      if (lambda !== 'auto') showLambda(lambda);
      showAuto(lambda === 'auto');
      gap.value = String(settings.gap);
      coarsening.value = String(settings.coarsening);
      showEnergy(wanted);
      findOcclusions.checked = occlusionThreshold !== undefined;
      element('threshold-field', HTMLElement).hidden = !findOcclusions.checked;
      if (occlusionThreshold !== undefined) threshold.value = shortLambda(occlusionThreshold);
      session.updateSettings(settings);
      updateHint();
    },
  };
}
