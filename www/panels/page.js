/** From a photo of a page alone to the flat page: opened or an example, its outline, what is known, what comes of it. */
import { readingOf } from '../worker-task.js';
import { choosesFiles, element, elements } from '../dom.js';
import { Book } from '../page/book.js';
import { examplePhoto } from '../page/example.js';
import { isTooLarge, openPhoto, photoOf } from '../page/photo.js';
import { PageSession } from '../page/session.js';
import { isGrey16 } from '../dropped-files.js';
import { kindByName, otherInWords } from '../file-kinds.js';
import { FILE_WORDS } from '../messages.js';
import { hideNotice, showFailure, showNotice } from './notice.js';
import { pageBookPanel } from './page-book.js';
import { pageKnownPanel } from './page-known.js';
import { pagePhotoPanel } from './page-photo.js';
import { pageResultPanel } from './page-result.js';
import { SOON, waitingPanel } from './waiting.js';

/** @import {Api} from '../api.js' */
/** @import {ExampleName} from '../page/example.js' */
/** @import {PagePhoto} from '../page/photo.js' */
/** @import {DewarpedPage} from '../page/flatten.js' */
/** @import {PageState} from '../page/session.js' */
/** @import {Slow} from '../session.js' */

/**
 * @param {Api} api
 * @param {(flat: DewarpedPage, name: string) => void} goOn with the page as a surface
 * @param {(files: File[]) => void} openHeights what is no photo of a page
 * @param {(file: File | null) => void} opened is open now; an example, if there is none
 */
export function pagePanel(api, goOn, openHeights, opened) {
  /** Made with the first photo, for most visitors come for something else. @type {PageSession | null} */
  let session = null;
  const examples = elements('input[name="page-example"]', HTMLInputElement);
  const book = new Book();
  /** What is being opened, or was opened last. @type {AbortController | null} */
  let opening = null;
  const waiting = waitingPanel(element('page-opening', HTMLElement), () => {
    opening?.abort();
    waiting.end();
  }, SOON);

  const begun = () => {
    if (session) return session;
    const made = (session = new PageSession(api));
    pagePhotoPanel(made);
    pageKnownPanel(made);
    pageResultPanel(api, made, book, goOn);
    return made;
  };

  /**
   * @param {string} doing
   * @param {(signal: AbortSignal) => Promise<PagePhoto>} load
   * @param {number} [pages]
   * @param {Slow} [slow] for what is said meanwhile
   * @param {File} [file] which may be opened at half size
   * @param {PageState | null} [state] what was done to it before
   * @returns {Promise<AbortSignal>} whether it was given up
   */
  const show = async (doing, load, pages, slow, file, state) => {
    opening?.abort();
    const { signal } = (opening = new AbortController());
    const to = begun();
    waiting.end();
    if (slow) waiting.begin(slow);
    try {
      const photo = await load(signal);
      if (signal.aborted) return signal;
      hideNotice();
      to.show(photo, pages, state);
      opened(file ?? null);
    } catch (error) {
      if (signal.aborted) return signal;
      if (file && isTooLarge(error)) showNotice(FILE_WORDS.tooLarge(file.name), 'alert', { label: FILE_WORDS.openAtHalf, act: () => void open(file, true) });
      else showFailure(doing, error);
    } finally {
      if (!signal.aborted) waiting.end(slow);
    }
    return signal;
  };

  /** @param {File} file @param {boolean} [half] at half size */
  const open = async (file, half) => {
    book.begin([file]);
    list.renew();
    await openOne(file, half);
  };
  /** @param {File} file @param {boolean} [half] at half size @param {PageState | null} [state] what was done to it before */
  const openOne = async (file, half, state) => {
    const kind = kindByName(file);
    if (kind === 'other' || kind === 'camera') return showNotice(FILE_WORDS.unread(file.name, otherInWords(file)));
    if (kind === 'mesh' || kind === 'heights') {
      const words = kind === 'mesh' ? FILE_WORDS.meshNoPhoto(file.name) : FILE_WORDS.heightsNoPhoto(file.name);
      return showNotice(words, 'alert', { label: FILE_WORDS.openAsHeights, act: () => openHeights([file]) });
    }
    let pageless = false;
    const signal = await show(`“${file.name}” could not be opened`, async (signal) => {
      const photo = await openPhoto(api, file, signal, half);
      for (const radio of examples) radio.checked = radio.checked && signal.aborted;
      pageless = photo.outlines.verdict === 'notFound' && await isGrey16(file);
      return photo;
    }, 1, readingOf(file), file, state);
    if (pageless && !signal.aborted) showNotice(FILE_WORDS.maybeHeights(file.name), 'alert', { label: FILE_WORDS.openAsHeights, act: () => openHeights([file]) });
  };
  /** @param {number} at */
  const turnTo = async (at) => {
    if (session) book.keep(session);
    book.at = at;
    list.renew();
    const { file, state } = book.photos[at];
    await openOne(file, false, state);
  };
  const list = pageBookPanel(book, turnTo, () => {
    book.remove();
    list.renew();
    const { file, state } = book.photos[book.at];
    void openOne(file, false, state);
  });
  /** One photo, or several that become one PDF. @param {readonly File[]} files */
  const openAll = async (files) => {
    book.begin(files);
    list.renew();
    await openOne(files[0]);
  };
  const openExample = async () => {
    book.begin([]);
    list.renew();
    const name = /** @type {ExampleName} */ (examples.find((radio) => radio.checked)?.value ?? 'curled');
    const { image, film35, pages } = examplePhoto(name);
    const pixels = { width: image.width, height: image.height, data: image.data, film35 };
    await show('The example could not be made', (signal) => photoOf(api, pixels, name, signal), pages);
  };
  for (const radio of examples) radio.addEventListener('change', openExample);
  choosesFiles(element('page-open', HTMLButtonElement), element('page-file', HTMLInputElement), openAll);
  return {
    open,
    openAll,
    /** Something to see, where nothing was opened yet. */
    begin: () => {
      if (!opening) void openExample();
    },
  };
}
