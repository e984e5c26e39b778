/** The photos of a book, to be gone through: one button each, and one more to add others. */
import { element, make } from '../dom.js';
import { BOOK_WORDS } from '../page/messages.js';

/** @import {Book} from '../page/book.js' */

/**
 * @param {Book} book
 * @param {(at: number) => void} show
 * @param {() => void} remove the photo that is shown
 */
export function pageBookPanel(book, show, remove) {
  const list = element('book', HTMLElement);
  return {
    /** Tells which photos there are, and which of them is shown. */
    renew() {
      const { photos, at } = book;
      list.hidden = photos.length < 2;
      if (list.hidden) return list.replaceChildren();
      const buttons = photos.map(({ file }, i) => {
        const button = make('button', '', BOOK_WORDS.number(i + 1));
        button.type = 'button';
        button.title = file.name;
        button.setAttribute('aria-label', BOOK_WORDS.page(i + 1, file.name));
        button.setAttribute('aria-pressed', String(i === at));
        button.addEventListener('click', () => show(i));
        return button;
      });
      const out = make('button', 'plain', BOOK_WORDS.remove);
      out.type = 'button';
      out.addEventListener('click', remove);
      list.replaceChildren(BOOK_WORDS.photos(photos.length), ...buttons, out);
    },
  };
}
