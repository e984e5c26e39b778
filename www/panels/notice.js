/** What went wrong, at the top of the page. */
import { element } from '../dom.js';
import { complaint } from '../words.js';

/**
 * @param {string} message
 * @param {'alert' | 'note'} [kind]
 */
export function showNotice(message, kind = 'alert') {
  element('notice-text', HTMLElement).textContent = message;
  element('notice', HTMLElement).dataset.kind = kind;
  element('notice', HTMLElement).hidden = false;
}

/** @param {string} doing what could not be done @param {unknown} error */
export function showFailure(doing, error) {
  showNotice(complaint(doing, error));
}

export function hideNotice() {
  element('notice', HTMLElement).hidden = true;
}
