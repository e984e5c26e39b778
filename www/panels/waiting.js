/** How long an answer may still take, by what others of its kind took, and a way to do without it. */
import { make } from '../dom.js';
import { count } from '../format.js';

/** Milliseconds between two looks at the clock. */
const LOOK = 200;
/** Milliseconds for a vertex until one was measured, and the least that is a measurement. */
const EACH = 0.005;
const LEAST = 100;

/**
 * @param {HTMLElement} panel empty
 * @param {string} doing what is done, in words
 * @param {() => void} cancel
 */
export function waitingPanel(panel, doing, cancel) {
  const bar = make('progress', '');
  bar.max = 1;
  bar.setAttribute('aria-label', 'How far this is, by what others took');
  const text = make('span', 'muted small');
  const button = make('button', '', 'Cancel');
  Object.assign(button, { type: 'button', id: `${panel.id}-cancel` });
  button.addEventListener('click', cancel);
  panel.append(bar, text, button);
  /** Milliseconds for each of what an answer goes through, by its kind. @type {Map<string, number>} */
  const rates = new Map();
  let [start, expected, clock] = [0, 0, 0];

  const look = () => {
    const gone = performance.now() - start;
    // Slower towards an end that nobody knows.
    bar.value = gone < 0.8 * expected ? gone / expected : 1 - 0.2 * Math.exp(-(gone / expected - 0.8) / 0.4);
    const left = Math.ceil((expected - gone) / 1000);
    text.textContent = gone < 400 ? `${doing}…` : left >= 1 ? `${doing}, about ${count(left)} s left` : `${doing}, soon done`;
  };

  return {
    /**
     * @param {string} kind
     * @param {number} size vertices, or bytes
     * @param {number} [each] milliseconds for one, until that was measured
     */
    begin(kind, size, each = EACH) {
      start = performance.now();
      expected = Math.max(LEAST, size * (rates.get(kind) ?? each));
      panel.hidden = false;
      clearInterval(clock);
      clock = window.setInterval(look, LOOK);
      look();
    },
    /** @param {string} [kind] of the answer that is there */
    end(kind, size = 0) {
      const gone = performance.now() - start;
      if (kind && gone > LEAST && size > 0) rates.set(kind, gone / size);
      clearInterval(clock);
      panel.hidden = true;
    },
  };
}
