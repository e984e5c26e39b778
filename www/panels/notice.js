/** What went wrong, at the top of the page. */
import { element } from '../dom.js';
import { complaint } from '../messages.js';

/**
 * @typedef {object} Offer what can be done about it
 * @property {string} label of a button
 * @property {() => void} act
 *
 * @param {string} message
 * @param {'alert' | 'note'} [kind]
 * @param {Offer} [offer]
 */
export function showNotice(message, kind = 'alert', offer) {
  const notice = element('notice', HTMLElement);
  element('notice-text', HTMLElement).textContent = message;
  const button = element('notice-act', HTMLButtonElement);
  button.hidden = offer === undefined;
  button.textContent = offer?.label ?? '';
  button.onclick = () => {
    hideNotice();
    offer?.act();
  };
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
