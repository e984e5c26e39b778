/** Progress bar of a task, whose duration is estimated from earlier tasks of its kind, with a button that cancels it. */
import { make } from '../dom.js';
import { count } from '../format.js';

/** Interval between two updates of the progress bar, in milliseconds. */
const UPDATE_INTERVAL_MS = 200;
/** Delay before the progress of a task is shown, in milliseconds: shorter tasks end before anybody could read it. */
export const PROGRESS_DELAY_MS = 150;
/** Minimum duration of a task that is measured, in milliseconds; it is also the minimum of the estimated duration. */
const MIN_MEASURED_MS = 100;
/** Time before the text shows figures, in milliseconds. */
const FIGURES_DELAY_MS = 400;

/** @import {TimedTask} from '../session.js' */

/**
 * @param {HTMLElement} panel empty element
 * @param {() => void} cancel
 * @param {number} [delay] time before it is shown, in milliseconds
 */
export function waitingPanel(panel, cancel, delay = 0) {
  const bar = make('progress', '');
  bar.max = 1;
  bar.setAttribute('aria-label', 'How far this is, by what others took');
  const text = make('span', 'muted small');
  const button = make('button', '', 'Cancel');
  Object.assign(button, { type: 'button', id: `${panel.id}-cancel` });
  button.addEventListener('click', cancel);
  panel.append(bar, text, button);
  /** Measured milliseconds per unit of size, by the kind of task. @type {Map<string, number>} */
  const rates = new Map();
  let [start, expected, updateTimer, showTimer] = [0, 0, 0, 0];
  let label = '';

  const update = () => {
    const elapsed = performance.now() - start;
    // The bar slows down near its end, and never reaches it before the task ends; it says nothing of a task of an unknown kind.
    if (Number.isNaN(expected)) bar.removeAttribute('value');
    else bar.value = elapsed < 0.8 * expected ? elapsed / expected : 1 - 0.2 * Math.exp(-(elapsed / expected - 0.8) / 0.4);
    const left = Math.ceil((expected - elapsed) / 1000);
    if (elapsed < FIGURES_DELAY_MS) text.textContent = `${label}…`;
    else if (Number.isNaN(expected)) text.textContent = `${label}, ${count(Math.floor(elapsed / 1000))} s`;
    else text.textContent = left >= 1 ? `${label}, about ${count(left)} s left` : `${label}, soon done`;
  };

  return {
    /** Shows the progress of a task. @param {TimedTask} task */
    begin(task) {
      start = performance.now();
      label = task.label;
      expected = Math.max(MIN_MEASURED_MS, task.size * (rates.get(task.kind) ?? NaN));
      clearTimeout(showTimer);
      if (delay === 0) panel.hidden = false;
      else showTimer = window.setTimeout(() => (panel.hidden = false), delay);
      clearInterval(updateTimer);
      updateTimer = window.setInterval(update, UPDATE_INTERVAL_MS);
      update();
    },
    /** Hides the progress. @param {Pick<TimedTask, 'kind' | 'size'>} [finished] the task, if it was finished: its duration is then measured */
    end(finished) {
      const elapsed = performance.now() - start;
      if (finished && elapsed > MIN_MEASURED_MS) rates.set(finished.kind, elapsed / Math.max(1, finished.size));
      clearInterval(updateTimer);
      clearTimeout(showTimer);
      panel.hidden = true;
    },
  };
}
