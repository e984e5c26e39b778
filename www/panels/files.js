/** Opens files of any kind, wherever they come from: the kind of a file chooses the part of the page. */
import { closeDialogs } from '../dom.js';
import { endingOf, isPdf, kindByName } from '../file-kinds.js';
import { isInColour, routeFiles } from '../file-routing.js';
import { BATCH_WORDS, FILE_WORDS, HEADLINE_WORDS } from '../messages.js';
import { picturesOfPdf } from '../page/pdf.js';
import { withoutHeic } from '../pixels.js';
import { showNotice } from './notice.js';

/** @import {Mode} from './mode.js' */

/**
 * @param {Session} session
 * @param {{ readonly now: Mode, show: (mode: Mode) => void }} mode
 * @param {object} source
 * @param {(files: readonly File[]) => Promise<boolean>} source.openFiles opens heights or a mesh; whether it did
 * @param {{ openAll: (files: readonly File[], alone: boolean) => Promise<string | null> }} page opens photos of pages; the answer is a note, or null if none could be opened
 */
export function filesPanel(session, mode, source, page) {
  /** @param {string} words @param {{ label: string, act: () => void }} [action] */
  const note = (words, action) => {
    if (words) showNotice(words, 'note', action);
  };

  /**
   * Opens photos of pages.
   * @param {readonly File[]} files
   * @param {string} [leftOut] words about files that were left out
   * @param {boolean} [areChosen] whether they were opened as photos of pages, so that nothing is to be said about that
   */
  const openPhotos = async (files, leftOut = '', areChosen = false) => {
    // Photos are added to those that are shown; from another part of the page a new job begins.
    const isOtherMode = mode.now !== 'photo';
    const pageNote = await openIn('photo', () => page.openAll(files, isOtherMode));
    if (pageNote === null || mode.now !== 'photo') return;
    // A picture in colour has no heights; a grey one may have.
    const isGuess = isOtherMode && !areChosen && files.length === 1 && !(await isInColour(files[0]));
    note([isGuess ? FILE_WORDS.takenForPage : '', pageNote, leftOut].filter(Boolean).join(' '), isGuess ? { label: FILE_WORDS.heightsInstead, act: () => openIn('heights', () => source.openFiles(files)) } : undefined);
  };

  /** The mode of the page before the files that are being opened, and how many openings are under way. @type {{ mode: Mode, openings: number }} */
  const earlier = { mode: 'home', openings: 0 };
  /**
   * Shows a part of the page while files are opened there, and the part from before if none are: what was open there is not what was asked for.
   * @template {string | boolean | null} T
   * @param {Mode} part
   * @param {() => Promise<T>} openThere null or false if nothing was opened
   */
  const openIn = async (part, openThere) => {
    if (earlier.openings === 0) earlier.mode = mode.now;
    mode.show(part);
    earlier.openings++;
    const opened = await openThere().finally(() => earlier.openings--);
    // Something else may be being opened by now.
    if ((opened === null || opened === false) && earlier.openings === 0 && !session.isOpening && mode.now === part) mode.show(earlier.mode);
    return opened;
  };
  /** @param {readonly File[]} given @param {boolean} [arePages] whether pictures were opened as pages @returns {Promise<void>} */
  const open = async (given, arePages = mode.now === 'photo') => {
    closeDialogs();
    const areChosen = arePages || given.some(isPdf);
    const route = await session.whileOpening(given.length === 1 ? 'The file could not be read' : 'The files could not be read', 'reading', async (signal) => {
      const files = [];
      for (const file of await withoutHeic(given)) files.push(...(isPdf(file) ? await picturesOfPdf(file, signal) : [file]));
      return routeFiles(files, areChosen);
    });
    if (!route) return;
    const { to, files: taken, left } = route;
    const leftOut = left.length > 0 ? FILE_WORDS.leftOut(left, to === 'photos' ? 'photo' : kindByName(taken[0]) === 'mesh' ? 'mesh' : 'depths') : '';
    if (to === 'photos') return openPhotos(taken, leftOut, areChosen);
    if (!(await openIn('heights', () => source.openFiles(taken))) || mode.now !== 'heights') return;
    // The start of a run hides the notice, so it is shown afterwards.
    const openable = left.filter(kindByName);
    const scans = [taken[0], ...left.filter((file) => endingOf(file) === endingOf(taken[0]))];
    if (scans.length > 1 && taken.length === 1 && session.input?.stored) note(HEADLINE_WORDS.opened(`“${taken[0].name}”`), { label: BATCH_WORDS.offer(scans.length), act: async () => (await import('./batch.js')).offerBatch(session, scans) });
    else if (openable.length > 0) note(leftOut, { label: FILE_WORDS.openInstead(openable), act: () => void open(openable) });
    else if (taken.length === 1 && kindByName(taken[0]) === 'picture') note([FILE_WORDS.takenForHeights, leftOut].filter(Boolean).join(' '), { label: FILE_WORDS.openAsPage, act: () => void openPhotos(taken, '', true) });
    else note(leftOut);
  };
  return {
    open,
    openIn,
    /** Opens a file of heights that turned out to be a picture in colour. @param {File} file */
    openColour: (file) => openPhotos([file]),
  };
}
