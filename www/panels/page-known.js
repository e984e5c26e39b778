/** Options of a photo of a page: paper size, light, and number of pages. */
import { element } from '../dom.js';
import { above, choiceOf, fieldsOf } from '../fields.js';
import { keep, kept } from '../kept.js';
import { SAVE_WORDS } from '../messages.js';
import { PAPERS } from '../page/paper.js';

/** @import {Options} from '../page/flatten.js' */

const { a4, letter } = SAVE_WORDS.papers;
const FIELDS = {
  'page-format': {
    label: 'Page format', describedBy: 'format-hint',
    options: { '': 'Not known', a4: `${a4} portrait`, 'a4-wide': `${a4} landscape`, letter: `${letter} portrait`, 'letter-wide': `${letter} landscape`, own: 'another one…' },
  },
  'page-wide': { label: 'Width in mm', range: above(0), optional: true },
  'page-high': { label: 'Height in mm', range: above(0), optional: true },
  'page-light': {
    label: 'Light on the paper', options: { even: 'White paper', keep: 'Original', ink: 'Black and white' }, value: 'even',
    hint: 'Removes shadows and colour casts. Very pale print may vanish.',
  },
};

/** @param {PageSession} session */
export function pageKnownPanel(session) {
  const pages = choiceOf('pages', { 1: 'One page', 2: 'Two pages' }, (value) => (value === '2' ? session.addGutter() : session.removeGutter()));
  const fields = fieldsOf(FIELDS, () => {
    keep('light', fields.text('page-light'));
    session.setOptions(readOptions());
  });
  fields.set('page-light', kept('light', 'even'));
  element('format-field', HTMLElement).replaceChildren(...fields.nodes('page-format'));
  element('page-sides', HTMLElement).replaceChildren(...fields.nodes('page-wide', 'page-high'));
  element('light-field', HTMLElement).replaceChildren(...fields.nodes('page-light'));

  /** The options that are chosen. @returns {Options} */
  const readOptions = () => {
    const [format, light] = [fields.text('page-format'), fields.text('page-light')];
    const sides = /** @type {[number, number]} */ ([fields.number('page-wide'), fields.number('page-high')]);
    fields.show(format === 'own', 'page-wide', 'page-high');
    return {
      ...(light === 'ink' ? { ink: true } : light === 'keep' && { light }),
      ...(format === 'a4' || format === 'letter' ? { page: format } : format === 'a4-wide' || format === 'letter-wide' ? { page: [...PAPERS[format]] } : format === 'own' && sides.every((side) => side > 0) && { page: sides }),
    };
  };
  readOptions();
  session.on('photo', () => (session.options = readOptions()));
  session.on('outline', ({ outline }) => pages.set(String(outline.pages)));
}
