/** What went wrong, at the top of the page. */
import { element } from '../dom.js';
import { complaint } from '../words.js';

/** @param {string} message */
export function showNotice(message) {
  element('notice-text', HTMLElement).textContent = message;
  element('notice', HTMLElement).hidden = false;
}

/** @param {string} doing what could not be done @param {unknown} error */
export function showFailure(doing, error) {
  showNotice(complaint(doing, error));
}

export function hideNotice() {
  element('notice', HTMLElement).hidden = true;
}
