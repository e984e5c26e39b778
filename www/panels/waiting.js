/** How long an answer may still take, by what others of its kind took, and a way to do without it. */
import { make } from '../dom.js';
import { count } from '../format.js';

/** Milliseconds between two looks at the clock. */
const LOOK = 200;
/** What takes fewer milliseconds is done before anybody could read about it. */
export const SOON = 150;
/** The fewest milliseconds that are a measurement. */
const LEAST = 100;

/** @import {Slow} from '../session.js' */

/**
 * @param {HTMLElement} panel empty
 * @param {() => void} cancel
 * @param {number} [after] so many milliseconds it is shown
 */
export function waitingPanel(panel, cancel, after = 0) {
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
  let [start, expected, clock, shown] = [0, 0, 0, 0];
  let doing = '';
  /** Whether others of its kind were measured: a guess of the time left is not told. */
  let measured = false;

  const look = () => {
    const gone = performance.now() - start;
    // Slower towards an end that nobody knows.
    bar.value = gone < 0.8 * expected ? gone / expected : 1 - 0.2 * Math.exp(-(gone / expected - 0.8) / 0.4);
    const left = Math.ceil((expected - gone) / 1000);
    if (gone < 400) text.textContent = `${doing}…`;
    else if (!measured) text.textContent = `${doing}, ${count(Math.floor(gone / 1000))} s`;
    else text.textContent = left >= 1 ? `${doing}, about ${count(left)} s left` : `${doing}, soon done`;
  };

  return {
    /** @param {Slow} slow */
    begin({ kind, size, each, words }) {
      start = performance.now();
      doing = words;
      measured = rates.has(kind);
      expected = Math.max(LEAST, size * (rates.get(kind) ?? each));
      clearTimeout(shown);
      if (after === 0) panel.hidden = false;
      else shown = window.setTimeout(() => (panel.hidden = false), after);
      clearInterval(clock);
      clock = window.setInterval(look, LOOK);
      look();
    },
    /** @param {Slow} [done] what has got its answer */
    end(done) {
      const gone = performance.now() - start;
      if (done && gone > LEAST) rates.set(done.kind, gone / Math.max(1, done.size));
      clearInterval(clock);
      clearTimeout(shown);
      panel.hidden = true;
    },
  };
}
