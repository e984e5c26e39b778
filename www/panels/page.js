/** The part of the page that makes photos of pages flat: opens photos and examples, and holds the panels of a photo. */
import { fileReadTask } from '../worker-task.js';
import { onFilesChosen, element, elements } from '../dom.js';
import { Book } from '../page/book.js';
import { examplePhoto } from '../page/example.js';
import { isTooLarge, openPhoto, preparePhoto } from '../page/photo.js';
import { PageSession } from '../page/session.js';
import { isGrey16Png } from '../dropped-files.js';
import { kindByName, unreadableKindInWords } from '../file-kinds.js';
import { FILE_WORDS } from '../messages.js';
import { hideNotice, showError, showNotice } from './notice.js';
import { pageBookPanel } from './page-book.js';
import { pageKnownPanel } from './page-known.js';
import { pagePhotoPanel } from './page-photo.js';
import { pageResultPanel } from './page-result.js';
import { PROGRESS_DELAY_MS, waitingPanel } from './waiting.js';

/** @import {Api} from '../api.js' */
/** @import {ExampleName} from '../page/example.js' */
/** @import {PagePhoto} from '../page/photo.js' */
/** @import {DewarpedPage} from '../page/flatten.js' */
/** @import {PageState} from '../page/session.js' */
/** @import {TimedTask} from '../session.js' */

/**
 * @param {Api} api
 * @param {(flat: DewarpedPage, name: string) => void} openAsSurface opens the page as a surface
 * @param {(files: File[]) => void} openHeights opens files that are not photos of pages
 * @param {(file: File | null) => void} onOpened called when a photo was opened; null for an example
 */
export function pagePanel(api, openAsSurface, openHeights, onOpened) {
  /** Created with the first photo. @type {PageSession | null} */
  let session = null;
  const examples = elements('input[name="page-example"]', HTMLInputElement);
  const book = new Book();
  /** Aborts the photo that is being opened; null before the first one. @type {AbortController | null} */
  let opening = null;
  const waiting = waitingPanel(element('page-opening', HTMLElement), () => {
    opening?.abort();
    waiting.end();
  }, PROGRESS_DELAY_MS);

  const ensureSession = () => {
    if (session) return session;
    const created = (session = new PageSession(api));
    pagePhotoPanel(created);
    pageKnownPanel(created);
    pageResultPanel(api, created, book, openAsSurface);
    return created;
  };

  /**
   * Opens a photo in the place of the last one.
   * @param {string} doing what could not be done, for the message if it fails
   * @param {(signal: AbortSignal) => Promise<PagePhoto>} load
   * @param {number} [pages]
   * @param {TimedTask} [task] for the progress bar
   * @param {File} [file] file of the photo; it may be opened at half size if it is too large
   * @param {PageState | null} [state] edits of the photo, when it was open before
   * @returns {Promise<AbortSignal>} aborted if another photo was opened meanwhile
   */
  const show = async (doing, load, pages, task, file, state) => {
    opening?.abort();
    const { signal } = (opening = new AbortController());
    const pageSession = ensureSession();
    waiting.end();
    if (task) waiting.begin(task);
    try {
      const photo = await load(signal);
      if (signal.aborted) return signal;
      hideNotice();
      pageSession.show(photo, pages, state);
      onOpened(file ?? null);
    } catch (error) {
      if (signal.aborted) return signal;
      if (file && isTooLarge(error)) showNotice(FILE_WORDS.tooLarge(file.name), 'alert', { label: FILE_WORDS.openAtHalf, act: () => void open(file, true) });
      else showError(doing, error);
    } finally {
      if (!signal.aborted) waiting.end(task);
    }
    return signal;
  };

  /** @param {File} file @param {boolean} [half] at half size */
  const open = async (file, half) => {
    book.setFiles([file]);
    list.renew();
    await openOne(file, half);
  };
  /** @param {File} file @param {boolean} [half] at half size @param {PageState | null} [state] edits of the photo, when it was open before */
  const openOne = async (file, half, state) => {
    const kind = kindByName(file);
    if (kind === 'other' || kind === 'camera') return showNotice(FILE_WORDS.unread(file.name, unreadableKindInWords(file)));
    if (kind === 'mesh' || kind === 'heights') {
      const words = kind === 'mesh' ? FILE_WORDS.meshNoPhoto(file.name) : FILE_WORDS.heightsNoPhoto(file.name);
      return showNotice(words, 'alert', { label: FILE_WORDS.openAsHeights, act: () => openHeights([file]) });
    }
    let isProbablyDepth = false;
    const signal = await show(`“${file.name}” could not be opened`, async (signal) => {
      const photo = await openPhoto(api, file, signal, half);
      for (const radio of examples) radio.checked = radio.checked && signal.aborted;
      isProbablyDepth = photo.outlines.verdict === 'notFound' && await isGrey16Png(file);
      return photo;
    }, 1, fileReadTask(file), file, state);
    if (isProbablyDepth && !signal.aborted) showNotice(FILE_WORDS.maybeHeights(file.name), 'alert', { label: FILE_WORDS.openAsHeights, act: () => openHeights([file]) });
  };
  /** Opens a photo of the book by its index. @param {number} at */
  const showPhoto = async (at) => {
    if (session) book.saveState(session);
    book.index = at;
    list.renew();
    const { file, state } = book.photos[at];
    await openOne(file, false, state);
  };
  const list = pageBookPanel(book, showPhoto, () => {
    book.remove();
    list.renew();
    const { file, state } = book.photos[book.index];
    void openOne(file, false, state);
  });
  /** Opens one photo, or several that become one PDF. @param {readonly File[]} files */
  const openAll = async (files) => {
    book.setFiles(files);
    list.renew();
    await openOne(files[0]);
  };
  const openExample = async () => {
    book.setFiles([]);
    list.renew();
    const name = /** @type {ExampleName} */ (examples.find((radio) => radio.checked)?.value ?? 'curled');
    const { image, film35, pages } = examplePhoto(name);
    const pixels = { width: image.width, height: image.height, data: image.data, film35 };
    await show('The example could not be made', (signal) => preparePhoto(api, pixels, name, signal), pages);
  };
  for (const radio of examples) radio.addEventListener('change', openExample);
  onFilesChosen(element('page-open', HTMLButtonElement), element('page-file', HTMLInputElement), openAll);
  return {
    open,
    openAll,
    /** Opens an example if no photo was opened yet. */
    begin: () => {
      if (!opening) void openExample();
    },
  };
}
