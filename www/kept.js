/** What the user has chosen, kept in the local storage for the next visit. */
import { elements } from './dom.js';

/** What was kept under a name. @template T @param {string} name @param {T} otherwise where nothing was, or the browser keeps nothing @returns {T} */
export function kept(name, otherwise) {
  try {
    return JSON.parse(localStorage.getItem(`developable: ${name}`) ?? 'null') ?? otherwise;
  } catch {
    return otherwise;
  }
}

/** Keeps something of plain data, if the browser keeps anything. @param {string} name @param {unknown} value */
export function keep(name, value) {
  try {
    localStorage.setItem(`developable: ${name}`, JSON.stringify(value));
  } catch {
    // A private window, or a full disk.
  }
}

/** Unfolds the parts of the page that were unfolded last. */
export function unfoldParts() {
  const all = elements('details[id]', HTMLDetailsElement);
  const unfolded = kept('unfolded', /** @type {string[]} */ ([]));
  for (const one of all) {
    one.open = unfolded.includes(one.id);
    one.addEventListener('toggle', () => keep('unfolded', all.filter(({ open }) => open).map(({ id }) => id)));
  }
}
