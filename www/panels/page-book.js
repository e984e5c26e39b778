/** Buttons for the photos of a book: one for each photo, and those that move or remove the present one. */
import { stemOf } from '../file-kinds.js';
import { element, make, makeButton } from '../dom.js';
import { BOOK_WORDS } from '../page/messages.js';

/** @import {Book} from '../page/book.js' */

/** Height of the small pictures on the buttons, in pixels. */
const THUMBNAIL_HEIGHT_PIXELS = 96;
/** Small pictures of photos. @type {WeakMap<File, HTMLCanvasElement>} */
const thumbnails = new WeakMap();

/**
 * @param {Book} book
 * @param {(at: number) => void} show opens a photo by its index
 * @param {() => void} remove removes the present photo
 * @param {() => void} onMoved called after the order has changed
 */
export function pageBookPanel(book, show, remove, onMoved) {
  const list = element('book', HTMLElement);
  /** @param {string} label @param {() => void} act @param {boolean} [enabled] */
  const action = (label, act, enabled = true) => Object.assign(makeButton('plain', act, label), { disabled: !enabled });
  /** @param {-1 | 1} step */
  const move = (step) => {
    book.move(step);
    renew();
    onMoved();
  };
  /** Updates the buttons after a change of the book. */
  const renew = () => {
    const { photos, index } = book;
    list.hidden = photos.length < 2;
    if (list.hidden) return list.replaceChildren();
    const buttons = photos.map(({ file, problem }, i) => {
      const button = makeButton('page-button', () => show(i), thumbnailOf(file), make('span', '', `${i + 1} ${shortened(stemOf(file))}`));
      button.title = problem ? `${file.name}: ${problem}` : file.name;
      button.setAttribute('aria-label', BOOK_WORDS.page(i + 1, file.name, problem));
      button.setAttribute('aria-pressed', String(i === index));
      button.toggleAttribute('data-problem', problem !== undefined);
      return button;
    });
    list.replaceChildren(make('span', '', BOOK_WORDS.photos(photos.length)), ...buttons, make('span', 'several',
      action(BOOK_WORDS.earlier, () => move(-1), index > 0), action(BOOK_WORDS.later, () => move(1), index < photos.length - 1), action(BOOK_WORDS.remove, remove)));
  };
  return { renew };
}

/** The end of a long name, since photos of one series begin alike. @param {string} name */
const shortened = (name) => (name.length > 9 ? `…${name.slice(-8)}` : name);

/** A small picture of a photo; it stays empty if the browser cannot decode the file. @param {File} file */
function thumbnailOf(file) {
  const known = thumbnails.get(file);
  if (known) return known;
  const canvas = make('canvas', '');
  Object.assign(canvas, { width: 0, height: 0 });
  thumbnails.set(file, canvas);
  void createImageBitmap(file, { resizeHeight: THUMBNAIL_HEIGHT_PIXELS, resizeQuality: 'medium' }).then((bitmap) => {
    Object.assign(canvas, { width: bitmap.width, height: bitmap.height });
    canvas.getContext('2d')?.drawImage(bitmap, 0, 0);
    bitmap.close();
  }).catch(() => {});
  return canvas;
}
