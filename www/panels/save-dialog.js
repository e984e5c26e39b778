/** One dialog for whatever is saved: formats to choose from, how large the file will be, and then the file. */
import { download, element, make } from '../dom.js';
import { fileSize } from '../format.js';
import { plainly } from '../plain.js';

/**
 * @typedef {object} Format
 * @property {string} value the ending of the file's name
 * @property {string} name
 * @property {string} words what it is for
 * @property {string} type
 * @property {string} [without] why it cannot be had now
 * @property {() => Promise<Uint8Array<ArrayBuffer> | string>} write
 *
 * @typedef {object} Offer
 * @property {string} title
 * @property {string} stem of the file's name
 * @property {readonly Format[]} formats
 * @property {readonly Node[]} [extra] above the formats
 * @property {() => void} [closed] when nothing of it is wanted any more
 */

/** Counts what is written, to tell the newest. */
let turn = 0;
/** The format that was taken last, by the dialog's title. @type {Map<string, string>} */
const taken = new Map();

/**
 * @param {Offer} offer
 * @returns {{ renew: () => void }} to be called when what is offered has changed
 */
export function offerToSave({ title, stem, formats, extra = [], closed = () => {} }) {
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

  const write = async () => {
    const mine = ++turn;
    const value = list.querySelector('input:checked')?.getAttribute('value');
    const format = formats.find((one) => one.value === value);
    save.disabled = true;
    if (!format) return;
    taken.set(title, format.value);
    size.textContent = 'Working it out…';
    try {
      const content = await format.write();
      if (mine !== turn) return;
      size.textContent = `${stem}.${format.value}, ${fileSize(new Blob([content]).size)}`;
      save.disabled = false;
      save.onclick = () => {
        download(content, format.type, `${stem}.${format.value}`);
        dialog.close();
      };
    } catch (error) {
      if (mine !== turn) return;
      const reason = plainly(error instanceof Error ? error.message : String(error));
      size.textContent = `It could not be written: ${reason}.`;
    }
  };
  dialog.onclose = () => {
    turn++;
    save.onclick = null;
    element('save-extra', HTMLElement).replaceChildren();
    closed();
  };
  // Beside it is as good as its cross.
  dialog.onclick = (event) => {
    if (event.target === dialog) dialog.close();
  };
  if (!dialog.open) dialog.showModal();
  void write();
  return { renew: () => void write() };
}
