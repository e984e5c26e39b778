/** Run, cancel, and how far it is. */
import { element } from '../dom.js';
import { seconds } from '../format.js';
import { RUN_WORDS } from '../messages.js';

/** @import {Session} from '../session.js' */

/** What the coarser lattices take of the bar. */
const COARSE = 0.25;

/** @param {Session} session */
export function runPanel(session) {
  const form = element('controls', HTMLFormElement);
  const cancel = element('cancel', HTMLButtonElement);
  const bar = element('progress', HTMLProgressElement);
  const text = element('progress-text', HTMLElement);
  /** The first gap below 1 on the finest lattice, and where the bar was then. */
  let first = NaN;
  let begin = 0;
  let levels = 0;

  form.addEventListener('submit', (event) => {
    event.preventDefault();
    if (form.reportValidity()) void session.run();
  });
  // Only said to be disabled, so that the keyboard's focus is not lost when a run ends.
  cancel.addEventListener('click', () => {
    if (session.phase !== 'running') return;
    text.textContent = RUN_WORDS.stopping;
    cancel.setAttribute('aria-disabled', 'true');
    session.cancel();
  });

  session.on('phase', (phase) => cancel.setAttribute('aria-disabled', String(phase !== 'running')));
  session.on('start', () => {
    cancel.setAttribute('aria-disabled', 'false');
    first = NaN;
    levels = 0;
    bar.value = 0;
    text.textContent = RUN_WORDS.begun;
  });
  session.on('progress', ({ level, iteration, gap, elapsed }) => {
    if (level > 0) {
      levels = Math.max(levels, level);
      // The search for λ is on coarser lattices than the solve begins with, or on finer ones.
      bar.value = Math.max(bar.value, COARSE * (1 - level / (levels + 1)));
      text.textContent = RUN_WORDS.coarse(level, seconds(elapsed));
      return;
    }
    const known = gap !== undefined && gap < 1;
    if (known && Number.isNaN(first)) {
      first = gap;
      begin = levels > 0 ? COARSE : 0;
    }
    if (known && first > 0) {
      const share = begin + (1 - begin) * reached(gap, first, session.settings.gap);
      bar.value = Math.max(bar.value, share);
    }
    text.textContent = RUN_WORDS.fine(gap, iteration, seconds(elapsed));
  });
  session.on('result', ({ surface: { report } }) => {
    if (report.stopReason !== 'cancelled') bar.value = 1;
    text.textContent = RUN_WORDS.fine(report.gap, report.iterations, seconds(report.seconds.total));
  });
  session.on('unsolved', () => {
    text.textContent = RUN_WORDS.unsolved;
  });
  session.on('cleared', () => {
    bar.value = 0;
    text.textContent = '\u00a0';
  });
}

/**
 * Share of the way from the first gap to the wanted one. The gap falls about
 * geometrically, so logarithms make the bar move about evenly.
 * @param {number} gap
 * @param {number} first
 * @param {number} wanted
 */
function reached(gap, first, wanted) {
  if (!(gap > wanted)) return 1;
  return Math.min(1, Math.max(0, Math.log(first / gap) / Math.log(first / wanted)));
}
