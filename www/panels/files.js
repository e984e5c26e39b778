/** Opens files of any kind, wherever they come from: the kind of a file chooses the part of the page. */
import { endingOf, isHeic, isPdf, kindByName } from '../file-kinds.js';
import { isInColour, routeFiles } from '../file-routing.js';
import { BATCH_WORDS, FILE_WORDS, HEADLINE_WORDS } from '../messages.js';
import { picturesOfPdf } from '../page/pdf.js';
import { withoutHeic } from '../pixels.js';
import { showNotice } from './notice.js';

/** @import {Mode} from './mode.js' */

/**
 * @param {Session} session
 * @param {{ readonly now: Mode, show: (mode: Mode) => void, enter: (mode: Mode) => void }} mode
 * @param {object} source
 * @param {(files: readonly File[]) => Promise<unknown>} source.openFiles opens heights or a mesh
 * @param {{ readonly hasPhoto: boolean, openAll: (files: readonly File[], alone: boolean) => Promise<string | null> }} page opens photos of pages; the answer is a note, or null if none could be opened
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
    const before = mode.now;
    const isOtherMode = before !== 'photo';
    mode.show('photo');
    // Photos are added to those that are shown; from another part of the page a new job begins.
    const pageNote = await page.openAll(files, isOtherMode);
    if (pageNote === null && !page.hasPhoto && mode.now === 'photo') mode.show(before);
    if (pageNote === null) return;
    const isGuess = isOtherMode && !areChosen;
    const taken = isGuess ? FILE_WORDS.takenForPages(files.length) : '';
    note([taken, pageNote, leftOut].filter(Boolean).join(' '), isGuess && files.length === 1 ? {
      label: FILE_WORDS.heightsInstead,
      act: async () => {
        if (await isInColour(files[0])) return note(FILE_WORDS.inColour(files[0].name));
        mode.enter('heights');
        void source.openFiles(files);
      },
    } : undefined);
  };

  /** The mode of the page before the files that are being opened as heights, and how many openings are under way. @type {{ mode: Mode, openings: number }} */
  const earlier = { mode: 'home', openings: 0 };
  /** @param {readonly File[]} given @param {boolean} [arePages] whether pictures were opened as pages @returns {Promise<void>} */
  const open = async (given, arePages = mode.now === 'photo') => {
    const files = given.some(isHeic) ? await session.whileOpening('the photos could not be read', 'reading', () => withoutHeic(given)) : given;
    if (!files) return;
    const pdf = files.find(isPdf);
    if (pdf) {
      const pages = await session.whileOpening(`“${pdf.name}” could not be read`, 'reading', (signal) => picturesOfPdf(pdf, signal));
      return pages ? open(files.flatMap((file) => (file === pdf ? pages : file)), true) : undefined;
    }
    const { to, files: taken, left } = await routeFiles(files, arePages);
    const leftOut = left.length > 0 ? FILE_WORDS.leftOut(left, to === 'photos' ? 'photo' : kindByName(taken[0]) === 'mesh' ? 'mesh' : 'depths') : '';
    if (to === 'photos') return openPhotos(taken, leftOut, arePages);
    if (mode.now !== 'heights' || earlier.openings === 0) earlier.mode = mode.now;
    mode.show('heights');
    earlier.openings++;
    if (!(await source.openFiles(taken).finally(() => earlier.openings--))) {
      // What was opened there before is not what was asked for, but something else may be being opened by now.
      if (!session.isOpening && mode.now === 'heights') mode.show(earlier.mode);
      return;
    }
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
    /** Opens a file of heights that turned out to be a picture in colour. @param {File} file */
    openColour: (file) => openPhotos([file]),
  };
}
