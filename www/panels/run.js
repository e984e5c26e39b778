/** The button that solves, and the progress of solves of heights and meshes, which can be cancelled. */
import { element, elements } from '../dom.js';
import { RUN_WORDS } from '../messages.js';
import { waitingPanel } from './waiting.js';

/** Share of the progress for the coarser lattices. */
const COARSE_LATTICES_SHARE = 0.25;

/** @param {Session} session @param {MeshFit} meshFit @param {Stage} stage */
export function runPanel(session, meshFit, stage) {
  const form = element('controls', HTMLFormElement);
  const solve = element('run', HTMLButtonElement);
  const running = element('running', HTMLElement);
  /** First gap below 1 on the finest lattice. */
  let firstGap = NaN;
  /** Share of the progress that was told, which must not go back: λ may be chosen on finer lattices than the solve begins with. */
  let told = 0;
  /** Number of coarser lattices so far. */
  let levels = 0;

  form.addEventListener('submit', (event) => {
    event.preventDefault();
    const wrong = elements('#controls [aria-invalid="true"]', HTMLElement).find(canBeShown);
    if (wrong) wrong.focus();
    else stage.subject.run();
  });
  const waiting = waitingPanel(running, () => {
    waiting.tell({ fraction: told || undefined, label: RUN_WORDS.stopping });
    stage.subject.cancel();
  });
  /** Ends the progress. Solving is the main thing where there is no result, or none that is as good as was asked for. @param {boolean} isStale */
  const end = (isStale) => {
    form.toggleAttribute('data-stale', isStale);
    solve.classList.toggle('primary', isStale);
    const hadFocus = running.contains(document.activeElement);
    waiting.end();
    if (hadFocus) (isStale ? solve : element('lambda', HTMLInputElement)).focus();
  };
  const begin = () => {
    [firstGap, levels, told] = [NaN, 0, 0];
    form.removeAttribute('data-stale');
    solve.classList.remove('primary');
    waiting.begin('solving');
  };

  session.on('start', begin);
  session.on('phase', (phase) => {
    if (phase !== 'running') end(phase === 'idle' && (session.result === null || session.result.surface.report.stopReason === 'cancelled'));
  });
  session.on('progress', ({ level, iteration, gap }) => {
    if (level > 0) {
      levels = Math.max(levels, level);
      told = Math.max(told, COARSE_LATTICES_SHARE * (1 - level / (levels + 1)));
      return waiting.tell({ fraction: told, label: RUN_WORDS.coarse(level) });
    }
    if (gap !== undefined && gap < 1) {
      const coarse = levels > 0 ? COARSE_LATTICES_SHARE : 0;
      if (Number.isNaN(firstGap)) firstGap = gap;
      if (firstGap > 0) told = Math.max(told, coarse + (1 - coarse) * gapProgress(gap, firstGap, session.settings.gap));
    }
    waiting.tell({ fraction: told, label: RUN_WORDS.fine(gap, iteration) });
  });
  meshFit.on('start', begin);
  meshFit.on('progress', ({ iteration }) => waiting.tell({ label: RUN_WORDS.fine(undefined, iteration) }));
  meshFit.on('result', () => end(false));
  meshFit.on('failure', () => end(true));
  meshFit.on('cancelled', () => end(true));
  meshFit.on('left', () => end(session.result === null));
}

/** Whether a field belongs to what is shown; a fold that it is in is opened for it. @param {HTMLElement} field */
function canBeShown(field) {
  const fold = field.closest('details');
  const wasOpen = fold?.open ?? true;
  if (fold) fold.open = true;
  const isShown = field.checkVisibility();
  if (fold && !isShown) fold.open = wasOpen;
  return isShown;
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
