/** Buttons for the photos of a book: one for each photo, and one that removes the present photo. */
import { element, make } from '../dom.js';
import { BOOK_WORDS } from '../page/messages.js';

/** @import {Book} from '../page/book.js' */

/**
 * @param {Book} book
 * @param {(at: number) => void} show opens a photo by its index
 * @param {() => void} remove removes the present photo
 */
export function pageBookPanel(book, show, remove) {
  const list = element('book', HTMLElement);
  return {
    /** Updates the buttons after a change of the book. */
    renew() {
      const { photos, index } = book;
      list.hidden = photos.length < 2;
      if (list.hidden) return list.replaceChildren();
      const buttons = photos.map(({ file }, i) => {
        const button = make('button', '', BOOK_WORDS.number(i + 1));
        button.type = 'button';
        button.title = file.name;
        button.setAttribute('aria-label', BOOK_WORDS.page(i + 1, file.name));
        button.setAttribute('aria-pressed', String(i === index));
        button.addEventListener('click', () => show(i));
        return button;
      });
      const removeButton = make('button', 'plain', BOOK_WORDS.remove);
      removeButton.type = 'button';
      removeButton.addEventListener('click', remove);
      list.replaceChildren(BOOK_WORDS.photos(photos.length), ...buttons, removeButton);
    },
  };
}
