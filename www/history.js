/** Undo: states of what is worked on, from before each change. Ctrl+Z is for the part of the page that is shown. */

/** All that can be undone, the newest last. @type {History<any>[]} */
let histories = [];

/** @template T states, which are never changed */
export class History {
  /** States before the present one, and states that were undone. @type {[past: T[], undone: T[]]} */
  #states = [[], []];
  /** @type {T | undefined} */
  #present;

  /** @param {HTMLElement} part of the page @param {(state: T) => void} restore @param {(a: T, b: T) => boolean} [isSame] */
  constructor(part, restore, isSame = (a, b) => JSON.stringify(a) === JSON.stringify(b)) {
    this.part = part;
    this.restore = restore;
    this.isSame = isSame;
    histories = [...histories.filter((one) => one.part.isConnected), this];
  }

  get canUndo() {
    return this.#states[0].length > 0;
  }

  /** Forgets all states. */
  clear() {
    [this.#states, this.#present] = [[[], []], undefined];
  }

  /** Notes what has become of it. @param {T} state */
  note(state) {
    if (this.#present !== undefined && !this.isSame(this.#present, state)) this.#states = [[...this.#states[0], this.#present], []];
    this.#present = state;
  }

  /** Goes back to the state before, or forward again. @param {boolean} [isForward] */
  step(isForward = false) {
    const [from, to] = isForward ? this.#states.toReversed() : this.#states;
    const state = from.pop();
    if (state === undefined || this.#present === undefined) return;
    to.push(this.#present);
    this.#present = state;
    this.restore(state);
  }
}

document.addEventListener('keydown', (event) => {
  // Fields undo what is typed by themselves.
  const isTyping = event.target instanceof HTMLInputElement && event.target.type === 'text';
  if (event.key.toLowerCase() !== 'z' || !(event.ctrlKey || event.metaKey) || isTyping) return;
  const dialog = document.querySelector('dialog[open]');
  const history = histories.findLast(({ part }) => part.checkVisibility() && (!dialog || dialog.contains(part)));
  if (history) event.preventDefault();
  history?.step(event.shiftKey);
});
