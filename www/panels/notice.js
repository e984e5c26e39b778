/** Notices and error messages at the top of the page. */
import { element } from '../dom.js';
import { errorMessage } from '../messages.js';

/** Shows a notice in the place of the last one. @param {string} message @param {'alert' | 'note'} [kind] @param {{ label: string, act: () => void }} [action] of its button */
export function showNotice(message, kind = 'alert', action) {
  const notice = element('notice', HTMLElement);
  element('notice-text', HTMLElement).textContent = message;
  const button = element('notice-act', HTMLButtonElement);
  button.hidden = action === undefined;
  button.textContent = action?.label ?? '';
  button.onclick = () => {
    hideNotice();
    action?.act();
  };
  notice.dataset.kind = kind;
  notice.hidden = false;
  // The notice may lie above the visible part of the page.
  if (kind === 'alert') notice.scrollIntoView({ block: 'nearest' });
}

/** Shows an error. @param {string} doing what could not be done @param {unknown} error */
export const showError = (doing, error) => showNotice(errorMessage(doing, error));

/** Hides the notice. */
export const hideNotice = () => void (element('notice', HTMLElement).hidden = true);
