/** Keeps the page's address up to date with its state, for links, the history and reloads; and lists recent files. */
import { addressOf, isStart, stateOf } from '../address.js';
import { isExampleModel } from '../doors/example-model.js';
import { closeDialogs, copyText, element, elements, makeButton, SETTLING_MS } from '../dom.js';
import { fileOfLink, linkedFile } from '../linked-file.js';
import { ADDRESS_WORDS } from '../messages.js';
import { recentFiles, storedFiles, storedOutlines, storeFiles, storeOutlines } from '../recent-files.js';
import { hideNotice, showNotice } from './notice.js';

/** @import {State} from '../address.js' */
/** @import {Mode} from './mode.js' */
/** @import {BookPhoto} from '../page/book.js' */
/** @import {StoredHeights} from '../import-interpretation.js' */

/**
 * @param {Session} session
 * @param {object} page
 * @param {(settings: Settings) => void} page.adopt
 * @param {Stage} page.stage
 * @param {(name: string, options: { size: number, noise: number }) => Promise<void>} page.openExample
 * @param {(files: File[]) => Promise<unknown>} page.openFiles
 * @param {(files: File[]) => unknown} page.openHeights opens recent files that are no photos of pages
 * @param {(change: Partial<StoredHeights>) => void} page.reinterpretFile
 * @param {{ find: (id: string) => Card | undefined, show: (card: Card, settings?: Partial<Settings>, view?: string) => Promise<void>, present: Card | null }} page.gallery
 * @param {{ readonly now: Mode, show: (mode: Mode) => void }} page.mode
 * @param {(files: readonly File[], states: readonly (PageState | null)[], shown?: number) => Promise<unknown>} page.openPhotos opens photos of pages that were stored
 * @param {() => boolean} page.hasPhoto whether a photo of a page is shown
 * @param {() => void} page.beginPhoto shows an example if no photo of a page is open
 * @param {() => unknown} page.showExamplePhoto shows an example in the place of the photo of a page that is open
 * @param {MeshFit} page.meshFit
 * @param {{ readonly isShown: boolean, enter: (view: string) => void, leave: () => void }} page.meshFitView
 */
export function addressSyncPanel(session, page) {
  const view = () => page.stage.view;
  /** Id of the open file in the storage of recent files. @type {number | undefined} */
  let fileId;
  /** The files of the input. @type {readonly File[]} */
  let opened = [];
  let writeTimer = 0;
  /** Number of the newest address that is shown; what older ones still wait for is given up. */
  let newestRestore = 0;
  /** Whether the state of an address is being shown; the address is not written meanwhile. */
  let isRestoring = false;
  /** Whether the present input has not been solved yet. */
  let isNewInput = false;
  /** Whether the open file could not be stored. */
  let isUnstored = false;
  /** Whether the open file is being stored: it has no address until then. */
  let isStoring = false;
  /** Id of the open photos of pages in the storage of recent files. @type {number | undefined} */
  let photoId;
  /** The same, once they are stored. @type {Promise<number | undefined>} */
  let photosStored = Promise.resolve(undefined);
  /** The open photos of pages, in their order. @type {readonly File[]} */
  let photos = [];
  /** Kind and name of the last input. */
  let last = '';
  /** Which input has the settings of the address that was shown last, until that input is there. @type {'any' | 'file' | null} */
  let expected = null;
  /** The present address without its view. */
  let addressWithoutView = '';

  /** The present state. @returns {State} */
  const presentState = () => {
    const { input, settings } = session;
    if (page.mode.now === 'home') return { settings: {} };
    if (page.mode.now === 'photo') return { photo: true, file: photoId, unkept: isUnstored || undefined, settings: {} };
    const card = page.gallery.present;
    if (card) {
      const cardSettings = { ...session.defaults, ...card.settings };
      const changed = Object.entries(settings).filter(([name, value]) => value !== cardSettings[/** @type {keyof Settings} */ (name)]);
      return { card: card.id, settings: Object.fromEntries(changed), view: view() === card.view ? undefined : view() };
    }
    if (input?.kind !== undefined) {
      const { pixelSize, heightScale, noData } = input.stored ?? {};
      return { file: fileId, unkept: (fileId === undefined && isUnstored) || undefined, stored: input.stored && { pixelSize, heightScale, noData }, settings, whole: page.meshFitView.isShown || undefined, view: view() };
    }
    const [size, noise] = ['size', 'noise'].map((name) => Number(element(name, HTMLSelectElement).value));
    return { example: { name: input?.name ?? 'roof', size, noise }, settings, view: view() };
  };

  /** Writes the state to the address: as a new entry of the history if more than the view differs. */
  const writeAddress = () => {
    if (isRestoring || !{ home: false, heights: session.input !== null && !isStoring, photo: page.hasPhoto() }[page.mode.now]) return;
    const state = presentState();
    const address = addressOf(state, session.defaults);
    const withoutView = addressOf({ ...state, view: undefined }, session.defaults);
    const isOther = withoutView !== addressWithoutView;
    addressWithoutView = withoutView;
    if (address === location.hash) return;
    if (isOther) history.pushState(null, '', address);
    else history.replaceState(null, '', address);
  };
  const writeSoon = () => {
    clearTimeout(writeTimer);
    writeTimer = window.setTimeout(writeAddress, SETTLING_MS);
  };
  session.on('cleared', () => (isNewInput = true));
  // A file gets its address when it has been stored, anything else when its first run begins, so that Back can be used meanwhile.
  session.on('start', () => {
    if (isNewInput && session.input?.kind === undefined) writeAddress();
    isNewInput = false;
  });
  session.on('result', writeSoon);
  page.meshFit.on('result', writeSoon);
  page.meshFit.on('left', writeSoon);
  session.on('input', ({ name, kind }) => {
    // Each file has a λ of its own, unless an address brings it.
    const isExpected = expected === 'any' || (expected === 'file' && kind !== undefined);
    if (kind !== undefined && `${kind} ${name}` !== last && !isExpected && session.settings.lambda !== 'auto') page.adopt({ ...session.settings, lambda: 'auto' });
    if (isExpected) expected = null;
    last = `${kind} ${name}`;
    if (kind !== undefined || opened.length === 0) return;
    [opened, fileId, isStoring] = [[], undefined, false];
    void updateRecentFiles();
  });
  // A change of the view gets no entry of its own in the history.
  for (const name of ['choice', 'others']) element(`view-${name}`, HTMLElement).addEventListener('change', writeAddress);

  /** Opens stored photos of pages. @param {number} id @returns {Promise<boolean>} whether they were stored */
  const openStoredPhotos = async (id) => {
    const files = await storedFiles(id);
    if (!files) return false;
    [photoId, photos, photosStored] = [id, files, Promise.resolve(id)];
    const { states, shown } = await storedOutlines(id);
    // What was cancelled is not open.
    if (!(await page.openPhotos(files, states, shown))) [photoId, photosStored] = [undefined, Promise.resolve(undefined)];
    return true;
  };

  /** Shows the first screen, since the file of an address is no longer stored. */
  const showLost = (words = ADDRESS_WORDS.lost) => {
    page.mode.show('home');
    showNotice(words);
  };

  /** Shows the state of an address. @param {State} state */
  const restoreState = async (state) => {
    const own = ++newestRestore;
    closeDialogs();
    hideNotice();
    isRestoring = true;
    expected = null;
    clearTimeout(writeTimer);
    try {
      if (isStart(location.hash)) {
        page.mode.show('home');
        return void updateRecentFiles();
      }
      if (state.photo) {
        page.mode.show('photo');
        if (state.file === undefined && !state.unkept) return page.showExamplePhoto();
        if (state.file !== undefined && state.file !== photoId && !(await openStoredPhotos(state.file))) return showLost();
        if (state.unkept) showNotice(ADDRESS_WORDS.unkept);
        page.beginPhoto();
        return;
      }
      page.mode.show('heights');
      const previous = presentState();
      const settings = { ...session.defaults, ...state.settings };
      const card = state.card ? page.gallery.find(state.card) : undefined;
      // An address without an input is that of a file of the user's, which is opened by hand.
      expected = state.file !== undefined || state.linked || state.example || card ? 'any' : 'file';
      if (card && page.gallery.present !== card) return await page.gallery.show(card, { ...card.settings, ...state.settings }, state.view);
      const isSameInput = session.input !== null && !state.linked && (card !== undefined || (state.file !== undefined ? state.file === fileId : JSON.stringify(state.example) === JSON.stringify(previous.example)));
      const wanted = card ? { ...session.defaults, ...card.settings, ...state.settings } : settings;
      const linked = state.linked && await fileOfLink(state.linked).catch(() => showLost(ADDRESS_WORDS.brokenLink));
      if (state.linked && !linked) return;
      const files = linked ? [linked] : isSameInput || state.file === undefined ? undefined : await storedFiles(state.file);
      if (own !== newestRestore) return;
      if (isSameInput) expected = null;
      if (!isSameInput && state.file !== undefined && !files) return showLost();
      // The input is solved only if it or the settings have changed.
      if (!isSameInput || Object.entries(wanted).some(([name, value]) => session.settings[/** @type {keyof Settings} */ (name)] !== value)) page.adopt(wanted);
      if (files) {
        await page.openFiles(files);
        if (session.input === null) return page.mode.show('home');
      } else if (!isSameInput && state.example) {
        await page.openExample(state.example.name, state.example);
      }
      if (own !== newestRestore) return;
      if (state.stored && session.input?.stored) {
        const { stored } = session.input;
        const isReinterpreted = Object.entries(state.stored).some(([name, value]) => stored[/** @type {'noData'} */ (name)] !== value);
        if (isReinterpreted) await page.reinterpretFile(state.stored);
      }
      if (state.whole) return page.meshFitView.enter(state.view ?? 'shaded');
      page.meshFitView.leave();
      page.stage.choose(state.view ?? 'shaded');
    } finally {
      if (own === newestRestore) isRestoring = false;
      if (session.input && !isRestoring) addressWithoutView = addressOf({ ...presentState(), view: undefined }, session.defaults);
    }
  };
  addEventListener('popstate', () => void restoreState(stateOf(location.hash)));

  const lists = elements('.recent', HTMLElement);
  const updateRecentFiles = async () => {
    const all = await recentFiles();
    // Neither the open file nor an example is listed.
    const openId = { home: undefined, photo: photoId, heights: fileId }[page.mode.now];
    const closed = all.filter(({ id, files }) => id !== openId && !files.some(isExampleModel));
    for (const list of lists) {
      list.hidden = closed.length === 0;
      list.replaceChildren('Opened before: ', ...closed.map(({ id, files, arePhotos }) => makeButton('plain small', () => {
        if (!arePhotos) return page.openHeights(files);
        page.mode.show('photo');
        return openStoredPhotos(id);
      }, files.map(({ name }) => name).join(', '))));
    }
  };
  void updateRecentFiles();

  const button = element('share', HTMLButtonElement);
  button.addEventListener('click', async () => {
    writeAddress();
    const state = presentState();
    // The id of a file has no meaning on another machine.
    const linked = session.input?.kind !== undefined && page.mode.now === 'heights' && opened.length === 1 ? await linkedFile(opened[0]) : undefined;
    const address = new URL(addressOf({ ...state, file: undefined, linked, stored: linked && state.stored }, session.defaults), location.href).href;
    await copyText(button, address, state.example || state.card ? undefined : linked ? ADDRESS_WORDS.withFile : ADDRESS_WORDS.withoutFile).catch(() => showNotice(address, 'note'));
  });

  return {
    /** Whether the next input has the settings of an address. */
    get expectsInput() {
      return expected !== null;
    },
    /** Shows the state of the address, or an example where that has no input. */
    async begin() {
      const state = stateOf(location.hash);
      await restoreState(state);
      if (session.input !== null || page.mode.now !== 'heights') return session.wait();
      await page.openExample('roof', { size: 400, noise: 0.02 });
      if (state.unkept) showNotice(ADDRESS_WORDS.unkept);
    },
    /** Stores files that were opened. @param {readonly File[]} files */
    async rememberFiles(files) {
      [opened, fileId, isStoring] = [files, undefined, true];
      const id = await storeFiles(files);
      // By now others may be open.
      if (opened !== files) return;
      [fileId, isStoring, isUnstored] = [id, false, id === undefined];
      void updateRecentFiles();
      writeAddress();
    },
    /** Stores the photos of pages that are open, with their outlines. @param {readonly BookPhoto[]} opened none for an example @param {number} shown index of the one that is shown */
    async rememberPhotos(opened, shown) {
      const before = photos;
      const mine = (photos = opened.map(({ file }) => file));
      // Photos that are added, moved or removed change the entry of those that were open.
      const isKept = photos.some((file) => before.includes(file));
      const isSame = mine.length === before.length && mine.every((file, i) => file === before[i]);
      // One after the other, so that the last one stays.
      if (!isSame) photosStored = photosStored.then((last) => (mine.length > 0 ? storeFiles(mine, { arePhotos: true, id: isKept ? last : undefined }) : undefined));
      const stored = await photosStored;
      if (photos !== mine) return;
      [photoId, isUnstored] = [stored, mine.length > 0 && stored === undefined];
      void this.rememberOutlines(opened.map(({ state }) => state), shown);
      void updateRecentFiles();
      writeAddress();
    },
    /** Stores the outlines of the photos of pages that are open. @param {(PageState | null)[]} states @param {number} shown */
    async rememberOutlines(states, shown) {
      const id = await photosStored;
      if (id !== undefined) await storeOutlines({ id, states, shown });
    },
  };
}
