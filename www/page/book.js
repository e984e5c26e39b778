/** Several photos of pages that become one PDF: each with its outline, as it was found or corrected. */
import { BOOK_WORDS } from './messages.js';
import { apart } from '../worker-task.js';
import { whole } from './flatten.js';
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
 * @property {PageState | null} state what was done to its outline; nothing yet, if it was not looked at
 */

export class Book {
  /** @type {BookPhoto[]} */
  photos = [];
  /** The number of the photo that is shown. */
  at = 0;

  /** Another book, or none: one photo alone. @param {readonly File[]} files */
  begin(files) {
    [this.photos, this.at] = [files.map((file) => ({ file, state: null })), 0];
  }

  /** Keeps what was done to the photo that is shown. @param {PageSession} session */
  keep(session) {
    const shown = this.photos[this.at];
    if (shown && session.photo) shown.state = session.state();
  }

  /** Takes the photo that is shown out. */
  remove() {
    this.photos.splice(this.at, 1);
    this.at = Math.min(this.at, this.photos.length - 1);
  }

  /**
   * The files of all pages' pictures, with all pixels of the photos: one after the other, since there may not be memory for all.
   * @param {Api} api
   * @param {PageSession} session of the photo that is shown
   * @param {Worker} worker
   * @param {readonly [number, number] | null} paper in millimetres, or true size without one
   * @param {(done: number) => void} tell
   */
  async pages(api, session, worker, paper, tell) {
    this.keep(session);
    const { signal } = new AbortController();
    const made = [];
    for (const [i, { file, state }] of this.photos.entries()) {
      tell(i);
      try {
        const photo = await openPhoto(api, file, signal);
        const { quarters, outline, traces, text } = state ?? { quarters: 0, outline: { pages: 1 }, traces: tracesOf(photo), text: [[]] };
        const { options, finding } = session;
        const wish = { photo, traces, text, options: { ...options, findLines: finding }, moving: false };
        const flat = await apart(api, signal, (own) => whole(own, wish));
        made.push(...await pictureFiles(worker, flat, outline.pages, quarters, paper, options.ink));
      } catch (error) {
        throw new Error(`${file.name}: ${error instanceof Error ? error.message : String(error)}`, { cause: error });
      }
    }
    return made;
  }
}

/**
 * The edges of the page that was found in a photo.
 * @param {PagePhoto} photo
 * @returns {Traces}
 */
function tracesOf({ outlines: { verdict, pages: [found] } }) {
  if (verdict === 'notFound' || !found) throw new Error(BOOK_WORDS.unfound);
  const { top, bottom, left, right } = found.edges;
  return [[top], [bottom], [left], [right]];
}
