/** Buttons that start and cancel a run, and its progress. */
import { element } from '../dom.js';
import { seconds } from '../format.js';
import { RUN_WORDS } from '../messages.js';

/** @import {Session} from '../session.js' */

/** Share of the progress bar for the coarser lattices. */
const COARSE_LATTICES_SHARE = 0.25;

/** @param {Session} session */
export function runPanel(session) {
  const form = element('controls', HTMLFormElement);
  const cancel = element('cancel', HTMLButtonElement);
  const bar = element('progress', HTMLProgressElement);
  const text = element('progress-text', HTMLElement);
  const running = element('running', HTMLElement);
  const solve = element('run', HTMLButtonElement);
  /** First gap below 1 on the finest lattice. */
  let firstGap = NaN;
  /** Value of the progress bar at the first gap. */
  let firstShare = 0;
  /** Number of coarser lattices so far. */
  let levels = 0;

  form.addEventListener('submit', (event) => {
    event.preventDefault();
    if (form.reportValidity()) void session.run();
  });
  // `aria-disabled` in the place of `disabled`, so that the button keeps the focus while a run ends.
  cancel.addEventListener('click', () => {
    if (session.phase !== 'running') return;
    text.textContent = RUN_WORDS.stopping;
    cancel.setAttribute('aria-disabled', 'true');
    session.cancel();
  });

  // Solving is the main thing where there is no result, or none that is as good as was asked for.
  session.on('phase', (phase) => {
    const isStale = phase === 'idle' && (session.result === null || session.result.surface.report.stopReason === 'cancelled');
    form.toggleAttribute('data-stale', isStale);
    solve.classList.toggle('primary', isStale);
    const hadFocus = document.activeElement === cancel;
    running.hidden = phase !== 'running';
    if (hadFocus && running.hidden) (isStale ? solve : element('lambda', HTMLInputElement)).focus();
  });
  session.on('start', () => {
    cancel.setAttribute('aria-disabled', 'false');
    firstGap = NaN;
    levels = 0;
    bar.value = 0;
    text.textContent = RUN_WORDS.begun;
  });
  session.on('progress', ({ level, iteration, gap, elapsed }) => {
    if (level > 0) {
      levels = Math.max(levels, level);
      // The bar must not move back: λ may be chosen on finer lattices than the solve then begins with.
      bar.value = Math.max(bar.value, COARSE_LATTICES_SHARE * (1 - level / (levels + 1)));
      text.textContent = RUN_WORDS.coarse(level, seconds(elapsed));
      return;
    }
    const isCertified = gap !== undefined && gap < 1;
    if (isCertified && Number.isNaN(firstGap)) {
      firstGap = gap;
      firstShare = levels > 0 ? COARSE_LATTICES_SHARE : 0;
    }
    if (isCertified && firstGap > 0) {
      const share = firstShare + (1 - firstShare) * gapProgress(gap, firstGap, session.settings.gap);
      bar.value = Math.max(bar.value, share);
    }
    text.textContent = RUN_WORDS.fine(gap, iteration, seconds(elapsed));
  });
  session.on('result', ({ surface: { report } }) => {
    if (report.stopReason !== 'cancelled') bar.value = 1;
  });
}

/**
 * Progress from the first gap to the requested one, from 0 to 1. The gap falls about geometrically, so that its
 * logarithm falls about linearly.
 * @param {number} gap
 * @param {number} firstGap
 * @param {number} requestedGap
 */
function gapProgress(gap, firstGap, requestedGap) {
  if (!(gap > requestedGap)) return 1;
  return Math.min(1, Math.max(0, Math.log(firstGap / gap) / Math.log(firstGap / requestedGap)));
}
