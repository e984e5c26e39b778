/** The settings of a solve, as options of the package. */

/** @import {Energy} from './api.js' */
/** @import {Input, Settings} from './session.js' */

/** λ of a design with automatic λ: its input has no noise from which λ could be chosen. */
const DESIGN_LAMBDA = 1e6;

/**
 * The energy of a solve: the one that was chosen, or the default for the input, which is also the package's.
 * @param {Pick<Input, 'design'> | null} input
 * @param {Settings['energy']} chosen
 * @returns {Energy}
 */
export function energyFor(input, chosen) {
  return chosen ?? (input?.design ? 'nuclear' : 'huber');
}

/**
 * The settings of a solve: a fixed λ replaces the automatic one of a design.
 * @param {Pick<Input, 'design'>} input
 * @param {Settings} settings
 * @returns {Settings & { energy: Energy }}
 */
export function settingsFor(input, settings) {
  const { lambda, energy } = settings;
  return { ...settings, energy: energyFor(input, energy), lambda: input.design && lambda === 'auto' ? DESIGN_LAMBDA : lambda };
}
