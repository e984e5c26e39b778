/** Settings of the solve: λ on a logarithmic slider, and further options. */
import { element } from '../dom.js';
import { above, between, fieldsOf } from '../fields.js';
import { shortLambda } from '../format.js';
import { History } from '../history.js';
import { AUTO_LAMBDA_HINT, ENERGIES, lambdaChoiceInWords, lambdaHint, meshLambdaChoiceInWords } from '../messages.js';

/** The field for λ; its bounds are those that the package checks. */
const LAMBDA_FIELD = { 'lambda-value': { label: 'λ as a number', range: { ...between(1e-12, 1e15, 'from 10⁻¹² to 10¹⁵'), isWide: true }, optional: true, placeholder: 'auto' } };
/** Further options of the solver. */
const SOLVER_FIELDS = {
  gap: { label: 'Proven within', options: { 0.1: '10 %', 0.03: '3 %', 0.01: '1 %', 0.003: '0.3 %', 0.001: '0.1 %', 0.0001: '0.01 %' }, value: '0.01' },
  coarsening: { label: 'Lattice', options: { 1: 'one vertex per pixel', 2: 'spacing of 2 pixels', 4: 'spacing of 4 pixels' }, value: '1' },
  energy: { label: 'Energy', options: Object.fromEntries(Object.entries(ENERGIES).map(([energy, { name }]) => [energy, name])) },
  'find-occlusions': { label: 'Tear where it jumps (occlusions)', value: false, controls: 'threshold' },
  threshold: { label: 'Smallest jump', value: '4e4', range: { ...above(0), isWide: true } },
};

/** @param {Session} session @param {MeshFit} meshFit */
export function settingsPanel(session, meshFit) {
  const slider = element('lambda', HTMLInputElement);
  const hint = element('lambda-hint', HTMLElement);
  const auto = element('lambda-auto', HTMLButtonElement);
  const typed = fieldsOf(LAMBDA_FIELD, () => {
    if (typed.text('lambda-value').trim() === '') auto.click();
    else setLambda(typed.number('lambda-value'));
  });
  element('fidelity-number', HTMLElement).prepend(...typed.nodes());
  const options = fieldsOf(SOLVER_FIELDS, () => {
    const now = chosen();
    if (!options.check()) session.updateSettings(now);
  });
  element('solver-fields', HTMLElement).append(...options.nodes());

  /** @type {History<Settings>} */
  const history = new History(element('heights-side', HTMLElement), (settings) => adopt(settings));
  session.on('cleared', () => history.clear());
  session.on('result', ({ settings }) => history.note(settings));

  /** The further options that are chosen. */
  const chosen = () => {
    options.show(options.isChecked('find-occlusions'), 'threshold');
    const energy = /** @type {Energy} */ (options.text('energy'));
    options.hint('energy', ENERGIES[energy].about);
    return { gap: options.number('gap'), coarsening: options.number('coarsening'), energy, occlusionThreshold: options.isChecked('find-occlusions') ? options.number('threshold') : undefined };
  };
  /** @param {Settings} settings */
  const showOptions = ({ gap, coarsening, energy, occlusionThreshold }) => {
    for (const [name, value] of Object.entries({ gap, coarsening, energy })) options.set(/** @type {'gap'} */ (name), value);
    options.set('find-occlusions', occlusionThreshold !== undefined);
    if (occlusionThreshold !== undefined) options.set('threshold', shortLambda(occlusionThreshold));
    chosen();
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
    else if (meshFit.mesh) hint.textContent = (meshFit.surface && meshLambdaChoiceInWords(meshFit.surface)) || AUTO_LAMBDA_HINT;
    else hint.textContent = (result?.settings.lambda === 'auto' && lambdaChoiceInWords(result.surface, result.input.unit)) || AUTO_LAMBDA_HINT;
  };
  /** Shows λ in the controls. @param {number} lambda */
  const showLambda = (lambda) => {
    slider.value = String(Math.log10(lambda));
    slider.setAttribute('aria-valuetext', `λ = ${shortLambda(lambda)}`);
    typed.set('lambda-value', typed.number('lambda-value') === lambda ? typed.text('lambda-value') : shortLambda(lambda));
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
  auto.addEventListener('click', () => {
    showAuto(true);
    session.updateSettings({ lambda: 'auto' });
    updateHint();
  });
  showOptions(session.settings);

  /** Moves the slider to a λ that was chosen automatically. @param {number | undefined} lambda */
  const followAuto = (lambda) => {
    if (lambda !== undefined && session.settings.lambda === 'auto') showLambda(lambda);
    updateHint();
  };
  session.on('input', ({ lattice }) => {
    options.control('coarsening').disabled = lattice !== undefined;
    updateHint();
  });
  session.on('cleared', updateHint);
  session.on('result', ({ settings, surface }) => followAuto(settings.lambda === 'auto' && !meshFit.mesh ? surface.report.lambda : undefined));
  meshFit.on('start', updateHint);
  meshFit.on('result', ({ report }) => followAuto(meshFit.lambda === 'auto' ? report.lambda : undefined));
  meshFit.on('left', () => followAuto(session.result?.surface.report.lambda));

  /** Sets all settings, in the session and in the controls. @param {Settings} settings */
  const adopt = (settings) => {
    if (settings.lambda !== 'auto') showLambda(settings.lambda);
    showAuto(settings.lambda === 'auto');
    showOptions(settings);
    session.updateSettings(settings);
    updateHint();
  };
  return { adopt };
}
