/** What is shown stands in the address: shared by a link, undone by going back, there again after a reload. */
import { addressOf, stateOf } from '../address.js';
import { element, elements, make } from '../dom.js';
import { ADDRESS_WORDS } from '../messages.js';
import { keepFiles, keptFiles, namesOf, recentFiles } from '../recent-files.js';
import { showNotice } from './notice.js';

/** @import {State} from '../address.js' */
/** @import {Mode} from './mode.js' */
/** @import {Card} from '../gallery/cards.js' */
/** @import {Session, Settings} from '../session.js' */
/** @import {Stored} from '../import-interpretation.js' */
/** @import {Whole} from '../mesh-fit.js' */

/** How long a result stands, in milliseconds, before it is worth going back to. */
const REST = 400;

/**
 * @param {Session} session
 * @param {object} page
 * @param {(settings: Settings) => void} page.adopt
 * @param {(view: string) => void} page.choose
 * @param {(name: string, options: { size: number, noise: number }) => Promise<void>} page.openExample
 * @param {(files: File[]) => Promise<unknown>} page.openFiles
 * @param {(files: File[]) => unknown} page.openRecent likewise, or as a photo of a page
 * @param {(change: Partial<Stored>) => void} page.understand
 * @param {{ find: (id: string) => Card | undefined, show: (card: Card, settings?: Partial<Settings>, view?: string) => Promise<void>, present: Card | null }} page.gallery
 * @param {{ readonly now: Mode, show: (mode: Mode) => void }} page.mode
 * @param {(file: File) => Promise<unknown>} page.openPhoto of a page
 * @param {() => void} page.beginPhoto shows an example, where no photo is open
 * @param {Whole} page.whole a mesh solved whole, and how that is shown
 * @param {{ readonly view?: string, enter: (view: string) => void, leave: () => void }} page.solvedWhole
 */
export function keepPanel(session, page) {
  const views = elements('input[name="view"]', HTMLInputElement);
  const view = () => views.find((radio) => radio.checked)?.value ?? 'shaded';
  /** The number of the open file, where it is kept. @type {number | undefined} */
  let file;
  let rest = 0;
  /** What is shown is being taken from an address. */
  let taking = false;
  /** The file that is open could not be kept. */
  let unkept = false;
  /** The photo of a page that is open, by its number where it is kept. @type {number | undefined} */
  let photo;
  /** What the address in the history is about, without its view. */
  let subject = '';

  /** @returns {State} */
  const present = () => {
    const { input, settings } = session;
    if (page.mode.now === 'photo') return { photo: true, file: photo, unkept: unkept || undefined, settings: {} };
    const card = page.gallery.present;
    if (card) {
      const own = { ...session.defaults, ...card.settings };
      const changed = Object.entries(settings).filter(([name, value]) => value !== own[/** @type {keyof Settings} */ (name)]);
      return { card: card.id, settings: Object.fromEntries(changed), view: view() === card.view ? undefined : view() };
    }
    if (input?.kind !== undefined) {
      const { pixelSize, heightScale, zeros, hexagonal } = input.stored ?? {};
      const { view: wholly } = page.solvedWhole;
      const whole = wholly === undefined ? undefined : true;
      return { file, unkept: (file === undefined && unkept) || undefined, stored: input.stored && { pixelSize, heightScale, zeros, hexagonal }, settings, whole, view: wholly ?? view() };
    }
    const [size, noise] = ['size', 'noise'].map((name) => Number(element(name, HTMLSelectElement).value));
    return { example: { name: input?.name ?? 'roof', size, noise }, settings, view: view() };
  };

  const write = (push = true) => {
    if (taking || !session.input) return;
    const state = present();
    const address = addressOf(state, session.defaults);
    const now = addressOf({ ...state, view: undefined }, session.defaults);
    // A view that is chosen before its input stands in the address does not take the place of the input before.
    const other = now !== subject;
    subject = now;
    if (address === location.hash) return;
    if ((push || other) && location.hash !== '') history.pushState(null, '', address);
    else history.replaceState(null, '', address);
  };
  const writeSoon = () => {
    clearTimeout(rest);
    rest = window.setTimeout(write, REST);
  };
  session.on('result', writeSoon);
  page.whole.on('result', writeSoon);
  page.whole.on('left', writeSoon);
  session.on('input', ({ kind }) => {
    if (kind !== undefined || file === undefined) return;
    file = undefined;
    void tell();
  });
  // Another look is nothing to undo.
  for (const radio of [...views, ...elements('input[name="whole-view"]', HTMLInputElement)]) {
    radio.addEventListener('change', () => write(false));
  }

  /** Shows what an address says. @param {State} state */
  const take = async (state) => {
    taking = true;
    clearTimeout(rest);
    try {
      if (state.photo) {
        page.mode.show('photo');
        const files = state.file === undefined || state.file === photo ? undefined : await keptFiles(state.file);
        if (files) await page.openPhoto(files[0]);
        else if (state.file !== undefined && state.file !== photo) showNotice(ADDRESS_WORDS.lost);
        else if (state.unkept) showNotice(ADDRESS_WORDS.unkept);
        if (!files) page.beginPhoto();
        return;
      }
      page.mode.show('heights');
      const before = present();
      const settings = { ...session.defaults, ...state.settings };
      const card = state.card ? page.gallery.find(state.card) : undefined;
      if (card && page.gallery.present !== card) return await page.gallery.show(card, { ...card.settings, ...state.settings }, state.view);
      const same = card !== undefined || (state.file !== undefined ? state.file === file : JSON.stringify(state.example) === JSON.stringify(before.example));
      const wanted = card ? { ...session.defaults, ...card.settings, ...state.settings } : settings;
      // What is as it was is not solved again.
      if (!same || Object.entries(wanted).some(([name, value]) => session.settings[/** @type {keyof Settings} */ (name)] !== value)) page.adopt(wanted);
      if (!same && state.file !== undefined) {
        const files = await keptFiles(state.file);
        if (files) await page.openFiles(files);
        else showNotice(ADDRESS_WORDS.lost);
      } else if (!same && state.example) {
        await page.openExample(state.example.name, state.example);
      }
      if (state.stored && session.input?.stored) {
        const { stored } = session.input;
        const other = Object.entries(state.stored).some(([name, value]) => stored[/** @type {'zeros'} */ (name)] !== value);
        if (other) page.understand(state.stored);
      }
      if (state.whole) return page.solvedWhole.enter(state.view ?? 'shaded');
      page.solvedWhole.leave();
      page.choose(state.view ?? 'shaded');
    } finally {
      taking = false;
      if (session.input) subject = addressOf({ ...present(), view: undefined }, session.defaults);
    }
  };
  addEventListener('popstate', () => void take(stateOf(location.hash)));

  const list = element('recent', HTMLElement);
  const tell = async () => {
    const all = await recentFiles();
    // What is open now was not opened before.
    const open = page.mode.now === 'photo' ? photo : file;
    const kept = all.filter(({ id }) => id !== open);
    list.hidden = kept.length === 0;
    list.replaceChildren('Opened before: ', ...kept.map(({ files }) => {
      const button = make('button', 'plain small', namesOf(files));
      button.type = 'button';
      button.addEventListener('click', () => void page.openRecent(files));
      return button;
    }));
  };
  void tell();

  const share = async () => {
    write(false);
    const state = present();
    // A file stays on this machine: its number means nothing elsewhere.
    const address = new URL(addressOf({ ...state, file: undefined, stored: undefined }, session.defaults), location.href).href;
    const told = state.example || state.card ? '' : ' It holds the settings; the file stays on this machine.';
    try {
      await navigator.clipboard.writeText(address);
      showNotice(`The link is copied.${told}`, 'note');
    } catch {
      showNotice(`${address} – copy this link.${told}`, 'note');
    }
  };
  for (const id of ['share', 'whole-share']) element(id, HTMLButtonElement).addEventListener('click', share);

  return {
    /** Shows what the address asks for, or an example. */
    async begin() {
      const state = stateOf(location.hash);
      await take(state);
      if (session.input !== null) return;
      // Something to see at once.
      await page.openExample('roof', { size: 400, noise: 0.02 });
      if (state.photo) write(false);
      else if (state.file !== undefined) showNotice(ADDRESS_WORDS.lost);
      else if (state.unkept) showNotice(ADDRESS_WORDS.unkept);
    },
    /** Keeps what was opened. @param {readonly File[]} files */
    async remember(files) {
      file = await keepFiles(files);
      unkept = file === undefined;
      void tell();
      write();
    },
    /** The same of a photo of a page. @param {File | null} opened an example, if there is none */
    async rememberPhoto(opened) {
      const kept = opened ? await keepFiles([opened]) : undefined;
      [photo, unkept] = [kept, opened !== null && kept === undefined];
      void tell();
      write();
    },
    /** The other part of the page was entered. */
    entered() {
      write();
      void tell();
    },
  };
}
