/** The button that solves, and the progress of solves of heights and meshes, which can be cancelled. */
import { element, elements } from '../dom.js';
import { RUN_WORDS } from '../messages.js';
import { waitingPanel } from './waiting.js';

/** Share of the progress for the coarser lattices. */
const COARSE_LATTICES_SHARE = 0.25;
/** Number of times that the gap descends with the default energy: in the solve, and in each of its two passes over the creases. */
const HUBER_DESCENTS = 3;

/** @param {Session} session @param {MeshFit} meshFit @param {Stage} stage */
export function runPanel(session, meshFit, stage) {
  const form = element('controls', HTMLFormElement);
  const solve = element('run', HTMLButtonElement);
  const running = element('running', HTMLElement);
  /** The present descent of the gap on the finest lattice: its first gap below 1, its last one, the progress before it, and how many are left. */
  let descent = { first: NaN, last: NaN, before: 0, left: 0 };
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
    [levels, told, descent] = [0, 0, { first: NaN, last: NaN, before: 0, left: session.settings.energy === 'huber' ? HUBER_DESCENTS : 1 }];
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
    if (gap !== undefined) {
      // A pass begins anew.
      if (gap > descent.last) descent = { first: NaN, last: gap, before: told, left: Math.max(1, descent.left - 1) };
      else if (Number.isNaN(descent.last)) descent.before = told;
      descent.last = gap;
      if (gap < 1) descent.first ||= gap;
      told = Math.max(told, descent.before + ((1 - descent.before) / descent.left) * gapProgress(gap, descent.first, session.settings.gap));
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
  return Math.min(1, Math.max(0, Math.log(firstGap / gap) / Math.log(firstGap / requestedGap) || 0));
}
