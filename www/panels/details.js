/** Remembers which parts of the page the user has unfolded. */
import { elements } from '../dom.js';

/** Key in the local storage of the ids of unfolded parts, separated by spaces. */
const UNFOLDED_KEY = 'developable: unfolded';

export function detailsPanel() {
  const all = elements('details[id]', HTMLDetailsElement);
  try {
    const unfolded = (localStorage.getItem(UNFOLDED_KEY) ?? '').split(' ');
    for (const one of all) {
      one.open = unfolded.includes(one.id);
      one.addEventListener('toggle', () => localStorage.setItem(UNFOLDED_KEY, all.filter(({ open }) => open).map(({ id }) => id).join(' ')));
    }
  } catch {
    // Without local storage nothing is remembered.
  }
}
