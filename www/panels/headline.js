/** The headline of heights: the result in one sentence, its certificate, and error messages. */
import { element } from '../dom.js';
import { count } from '../format.js';
import { certificateInWords, HEADLINE_WORDS, noiseReductionInWords, piecesInWords, TASK_WORDS } from '../messages.js';
import { hideNotice, showError } from './notice.js';
import { PROGRESS_DELAY_MS } from './waiting.js';

/** Maximum number of attempts to count the pieces: other analyses may cancel one. */
const MAX_PIECE_COUNT_ATTEMPTS = 3;

/** @param {Session} session @param {Analyses} analyses @param {Stage} stage @param {Subject} heights */
export function headlinePanel(session, analyses, stage, heights) {
  const main = element('verdict', HTMLElement);
  const page = element('page', HTMLElement);
  const chip = element('certificate', HTMLElement);
  const report = element('report-open', HTMLButtonElement);
  const drawer = element('drawer', HTMLElement);
  let pieceCountTimer = 0;
  /** @param {string} sentence @param {string} details */
  const say = (sentence, details) => stage.say(heights, sentence, details);

  report.addEventListener('click', () => {
    drawer.hidden = !drawer.hidden;
    report.setAttribute('aria-expanded', String(!drawer.hidden));
    if (!drawer.hidden) drawer.scrollIntoView({ block: 'nearest' });
  });

  /** @param {Result} result */
  const showPieces = async (result) => {
    for (let attempt = 0; attempt < MAX_PIECE_COUNT_ATTEMPTS && session.result === result; attempt++) {
      const pieces = await analyses.patchCount(result).catch(() => null);
      if (session.result !== result) return;
      if (pieces) return sayResult(piecesInWords(pieces.count, pieces.creases, result.input.sampling !== undefined));
    }
    if (session.result === result) sayResult(HEADLINE_WORDS.solved);
  };
  /** @param {string} sentence */
  const sayResult = (sentence) => {
    say(sentence, detailsOf(session));
    main.setAttribute('aria-busy', 'false');
  };

  session.on('input', (input) => {
    hideNotice();
    if (input.kind) say(HEADLINE_WORDS.opened(input.name), '');
  });
  session.on('start', () => {
    hideNotice();
    // A headline of an earlier result stays until the run ends.
    if (!session.result) say(HEADLINE_WORDS.solving, detailsOf(session));
  });
  session.on('result', (result) => {
    const { gap, stopReason } = result.surface.report;
    chip.hidden = report.hidden = false;
    chip.textContent = certificateInWords(result.surface.report);
    chip.dataset.mark = stopReason === 'cancelled' || (gap === undefined && stopReason !== 'rounding') ? 'doubt' : 'sure';
    // One sentence, once it is known; until then the one from before.
    main.setAttribute('aria-busy', 'true');
    clearTimeout(pieceCountTimer);
    // While λ is dragged, results follow each other quickly.
    pieceCountTimer = window.setTimeout(() => void showPieces(result), PROGRESS_DELAY_MS);
  });
  session.on('cleared', () => {
    chip.hidden = report.hidden = true;
    main.setAttribute('aria-busy', 'false');
  });
  session.on('opening', (task) => {
    page.toggleAttribute('data-opening', task !== null);
    if (session.input) return;
    if (task) say(`${TASK_WORDS[task]}…`, '');
    else say('Nothing to show yet.', 'Choose an example or open a file.');
  });
  session.on('phase', (phase) => (page.dataset.phase = phase));
  session.on('unsolved', () => {
    say(HEADLINE_WORDS.unsolved, session.result ? HEADLINE_WORDS.stays : '');
    main.setAttribute('aria-busy', 'false');
  });
  session.on('failure', ({ doing, error }) => showError(doing, error));
}

/** Noise reduction or size, for the line below the headline. @param {Session} session */
const detailsOf = ({ input, result }) => (input && (result?.input === input ? noiseReductionInWords(result.accuracy) : `${count(input.width * input.height)} pixels.`)) ?? '';
