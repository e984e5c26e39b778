/** How far it is with what is being opened, and a way to do without it. */
import { element } from '../dom.js';
import { SOON, waitingPanel } from './waiting.js';

/** @import {Session, Slow} from '../session.js' */

/** @param {Session} session */
export function openingPanel(session) {
  /** @type {Slow | null} */
  let present = null;
  const waiting = waitingPanel(element('opening', HTMLElement), () => session.giveUp(), SOON);
  session.on('opening', (slow) => {
    if (slow) waiting.begin(slow);
    else if (present) waiting.end(present);
    present = slow;
  });
}
