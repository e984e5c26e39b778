/** Progress of the file that is being opened, and a button that cancels it. */
import { element } from '../dom.js';
import { PROGRESS_DELAY_MS, waitingPanel } from './waiting.js';

/** @import {Session, TimedTask} from '../session.js' */

/** @param {Session} session */
export function openingPanel(session) {
  /** @type {TimedTask | null} */
  let present = null;
  const waiting = waitingPanel(element('opening', HTMLElement), () => {
    // What is cancelled tells nothing of how long it would have taken.
    present = null;
    session.cancelOpening();
  }, PROGRESS_DELAY_MS);
  session.on('opening', (task) => {
    if (task) waiting.begin(task);
    else waiting.end(present ?? undefined);
    present = task;
  });
}
