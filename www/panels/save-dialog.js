/** The save dialog: choice of a format, size of the file, and its download. */
import { runInWorker } from '../worker-task.js';
import { download, element, make } from '../dom.js';
import { fileSize } from '../format.js';
import { keep, kept } from '../kept.js';
import { plainMessage } from '../error-messages.js';
import { SAVE_WORDS } from '../messages.js';
import { PROGRESS_DELAY_MS, waitingPanel } from './waiting.js';

/**
 * @typedef {object} Format
 * @property {string} value ending of the file's name
 * @property {string} name
 * @property {string} words purpose of the format
 * @property {string} type media type
 * @property {string} [stem] file name without its ending, where it differs from that of the offer
 * @property {() => string} [note] sentence about the file that was written, such as what it lacks
 * @property {string} [without] reason why the format is not available
 * @property {(worker: PackageWorker, signal: AbortSignal) => Promise<Uint8Array<ArrayBuffer> | Blob | string>} write `signal` aborts when the dialog is closed
 *
 * @typedef {object} SaveOffer
 * @property {string} title
 * @property {string} stem file name without its ending
 * @property {() => Promise<unknown>} [ready] resolves when the file can be written
 * @property {readonly Format[]} formats
 * @property {string | null} [unit] unit of the lengths in the file, if it is known
 * @property {readonly Node[]} [extra] elements above the formats
 * @property {() => void} [closed] called when the dialog is closed
 */

/** Maximum time between the clicks of a double click, in milliseconds. */
const DOUBLE_CLICK_MS = 500;

/** The file that is being written. @type {AbortController | null} */
let present = null;
/** Created with the first dialog. @type {ReturnType<typeof waitingPanel> | null} */
let waiting = null;
/** Formats that were chosen last, by the title of the dialog. @type {Record<string, string>} */
const lastFormats = kept('formats', {});

/**
 * Opens the dialog, and writes the file in the format that was chosen last.
 * @param {Api} api
 * @param {SaveOffer} offer
 * @returns {{ renew: () => void }} `renew` writes the file again, after its contents have changed
 */
export function offerToSave(api, { title, stem, ready = async () => {}, formats, unit, extra = [], closed = () => {} }) {
  const dialog = element('save-dialog', HTMLDialogElement);
  const list = element('save-formats', HTMLElement);
  const size = element('save-size', HTMLElement);
  const save = element('save-now', HTMLButtonElement);
  const share = element('save-share', HTMLButtonElement);
  element('save-title', HTMLElement).textContent = title;
  element('save-extra', HTMLElement).replaceChildren(...(unit ? [make('p', 'muted small', SAVE_WORDS.unit(unit))] : []), ...extra);
  const available = formats.filter(({ without }) => !without);
  const initial = available.find(({ value }) => value === lastFormats[title]) ?? available[0];
  const radios = formats.map(({ value, name, words, without }) => {
    const radio = make('input', '');
    Object.assign(radio, { type: 'radio', name: 'save-format', value, checked: value === initial?.value, disabled: without !== undefined });
    radio.addEventListener('change', () => void write());
    return make('label', 'format', radio, make('span', '', make('strong', '', name), ` ${without ?? words}`));
  });
  list.replaceChildren(...radios);

  const retryButton = element('save-again', HTMLButtonElement);
  const progress = (waiting ??= waitingPanel(element('writing', HTMLElement), () => {
    cancelWriting();
    element('save-size', HTMLElement).textContent = SAVE_WORDS.cancelled;
    element('save-now', HTMLButtonElement).disabled = true;
    retryButton.hidden = false;
    retryButton.focus();
  }, PROGRESS_DELAY_MS));
  const cancelWriting = () => {
    present?.abort();
    present = null;
    progress.end();
  };

  const write = async () => {
    cancelWriting();
    const job = (present = new AbortController());
    retryButton.hidden = true;
    const value = list.querySelector('input:checked')?.getAttribute('value');
    const format = formats.find((one) => one.value === value);
    save.disabled = true;
    share.hidden = true;
    if (!format) return;
    lastFormats[title] = format.value;
    keep('formats', lastFormats);
    size.textContent = '';
    try {
      await ready();
      if (job !== present) return;
      size.textContent = SAVE_WORDS.working;
      progress.begin('writing');
      const content = await runInWorker(api, job.signal, (worker) => format.write(worker, job.signal));
      if (job !== present) return;
      progress.end();
      const name = `${format.stem ?? stem}.${format.value}`;
      const note = format.note?.() ?? '';
      size.textContent = [`${name}, ${fileSize(new Blob([content]).size)}${note && '.'}`, note].filter(Boolean).join(' ');
      save.disabled = false;
      const files = [new File([content], name, { type: format.type })];
      // The system's share sheet, where it takes such files: on phones.
      share.hidden = !navigator.canShare?.({ files });
      share.onclick = () => void navigator.share({ files }).catch(() => {});
      save.onclick = () => {
        download(content, format.type, name);
        // The dialog stays open, so that further formats can be saved.
        size.textContent = [SAVE_WORDS.saved(name), note].filter(Boolean).join(' ');
      };
    } catch (error) {
      if (job !== present) return;
      progress.end();
      const reason = plainMessage(error);
      size.textContent = reason && SAVE_WORDS.unwritten(reason);
    }
  };
  dialog.onclose = () => {
    cancelWriting();
    save.onclick = null;
    element('save-extra', HTMLElement).replaceChildren();
    closed();
  };
  const opened = performance.now();
  // The second click of a double click that opened the dialog neither closes it nor selects anything in it.
  const isSecondClick = () => performance.now() - opened < DOUBLE_CLICK_MS;
  dialog.onmousedown = (event) => {
    if (isSecondClick()) event.preventDefault();
  };
  // A click outside of the dialog closes it.
  dialog.onclick = (event) => {
    if (event.target === dialog && !isSecondClick()) dialog.close();
  };
  retryButton.onclick = () => void write();
  if (!dialog.open) dialog.showModal();
  void write();
  return { renew: () => void write() };
}
