/** Progress of the file that is being opened, and a button that cancels it. */
import { element } from '../dom.js';
import { PROGRESS_DELAY_MS, waitingPanel } from './waiting.js';

/** @param {import('../session.js').Session} session */
export function openingPanel(session) {
  const waiting = waitingPanel(element('opening', HTMLElement), () => session.cancelOpening(), PROGRESS_DELAY_MS);
  session.on('opening', (label) => (label ? waiting.begin(label) : waiting.end()));
}
