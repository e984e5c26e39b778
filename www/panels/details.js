/** Remembers which parts of the page the user has unfolded. */
import { elements } from '../dom.js';
import { keep, kept } from '../kept.js';

export function detailsPanel() {
  const all = elements('details[id]', HTMLDetailsElement);
  const unfolded = kept('unfolded', /** @type {string[]} */ ([]));
  for (const one of all) {
    one.open = unfolded.includes(one.id);
    one.addEventListener('toggle', () => keep('unfolded', all.filter(({ open }) => open).map(({ id }) => id)));
  }
}
