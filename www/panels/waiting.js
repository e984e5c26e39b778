/** How long an answer may still take, by what others of its kind took, and a way to do without it. */
import { element } from '../dom.js';
import { count } from '../format.js';

/** Milliseconds between two looks at the clock. */
const LOOK = 200;
/** Milliseconds for a vertex until one was measured, and the least that is a measurement. */
const EACH = 0.005;
const LEAST = 100;

/** @param {() => void} cancel */
export function waitingPanel(cancel) {
  const panel = element('waiting', HTMLElement);
  const bar = element('waiting-bar', HTMLProgressElement);
  const text = element('waiting-text', HTMLElement);
  /** Milliseconds for a vertex, by the kind of answer. @type {Map<string, number>} */
  const rates = new Map();
  let [start, expected, clock] = [0, 0, 0];

  const look = () => {
    const gone = performance.now() - start;
    // Slower towards an end that nobody knows.
    bar.value = gone < 0.8 * expected ? gone / expected : 1 - 0.2 * Math.exp(-(gone / expected - 0.8) / 0.4);
    const left = Math.ceil((expected - gone) / 1000);
    text.textContent = gone < 400 ? 'Working it out…' : left >= 1 ? `Working it out, about ${count(left)} s left` : 'Working it out, soon done';
  };
  element('waiting-cancel', HTMLButtonElement).addEventListener('click', cancel);

  return {
    /** @param {string} kind @param {number} vertices */
    begin(kind, vertices) {
      start = performance.now();
      expected = Math.max(LEAST, vertices * (rates.get(kind) ?? EACH));
      panel.hidden = false;
      clearInterval(clock);
      clock = window.setInterval(look, LOOK);
      look();
    },
    /** @param {string} [kind] of the answer that is there */
    end(kind, vertices = 0) {
      const gone = performance.now() - start;
      if (kind && gone > LEAST && vertices > 0) rates.set(kind, gone / vertices);
      clearInterval(clock);
      panel.hidden = true;
    },
  };
}
