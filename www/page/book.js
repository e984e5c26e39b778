/** The photos of pages that are open: a single one, or several that become one PDF, each with the state of its outline. */
import { plainMessage } from '../error-messages.js';
import { BOOK_WORDS } from './messages.js';
import { runInWorker } from '../worker-task.js';
import { flattenReducedPhoto, flattenWholePhoto } from './flatten.js';
import { optionsOf } from './known.js';
import { pictureFiles } from './paper.js';
import { openPhoto } from './photo.js';

/** @import {Traces} from './flatten.js' */

/**
 * @typedef {object} BookPhoto
 * @property {File} file
 * @property {PageState | null} state changes to its outline; null if the photo was not shown yet
 * @property {string} [problem] why it is not in the PDF that was written last
 */
/** @typedef {{ photos: BookPhoto[], index: number, shown: PageState }} BookState `shown`: of the photo or the example that a session shows */

/** Whether there are the same photos in the same order, with the same outlines and options, as far as these are known. @param {BookState} a @param {BookState} b */
export function isSameBook(a, b) {
  return a.photos.length === b.photos.length && (a.photos.length > 0 || editsOf(a.shown) === editsOf(b.shown)) && a.photos.every(({ file, state }, i) => {
    const other = b.photos[i];
    return file === other.file && (!state || !other.state || editsOf(state) === editsOf(other.state));
  });
}

/** The text of all that a user can change of the page in a photo. @param {PageState} state */
const editsOf = ({ outline, movedCorners, pageIndex, quarters, known }) => JSON.stringify([outline, [...movedCorners].sort(), pageIndex, quarters, known]);

export class Book {
  /** @type {BookPhoto[]} */
  photos = [];
  /** Index of the photo that is shown. */
  index = 0;

  /** The photos as they are. */
  get snapshot() {
    return { photos: this.photos.map((photo) => ({ ...photo })), index: this.index };
  }

  /** Replaces all photos. @param {readonly File[]} files @param {readonly (PageState | null)[]} [states] */
  setFiles(files, states = []) {
    [this.photos, this.index] = [files.map((file, i) => ({ file, state: states[i] ?? null })), 0];
  }

  /** Adds photos at the end. A photo that is there already is not added again. @param {readonly File[]} files @returns {number[]} indices of the photos */
  addFiles(files) {
    return files.map((file) => {
      const at = this.photos.findIndex(({ file: { name, size, lastModified } }) => name === file.name && size === file.size && lastModified === file.lastModified);
      return at >= 0 ? at : this.photos.push({ file, state: null }) - 1;
    });
  }

  /** Saves the state of the photo that a session shows, wherever it is among the photos. @param {PageSession} session */
  saveState(session) {
    const photo = this.photos.find(({ file }) => file === session.photo?.file);
    if (photo) photo.state = session.state();
  }

  /** Removes a photo. @param {number} at its index */
  remove(at) {
    const [photo] = this.photos.splice(at, 1);
    if (at < this.index || this.index === this.photos.length) this.index = Math.max(0, this.index - 1);
    return photo;
  }

  /** Moves the photo that is shown to an earlier or later place. @param {-1 | 1} step */
  move(step) {
    const to = this.index + step;
    if (!this.photos[to]) return;
    [this.photos[this.index], this.photos[to]] = [this.photos[to], this.photos[this.index]];
    this.index = to;
  }

  /**
   * Flattens all photos at full resolution, one after the other to save memory. Photos that cannot be flattened are left out,
   * and their `problem` says why.
   * @param {Api} api
   * @param {PackageWorker} worker
   * @param {readonly [number, number] | null} paper size in millimetres; null for true size
   * @param {boolean} text whether text is recognised
   * @param {AbortSignal} signal
   * @param {(index: number) => void} onPhoto called before each photo
   * @returns the picture file and the size of each page
   * @throws if no photo can be flattened
   */
  async flatPages(api, worker, paper, text, signal, onPhoto) {
    const pages = [];
    for (const [i, entry] of this.photos.entries()) {
      onPhoto(i);
      delete entry.problem;
      try {
        const { file, state } = entry;
        const photo = await openPhoto(api, file, signal);
        const [quarters, traces] = [state?.quarters ?? 0, state?.traces ?? detectedTraces(photo)];
        const options = optionsOf(state?.known);
        const request = { photo, traces, options, isDetected: !state?.movedCorners.size, moving: false };
        const flat = await runInWorker(api, signal, async (own) => flattenWholePhoto(own, request, await flattenReducedPhoto(own, request)));
        pages.push(...await pictureFiles(worker, flat, traces[0].length, quarters, paper, { ink: options.ink, text }));
      } catch (error) {
        signal.throwIfAborted();
        entry.problem = plainMessage(error);
      }
    }
    if (pages.length === 0) throw new Error(this.problems().join('; '));
    return pages;
  }

  /** The photos that are left out, with each reason once. */
  problems() {
    const reasons = new Set(this.photos.flatMap(({ problem }) => problem ?? []));
    return Array.from(reasons, (reason) => BOOK_WORDS.without(this.photos.filter(({ problem }) => problem === reason).map(({ file }) => file.name), reason));
  }
}

/** The edges of the page that was detected in a photo. @param {PagePhoto} photo @returns {Traces} */
function detectedTraces({ outlines: { verdict, pages: [found] } }) {
  if (verdict === 'notFound' || !found) throw new Error(BOOK_WORDS.unfound);
  const { top, bottom, left, right } = found.edges;
  return [[top], [bottom], [left], [right]];
}
