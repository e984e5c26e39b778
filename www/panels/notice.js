/** What went wrong, at the top of the page. */
import { element } from '../dom.js';
import { complaint } from '../messages.js';

/**
 * @param {string} message
 * @param {'alert' | 'note'} [kind]
 */
export function showNotice(message, kind = 'alert') {
  const notice = element('notice', HTMLElement);
  element('notice-text', HTMLElement).textContent = message;
  notice.dataset.kind = kind;
  notice.hidden = false;
  // Whoever is further down would not know.
  if (kind === 'alert') notice.scrollIntoView({ block: 'nearest' });
}

/** @param {string} doing what could not be done @param {unknown} error */
export function showFailure(doing, error) {
  showNotice(complaint(doing, error));
}

export function hideNotice() {
  element('notice', HTMLElement).hidden = true;
}
