/** The outcome up front, in plain words, its certificate, and messages about what went wrong. */
import { element } from '../dom.js';
import { count } from '../format.js';
import { accuracyOf } from '../surface/known.js';
import { closer, HEADLINE_WORDS, outcome, verdict } from '../messages.js';
import { hideNotice, showFailure } from './notice.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result, Session} from '../session.js' */

/** How long a result stands, in milliseconds, before its pieces are counted: while λ is dragged one follows the other. */
const REST = 150;
/**
 * @param {Session} session
 * @param {Analyses} analyses
 */
export function headline(session, analyses) {
  const main = element('verdict', HTMLElement);
  const detail = element('verdict-detail', HTMLElement);
  const page = element('page', HTMLElement);
  const chip = element('certificate', HTMLButtonElement);
  const drawer = element('drawer', HTMLElement);
  let rest = 0;
  /** @param {string} first @param {string} second */
  const say = (first, second) => {
    main.textContent = first;
    detail.textContent = second;
  };

  chip.addEventListener('click', () => {
    drawer.hidden = !drawer.hidden;
    chip.setAttribute('aria-expanded', String(!drawer.hidden));
    if (!drawer.hidden) drawer.scrollIntoView({ block: 'nearest' });
  });

  /** @param {Result} result */
  const tellPieces = async (result) => {
    // Another question may have stopped the worker before it answered.
    for (let turn = 0; turn < 3 && session.result === result; turn++) {
      const pieces = await analyses.pieces(result).catch(() => null);
      if (session.result !== result) return;
      if (!pieces) continue;
      main.textContent = outcome(pieces.count, pieces.creases, result.input.seen !== undefined);
      break;
    }
    if (session.result === result) main.setAttribute('aria-busy', 'false');
  };

  session.on('input', (input) => {
    hideNotice();
    if (input.kind) say(HEADLINE_WORDS.opened(input.name), '');
  });
  session.on('start', () => {
    hideNotice();
    // What stands there is replaced by what comes of the run.
    if (!session.result) say(HEADLINE_WORDS.solving, describe(session));
  });
  session.on('result', (result) => {
    const { report } = result.surface;
    chip.hidden = false;
    chip.textContent = verdict(report);
    chip.dataset.mark = report.stopReason === 'cancelled' || (report.gap === undefined && report.stopReason !== 'rounding') ? 'doubt' : 'sure';
    say(HEADLINE_WORDS.solved, describe(session));
    main.setAttribute('aria-busy', 'true');
    clearTimeout(rest);
    rest = window.setTimeout(() => void tellPieces(result), REST);
  });
  session.on('cleared', () => {
    chip.hidden = true;
    main.setAttribute('aria-busy', 'false');
  });
  session.on('phase', (phase) => {
    page.dataset.phase = phase;
    if (phase === 'idle' && !session.input) say('Nothing to show yet.', 'Choose an example or open a file.');
  });
  session.on('unsolved', () => {
    say(HEADLINE_WORDS.unsolved, session.result ? HEADLINE_WORDS.stays : '');
    main.setAttribute('aria-busy', 'false');
  });
  session.on('failure', ({ doing, error }) => showFailure(doing, error));
}

/** @param {Session} session */
function describe({ input, result }) {
  if (!input) return '';
  const report = result?.input === input ? result.surface.report : null;
  const size = report ? `${count(report.interior + report.boundary)} vertices.` : `${count(input.width * input.height)} pixels.`;
  return [report ? closer(factorOf(/** @type {Result} */ (result))) : '', size, input.assumed].filter(Boolean).join(' ');
}

/** How many times closer to the truth the result is than the input, where that is known. @param {Result} result */
function factorOf(result) {
  const heights = accuracyOf(result)?.heights;
  return heights && heights.after > 0 && heights.before > 0 ? heights.before / heights.after : undefined;
}
