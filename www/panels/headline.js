/** The outcome up front, in plain words, and messages about what went wrong. */
import { element } from '../dom.js';
import { count } from '../format.js';
import { accuracyOf } from '../surface/known.js';
import { improvement, verdict } from '../words.js';
import { hideNotice, showFailure } from './notice.js';

/** @import {Result, Session} from '../session.js' */

/** @param {Session} session */
export function headline(session) {
  const main = element('verdict', HTMLElement);
  const detail = element('verdict-detail', HTMLElement);
  const page = element('page', HTMLElement);
  /** @param {string} first @param {string} second */
  const say = (first, second) => {
    main.textContent = first;
    detail.textContent = second;
  };

  session.on('input', (input) => {
    hideNotice();
    if (input.kind) say(`Opened ${input.name}.`, `${input.seen ? 'Choose where to look from' : 'Check the pixel size and the height scale'}, choose λ, then press Run.`);
  });
  session.on('start', () => {
    hideNotice();
    say('Solving…', describe(session));
  });
  session.on('result', (result) => {
    say(verdict(result.surface.report), `${describe(session)} ${closeness(result)}`);
  });
  session.on('phase', (phase) => {
    page.dataset.phase = phase;
    if (phase === 'idle' && !session.input) say('Nothing to show yet.', 'Choose an example or open a file.');
  });
  session.on('unsolved', () => say('Not solved.', session.result ? 'The result before it stays.' : ''));
  session.on('failure', ({ doing, error }) => showFailure(doing, error));
}

/** @param {Session} session */
function describe({ input, result }) {
  if (!input) return '';
  const report = result?.input === input ? result.surface.report : null;
  const vertices = report ? `${count(report.interior + report.boundary)} vertices.` : '';
  return vertices || `${count(input.width * input.height)} pixels.`;
}

/** @param {Result} result */
function closeness(result) {
  const accuracy = accuracyOf(result);
  return accuracy ? improvement(accuracy.heights.before, accuracy.heights.after) : '';
}
