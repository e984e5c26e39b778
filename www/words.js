/** What happened, in plain words. */
import { count, percentAtMost, seconds } from './format.js';

/** @import {Report, StopReason} from './api.js' */

/** @type {Record<StopReason, string>} */
export const STOP_REASONS = {
  gap: 'the wanted gap was certified',
  residuals: 'the residuals were small enough (the paper’s rule)',
  rounding: 'nothing left to bend: the optimum, up to rounding',
  maxIterations: 'the most iterations allowed',
  cancelled: 'cancelled; this is the best surface so far',
};

/** A gap above this says little: the objective could be twice the optimum. */
const USEFUL = 0.5;

/**
 * The one sentence that matters.
 * @param {Report} report
 */
export function verdict({ gap, seconds: { total }, stopReason }) {
  const time = seconds(total);
  const within = gap < USEFUL ? `within ${percentAtMost(gap)} of the optimum` : '';
  if (stopReason === 'cancelled') {
    return `Cancelled after ${time}: ${within ? `the surface so far is ${within}` : 'too early to tell how far the surface is from the optimum'}.`;
  }
  if (stopReason === 'rounding') return `Flat up to rounding: this is the optimum, found in ${time}.`;
  return within ? `Certified to ${within} in ${time}.` : `Stopped after ${time}, too early for a useful certificate.`;
}

/**
 * How much closer to the truth the result is than the input was.
 * @param {number} before
 * @param {number} after
 */
export function improvement(before, after) {
  if (!(after > 0) || !(before > 0)) return '';
  const factor = before / after;
  if (factor >= 1.05) return `${factor >= 10 ? count(factor) : factor.toFixed(1)} times closer to the true surface than the input.`;
  return 'No closer to the true surface than the input was: try a smaller λ for much noise, a bigger one for little.';
}

/**
 * When to use which λ: the paper's heuristic (Sec. 5), continued to both sides.
 * @param {number} lambda
 */
export function lambdaHint(lambda) {
  const exponent = Math.log10(lambda);
  if (exponent < 4.5) return 'Very small: a few large, smooth patches; most detail goes.';
  if (exponent < 5.5) return 'Small: for heavy noise, or to make do with few patches.';
  if (exponent < 6.5) return 'Medium: for some noise, and shapes to be approximated by patches.';
  if (exponent < 7.5) return 'Big: for input that is nearly developable but for small artefacts.';
  return 'Very big: stays close to the input, and keeps its noise.';
}

/**
 * A failure as one message.
 * @param {string} doing what could not be done
 * @param {unknown} error
 */
export function complaint(doing, error) {
  const reason = error instanceof Error ? error.message : String(error);
  return `${doing}: ${reason.replace(/\.$/, '')}.`;
}
