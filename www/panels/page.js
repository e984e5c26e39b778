/** The part of the page that makes photos of pages flat: opens photos and examples, and holds the panels of a photo. */
import { element, SETTLING_MS } from '../dom.js';
import { choiceOf } from '../fields.js';
import { History } from '../history.js';
import { Book, isSameBook } from '../page/book.js';
import { BOOK_WORDS } from '../page/messages.js';
import { openPhoto, preparePhoto } from '../page/photo.js';
import { PageSession } from '../page/session.js';
import { readPicture } from '../pixels.js';
import { errorMessage } from '../messages.js';
import { hideNotice, showError, showNotice } from './notice.js';
import { pageBookPanel } from './page-book.js';
import { pageKnownPanel } from './page-known.js';
import { pagePhotoPanel } from './page-photo.js';
import { pageResultPanel } from './page-result.js';
import { PROGRESS_DELAY_MS, waitingPanel } from './waiting.js';

/** @import {BookPhoto} from '../page/book.js' */

/** Example photos, whose focal length for 35 mm film is that of their camera. @type {Record<string, { label: string, address: URL, pages: number }>} */
const EXAMPLES = {
  curled: { label: 'Curled page', address: new URL('../doors/curled-page.webp', import.meta.url), pages: 1 },
  book: { label: 'Open book', address: new URL('../doors/open-book.webp', import.meta.url), pages: 2 },
};
const EXAMPLE_FILM35 = 31.1;

/**
 * @param {Api} api
 * @param {(photos: readonly BookPhoto[], shown: number) => void} onOpened called when photos were opened, shown, added, moved or removed; none for an example
 * @param {(states: (PageState | null)[], shown: number) => void} onChanged called when outlines of the photos have changed
 */
export function pagePanel(api, onOpened, onChanged) {
  /** Created with the first photo. @type {PageSession | null} */
  let session = null;
  const book = new Book();
  /** Aborts the photo that is being opened; null before the first one. @type {AbortController | null} */
  let opening = null;
  const waiting = waitingPanel(element('page-opening', HTMLElement), () => {
    opening?.abort();
    session?.setOpening(false);
    waiting.end();
  }, PROGRESS_DELAY_MS);
  let storeTimer = 0;

  const ensureSession = () => {
    if (session) return session;
    const created = (session = new PageSession(api));
    created.on('changed', note);
    pagePhotoPanel(created, history);
    pageKnownPanel(created, book);
    pageResultPanel(api, created, book, list.renew);
    created.on('flat', ({ moving }) => {
      if (moving || !created.photo?.file) return;
      clearTimeout(storeTimer);
      storeTimer = window.setTimeout(() => onChanged(book.photos.map(({ state }) => state), book.index), SETTLING_MS);
    });
    return created;
  };

  /**
   * Opens a photo in the place of the last one.
   * @param {(signal: AbortSignal) => Promise<PagePhoto>} load
   * @param {{ pages?: number, task?: Task, state?: PageState | null }} [more] `state`: edits of the photo, when it was open before
   * @returns {Promise<boolean>} false if it was cancelled, or another photo was opened meanwhile
   * @throws if the photo cannot be opened
   */
  const show = async (load, { pages, task, state } = {}) => {
    opening?.abort();
    const { signal } = (opening = new AbortController());
    const pageSession = ensureSession();
    waiting.end();
    if (task) waiting.begin(task);
    pageSession.setOpening(true);
    try {
      const photo = await load(signal);
      if (signal.aborted) return false;
      hideNotice();
      pageSession.show(photo, pages, state);
      return true;
    } catch (error) {
      if (signal.aborted) return false;
      pageSession.setOpening(false);
      throw error;
    } finally {
      if (!signal.aborted) waiting.end();
    }
  };

  /** Opens a photo of the book by its index. @param {number} at @throws if it cannot be opened */
  const openAt = async (at) => {
    if (!session?.photo?.file) history.clear();
    const { file, state } = book.photos[at];
    if (!(await show((signal) => openPhoto(api, file, signal), { task: 'reading', state }))) return false;
    examples.set('');
    book.index = at;
    note();
    list.renew();
    onOpened(book.photos, at);
    return true;
  };
  /** @type {History<import('../page/book.js').BookState>} */
  const history = new History(element('page-side', HTMLElement), ({ photos, index, shown }) => {
    book.photos = photos.map((photo) => ({ ...photo }));
    if (session?.photo?.file !== photos[index]?.file) return void showPhoto(index);
    book.index = index;
    list.renew();
    session?.restore(shown);
    if (photos.length > 0) onOpened(book.photos, index);
  }, isSameBook);
  const note = () => {
    if (!session) return;
    book.saveState(session);
    history.note({ ...book.snapshot, shown: session.state() });
  };
  /** Opens a photo of the book that the user has chosen. @param {number} at */
  const showPhoto = (at) => openAt(at).catch((error) => showError(`“${book.photos[at].file.name}” could not be opened`, error));
  const list = pageBookPanel(book, showPhoto, async () => {
    note();
    const { file } = book.remove(book.index);
    await showPhoto(book.index);
    showNotice(BOOK_WORDS.removed(file.name), 'note', { label: BOOK_WORDS.undo, act: () => history.step() });
  }, () => {
    note();
    onOpened(book.photos, book.index);
  });

  /**
   * Opens photos, and adds them to those that are open.
   * @param {readonly File[]} files
   * @param {boolean} [alone] whether they replace those that are open
   * @returns {Promise<string | null>} a note about them; null if none was opened
   */
  const openAll = async (files, alone = false) => {
    const earlier = book.snapshot;
    if (alone) book.setFiles([]);
    /** Puts back the photos from before, since none has taken their place. */
    const giveUp = () => {
      Object.assign(book, earlier);
      list.renew();
      return null;
    };
    const before = book.photos.length;
    const opened = book.addFiles(files).map((at) => book.photos[at]);
    const added = book.photos.length - before;
    list.renew();
    /** @type {string[]} */
    const problems = [];
    let isShown = false;
    for (const photo of opened) {
      try {
        isShown = await openAt(book.photos.indexOf(photo));
        if (isShown) break;
        // Another photo was chosen meanwhile, or the user has cancelled.
        return opening?.signal.aborted ? giveUp() : null;
      } catch (error) {
        problems.push(errorMessage(`“${photo.file.name}” could not be opened`, error));
        book.remove(book.photos.indexOf(photo));
        list.renew();
      }
    }
    const words = problems.join(' ');
    if (!isShown) {
      showNotice(words, 'note');
      return giveUp();
    }
    const isAdded = before > 0 && added > problems.length;
    if (isAdded && added === 1) {
      showNotice(BOOK_WORDS.added(1, book.photos.length), 'note', { label: BOOK_WORDS.alone, act: () => void openAll(files, true) });
      return '';
    }
    return [isAdded ? BOOK_WORDS.added(added - problems.length, book.photos.length) : '', words].filter(Boolean).join(' ');
  };
  const openExample = async () => {
    book.setFiles([]);
    history.clear();
    list.renew();
    const name = examples.value || 'curled';
    const { address, pages } = EXAMPLES[name];
    try {
      const isShown = await show(async (signal) => {
        const { width, height, data } = await readPicture(new File([await (await fetch(address, { signal })).blob()], name));
        return preparePhoto(api, { width, height, data, film35: EXAMPLE_FILM35 }, name, signal);
      }, { pages });
      if (isShown) onOpened([], 0);
    } catch (error) {
      showError('The example could not be made', error);
    }
  };
  const examples = choiceOf('page-example', Object.fromEntries(Object.entries(EXAMPLES).map(([name, { label }]) => [name, label])), openExample);
  return {
    openAll,
    /** Whether a photo or an example is shown. */
    get hasPhoto() {
      return session !== null && session.photo !== null;
    },
    /** Opens photos that this browser has kept, with their outlines. @param {readonly File[]} files @param {readonly (PageState | null)[]} states @param {number} [shown] index of the one that is shown */
    async openStored(files, states, shown = 0) {
      history.clear();
      book.setFiles(files, states);
      list.renew();
      await showPhoto(shown);
    },
    /** Opens an example if no photo was opened yet. */
    begin: () => {
      if (!opening) void openExample();
    },
    /** Opens an example, unless it is the one that is open. */
    showExample: () => {
      if (examples.value && opening) return;
      examples.set('curled');
      void openExample();
    },
  };
}
