/** One dialog for whatever is saved: formats to choose from, how large the file will be, and then the file. */
import { apart } from '../worker-task.js';
import { download, element, make } from '../dom.js';
import { fileSize } from '../format.js';
import { plainly } from '../error-messages.js';
import { SAVE_WORDS } from '../messages.js';
import { SOON, waitingPanel } from './waiting.js';

/** @import {Worker} from '../worker-task.js' */
/** @import {Api} from '../api.js' */

/**
 * @typedef {object} Format
 * @property {string} value the ending of the file's name
 * @property {string} name
 * @property {string} words what it is for
 * @property {string} type
 * @property {string} [without] why it cannot be had now
 * @property {(worker: Worker) => Promise<Uint8Array<ArrayBuffer> | string>} write
 *
 * @typedef {object} Offer
 * @property {string} title
 * @property {string} stem of the file's name
 * @property {number} size pixels, or vertices
 * @property {() => Promise<unknown>} [ready] what has to be there before anything can be written
 * @property {readonly Format[]} formats
 * @property {readonly Node[]} [extra] above the formats
 * @property {() => void} [closed] when nothing of it is wanted any more
 */

/** Milliseconds for each of what is written, until that was measured. */
const EACH = 1e-3;

/** What is being written. @type {AbortController | null} */
let present = null;
/** Made with the first offer. @type {ReturnType<typeof waitingPanel> | null} */
let waiting = null;
/** The format that was taken last, by the dialog's title. @type {Map<string, string>} */
const taken = new Map();

/**
 * @param {Api} api
 * @param {Offer} offer
 * @returns {{ renew: () => void }} to be called when what is offered has changed
 */
export function offerToSave(api, { title, stem, size: amount, ready = async () => {}, formats, extra = [], closed = () => {} }) {
  const dialog = element('save-dialog', HTMLDialogElement);
  const list = element('save-formats', HTMLElement);
  const size = element('save-size', HTMLElement);
  const save = element('save-now', HTMLButtonElement);
  element('save-title', HTMLElement).textContent = title;
  element('save-extra', HTMLElement).replaceChildren(...extra);
  const possible = formats.filter(({ without }) => !without);
  const wanted = possible.find(({ value }) => value === taken.get(title)) ?? possible[0];
  const radios = formats.map(({ value, name, words, without }) => {
    const radio = make('input', '');
    Object.assign(radio, { type: 'radio', name: 'save-format', value, checked: value === wanted?.value, disabled: without !== undefined });
    radio.addEventListener('change', () => void write());
    return make('label', 'format', radio, make('span', '', make('strong', '', name), ` ${without ?? words}`));
  });
  list.replaceChildren(...radios);

  const again = element('save-again', HTMLButtonElement);
  const wait = (waiting ??= waitingPanel(element('writing', HTMLElement), () => {
    giveUp();
    element('save-size', HTMLElement).textContent = SAVE_WORDS.cancelled;
    again.hidden = false;
    again.focus();
  }, SOON));
  const giveUp = () => {
    present?.abort();
    present = null;
    wait.end();
  };

  const write = async () => {
    giveUp();
    const mine = (present = new AbortController());
    again.hidden = true;
    const value = list.querySelector('input:checked')?.getAttribute('value');
    const format = formats.find((one) => one.value === value);
    save.disabled = true;
    if (!format) return;
    taken.set(title, format.value);
    size.textContent = '';
    try {
      await ready();
      if (mine !== present) return;
      size.textContent = SAVE_WORDS.working;
      const slow = { words: SAVE_WORDS.write, kind: `${title}, ${format.value}`, size: amount, each: EACH };
      wait.begin(slow);
      const content = await apart(api, mine.signal, format.write);
      if (mine !== present) return;
      wait.end(slow);
      size.textContent = `${stem}.${format.value}, ${fileSize(new Blob([content]).size)}`;
      save.disabled = false;
      save.onclick = () => {
        download(content, format.type, `${stem}.${format.value}`);
        // It stays open: the next format is of the same size.
        size.textContent = SAVE_WORDS.saved(`${stem}.${format.value}`);
      };
    } catch (error) {
      if (mine !== present) return;
      wait.end();
      const reason = plainly(error instanceof Error ? error.message : String(error));
      size.textContent = SAVE_WORDS.unwritten(reason);
    }
  };
  dialog.onclose = () => {
    giveUp();
    save.onclick = null;
    element('save-extra', HTMLElement).replaceChildren();
    closed();
  };
  // Beside it is as good as its cross.
  dialog.onclick = (event) => {
    if (event.target === dialog) dialog.close();
  };
  again.onclick = () => void write();
  if (!dialog.open) dialog.showModal();
  void write();
  return { renew: () => void write() };
}
