/** Options of a photo of a page: paper size, light, and number of pages. */
import { element } from '../dom.js';
import { above, choiceOf, fieldsOf } from '../fields.js';
import { keep } from '../kept.js';
import { SAVE_WORDS } from '../messages.js';
import { BOOK_WORDS, PAGE_WORDS } from '../page/messages.js';

const { a4, letter } = SAVE_WORDS.papers;
const FIELDS = {
  'page-format': {
    label: 'Page format', describedBy: 'format-hint',
    options: { '': 'Not known', a4: `${a4} portrait`, 'a4-wide': `${a4} landscape`, letter: `${letter} portrait`, 'letter-wide': `${letter} landscape`, own: 'another one…' },
  },
  'page-wide': { label: 'Width in mm', range: above(0), optional: true },
  'page-high': { label: 'Height in mm', range: above(0), optional: true },
  'page-light': {
    label: 'Light on the paper', options: { even: 'White paper', keep: 'Original', ink: 'Black and white' }, hint: PAGE_WORDS.light,
  },
};

/** @param {PageSession} session @param {import('../page/book.js').Book} book the photos that are open */
export function pageKnownPanel(session, book) {
  const pages = choiceOf('pages', { 1: 'One page', 2: 'Two pages' }, (value) => (value === '2' ? session.addGutter() : session.removeGutter()));
  const fields = fieldsOf(FIELDS, (name) => {
    const [format, wide, high, light] = [fields.text('page-format'), fields.text('page-wide'), fields.text('page-high'), fields.text('page-light')];
    if (name === 'page-light') keep('light', light);
    fields.show(format === 'own', 'page-wide', 'page-high');
    session.setKnown({ format, wide, high, light });
  });
  element('format-field', HTMLElement).replaceChildren(...fields.nodes('page-format'));
  element('page-sides', HTMLElement).replaceChildren(...fields.nodes('page-wide', 'page-high'));
  element('light-field', HTMLElement).replaceChildren(...fields.nodes('page-light'));
  const show = () => {
    const { format, wide, high, light } = session.known;
    for (const [name, value] of Object.entries({ 'page-format': format, 'page-wide': wide, 'page-high': high, 'page-light': light })) fields.set(/** @type {keyof typeof FIELDS} */ (name), value);
    fields.show(format === 'own', 'page-wide', 'page-high');
    fields.hint('page-light', `${PAGE_WORDS.light}${book.photos.length > 1 ? BOOK_WORDS.ownOptions : ''}`);
  };
  session.on('photo', show);
  session.on('changed', show);
  session.on('outline', ({ outline }) => pages.set(String(outline.pages)));
}
