/** How far the file is that is being opened, and a way to do without it. */
import { element } from '../dom.js';
import { waitingPanel } from './waiting.js';

/** @import {Session} from '../session.js' */

/** Milliseconds for a byte, until that was measured. */
const EACH = 2e-5;

/** @param {Session} session */
export function openingPanel(session) {
  /** @type {File | null} */
  let present = null;
  const panel = element('opening', HTMLElement);
  const waiting = waitingPanel(panel, 'Reading the file', () => session.giveUp());
  /** @param {File} file */
  const kindOf = ({ name }) => name.slice(name.lastIndexOf('.') + 1).toLowerCase();
  session.on('opening', (file) => {
    if (file) waiting.begin(kindOf(file), file.size, EACH);
    else if (present) waiting.end(kindOf(present), present.size);
    present = file;
  });
}
