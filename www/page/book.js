/** Several photos of pages that become one PDF, each with the state of its outline. */
import { BOOK_WORDS } from './messages.js';
import { runInWorker } from '../worker-task.js';
import { flattenWholePhoto } from './flatten.js';
import { pictureFiles } from './paper.js';
import { openPhoto } from './photo.js';

/** @import {Api} from '../api.js' */
/** @import {Traces} from './flatten.js' */
/** @import {PagePhoto} from './photo.js' */
/** @import {PageSession, PageState} from './session.js' */
/** @import {Worker} from '../worker-task.js' */

/**
 * @typedef {object} BookPhoto
 * @property {File} file
 * @property {PageState | null} state changes to its outline; null if the photo was not shown yet
 */

export class Book {
  /** @type {BookPhoto[]} */
  photos = [];
  /** Index of the photo that is shown. */
  index = 0;

  /** Replaces all photos; a single file is a photo alone. @param {readonly File[]} files */
  setFiles(files) {
    [this.photos, this.index] = [files.map((file) => ({ file, state: null })), 0];
  }

  /** Saves the state of the photo that is shown. @param {PageSession} session */
  saveState(session) {
    const photo = this.photos[this.index];
    if (photo && session.photo) photo.state = session.state();
  }

  /** Removes the photo that is shown. */
  remove() {
    this.photos.splice(this.index, 1);
    this.index = Math.min(this.index, this.photos.length - 1);
  }

  /**
   * Flattens all photos at full resolution, one after the other to save memory.
   * @param {Api} api
   * @param {PageSession} session session of the photo that is shown
   * @param {Worker} worker
   * @param {readonly [number, number] | null} paper size in millimetres; null for true size
   * @param {(index: number) => void} onPhoto called before each photo
   * @returns the picture file and the size of each page
   */
  async flatPages(api, session, worker, paper, onPhoto) {
    this.saveState(session);
    const { signal } = new AbortController();
    const pages = [];
    for (const [i, { file, state }] of this.photos.entries()) {
      onPhoto(i);
      try {
        const photo = await openPhoto(api, file, signal);
        const { quarters, outline, traces, textLines } = state ?? { quarters: 0, outline: { pages: 1 }, traces: detectedTraces(photo), textLines: [[]] };
        const { options, findsTextLines } = session;
        const request = { photo, traces, textLines, options: { ...options, findLines: findsTextLines }, moving: false };
        const flat = await runInWorker(api, signal, (own) => flattenWholePhoto(own, request));
        pages.push(...await pictureFiles(worker, flat, outline.pages, quarters, paper, options.ink));
      } catch (error) {
        throw new Error(`${file.name}: ${error instanceof Error ? error.message : String(error)}`, { cause: error });
      }
    }
    return pages;
  }
}

/**
 * The edges of the page that was detected in a photo.
 * @param {PagePhoto} photo
 * @returns {Traces}
 */
function detectedTraces({ outlines: { verdict, pages: [found] } }) {
  if (verdict === 'notFound' || !found) throw new Error(BOOK_WORDS.unfound);
  const { top, bottom, left, right } = found.edges;
  return [[top], [bottom], [left], [right]];
}
