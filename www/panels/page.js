/** The part of the page that makes photos of pages flat: opens photos and examples, and holds the panels of a photo. */
import { element } from '../dom.js';
import { choiceOf } from '../fields.js';
import { History } from '../history.js';
import { Book, isSameBook } from '../page/book.js';
import { BOOK_WORDS } from '../page/messages.js';
import { openPhoto, preparePhoto } from '../page/photo.js';
import { PageSession } from '../page/session.js';
import { readPicture } from '../pixels.js';
import { errorMessage } from '../messages.js';
import { hideNotice, showNotice } from './notice.js';
import { pageBookPanel } from './page-book.js';
import { pageKnownPanel } from './page-known.js';
import { pagePhotoPanel } from './page-photo.js';
import { pageResultPanel } from './page-result.js';

/** @import {BookPhoto} from '../page/book.js' */

/** Example photos, whose focal length for 35 mm film is that of their camera. @type {Record<string, { label: string, address: URL, pages: number }>} */
const EXAMPLES = {
  curled: { label: 'Curled page', address: new URL('../doors/curled-page.webp', import.meta.url), pages: 1 },
  book: { label: 'Open book', address: new URL('../doors/open-book.webp', import.meta.url), pages: 2 },
};
const EXAMPLE_FILM35 = 31.1;

/**
 * @param {Session} opener opens files, one at a time
 * @param {(photos: readonly BookPhoto[], shown: number) => void} onOpened called when photos were opened, shown, added, moved or removed; none for an example
 * @param {(states: (PageState | null)[], shown: number) => void} onChanged called when outlines of the photos have changed
 */
export function pagePanel(opener, onOpened, onChanged) {
  const { api } = opener;
  /** Created with the first photo. @type {PageSession | null} */
  let session = null;
  const book = new Book();
  /** Number of the newest photo that was asked for. */
  let newest = 0;
  /** The photo that was opened last, whose changes are stored. @type {PagePhoto | null} */
  let opened = null;

  const ensureSession = () => {
    if (session) return session;
    const created = (session = new PageSession(api));
    created.on('changed', () => {
      note();
      if (created.photo === opened) onChanged(book.photos.map(({ state }) => state), book.index);
    });
    pagePhotoPanel(created, history);
    pageKnownPanel(created, book);
    pageResultPanel(api, created, book, list.renew);
    return created;
  };

  /**
   * Opens a photo in the place of the last one.
   * @param {string} doing what could not be done, for the message if it fails
   * @param {Task} task
   * @param {(signal: AbortSignal) => Promise<PagePhoto | null>} load null if that has failed
   * @param {number} [pages]
   * @param {PageState | null} [state] edits of the photo, when it was open before
   * @returns {Promise<boolean | null>} whether it is shown; null if another photo is asked for by now
   */
  const show = async (doing, task, load, pages, state) => {
    const own = ++newest;
    const pageSession = ensureSession();
    pageSession.setOpening(true);
    const photo = await opener.whileOpening(doing, task, load);
    if (own !== newest) return null;
    if (photo) hideNotice();
    if (photo) pageSession.show(photo, pages, state);
    else pageSession.setOpening(false);
    return photo !== null;
  };
  /** Puts back the photos from before, since none has taken their place. @param {typeof book.snapshot} earlier */
  const giveUp = (earlier) => {
    Object.assign(book, earlier);
    list.renew();
    return null;
  };

  /** Opens a photo of the book by its index. @param {number} at @param {string[]} [problems] gets why it cannot be opened, which is shown otherwise */
  const openAt = async (at, problems) => {
    if (!session?.photo?.file) history.clear();
    const { file, state } = book.photos[at];
    const doing = `“${file.name}” could not be opened`;
    const isShown = await show(doing, 'reading', (signal) => openPhoto(api, file, signal).catch((error) => {
      if (!problems || signal.aborted) throw error;
      problems.push(errorMessage(doing, error));
      return null;
    }), undefined, state);
    if (!isShown) return isShown;
    examples.set('');
    book.index = at;
    note();
    list.renew();
    onOpened(book.photos, at);
    opened = session?.photo ?? null;
    return true;
  };
  /** @type {History<import('../page/book.js').BookState>} */
  const history = new History(element('page-side', HTMLElement), ({ photos, index, shown }) => {
    book.photos = photos.map((photo) => ({ ...photo }));
    if (photos.length > 0) onOpened(book.photos, index);
    if (session?.photo?.file !== photos[index]?.file) return void openAt(index);
    book.index = index;
    list.renew();
    session?.restore(shown);
  }, isSameBook);
  const note = () => {
    if (!session) return;
    book.saveState(session);
    history.note({ ...book.snapshot, shown: session.state() });
  };
  const list = pageBookPanel(book, (at) => void openAt(at), async () => {
    note();
    const { file } = book.remove(book.index);
    // Before the next photo is read: it is gone after a reload, too.
    onOpened(book.photos, book.index);
    await openAt(book.index);
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
    const before = book.photos.length;
    const opened = book.addFiles(files).map((at) => book.photos[at]);
    const added = book.photos.length - before;
    list.renew();
    /** @type {string[]} */
    const problems = [];
    let isShown = false;
    for (const photo of opened) {
      const known = problems.length;
      const isOpened = await openAt(book.photos.indexOf(photo), problems);
      isShown = isOpened === true;
      if (isShown) break;
      // Another photo was chosen meanwhile, or it was cancelled.
      if (problems.length === known) return isOpened === null ? null : giveUp(earlier);
      book.remove(book.photos.indexOf(photo));
      list.renew();
    }
    const words = problems.join(' ');
    if (!isShown) {
      showNotice(words, 'note');
      return giveUp(earlier);
    }
    const isAdded = before > 0 && added > problems.length;
    if (isAdded && added === 1) {
      showNotice(BOOK_WORDS.added(1, book.photos.length), 'note', { label: BOOK_WORDS.alone, act: () => void openAll(files, true) });
      return '';
    }
    return [isAdded ? BOOK_WORDS.added(added - problems.length, book.photos.length) : '', words].filter(Boolean).join(' ');
  };
  const openExample = async () => {
    const earlier = book.snapshot;
    book.setFiles([]);
    history.clear();
    list.renew();
    const name = examples.value || 'curled';
    const { address, pages } = EXAMPLES[name];
    const isShown = await show('The example could not be made', 'making', async (signal) => {
      const { width, height, data } = await readPicture(new File([await (await fetch(address, { signal })).blob()], name));
      return preparePhoto(api, { width, height, data, film35: EXAMPLE_FILM35 }, name, signal);
    }, pages);
    if (isShown) onOpened([], 0);
    else if (isShown === false) giveUp(earlier);
    return isShown;
  };
  const examples = choiceOf('page-example', Object.fromEntries(Object.entries(EXAMPLES).map(([name, { label }]) => [name, label])), openExample);
  const isOccupied = () => session !== null && (session.photo !== null || session.isOpening);
  return {
    openAll,
    /** Whether a photo or an example is shown. */
    hasPhoto: () => session !== null && session.photo !== null,
    /** Opens photos that this browser has kept, with their outlines. @param {readonly File[]} files @param {readonly (PageState | null)[]} states @param {number} [shown] index of the one that is shown */
    async openStored(files, states, shown = 0) {
      const earlier = book.snapshot;
      history.clear();
      book.setFiles(files, states);
      list.renew();
      const isShown = await openAt(shown);
      return isShown === false ? giveUp(earlier) : isShown;
    },
    /** Opens an example if no photo was opened yet. */
    begin: () => {
      if (!isOccupied()) void openExample();
    },
    /** Opens an example, unless it is the one that is open. */
    showExample: async () => {
      const isThere = examples.value !== '' && isOccupied();
      if (isThere) onOpened([], 0);
      else examples.set('curled');
      return isThere || openExample();
    },
  };
}
