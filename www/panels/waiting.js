/** Progress of a task over what it is about, with a button that cancels it. */
import { make, makeButton } from '../dom.js';
import { count, percent } from '../format.js';
import { TASK_WORDS } from '../messages.js';

/** Delay before the progress of a task is shown, and before it is told anew, in milliseconds: shorter tasks end before anybody could read it. */
export const PROGRESS_DELAY_MS = 150;

/** @typedef {{ fraction?: number, label?: string, task?: Task }} TaskProgress share of a step that is done, if that is known; what the step does, in words or as a task */

/**
 * @param {HTMLElement} panel empty element
 * @param {() => void} [cancel] without it, the task cannot be cancelled
 * @param {number} [delay] time before it is shown, in milliseconds
 */
export function waitingPanel(panel, cancel, delay = 0) {
  const bar = make('progress', '');
  bar.max = 1;
  bar.setAttribute('aria-label', 'How far this is');
  const text = make('span', 'muted small');
  panel.append(bar, text);
  if (cancel) panel.append(Object.assign(makeButton('', cancel, 'Cancel'), { id: `${panel.id}-cancel` }));
  let [start, updateTimer, showTimer] = [0, 0, 0];
  let [task, words] = ['', ''];
  /** Share of the present step that is done; undefined where that is not told. @type {number | undefined} */
  let done;

  const update = () => {
    const elapsed = Math.floor((performance.now() - start) / 1000);
    if (done === undefined) bar.removeAttribute('value');
    else bar.value = done;
    text.textContent = done !== undefined ? `${words}, ${percent(Math.floor(100 * done) / 100)}` : elapsed > 0 ? `${words}, ${count(elapsed)} s` : `${words}…`;
  };

  return {
    /** Shows that a task is under way. @param {Task} name */
    begin(name) {
      start = performance.now();
      task = words = TASK_WORDS[name];
      done = undefined;
      clearTimeout(showTimer);
      if (delay === 0) panel.hidden = false;
      else showTimer = window.setTimeout(() => (panel.hidden = false), delay);
      clearInterval(updateTimer);
      updateTimer = window.setInterval(update, PROGRESS_DELAY_MS);
      update();
    },
    /** Tells how far the task is. What follows a step that is done is not told. @param {TaskProgress} progress */
    tell({ fraction, task: step, label = step && TASK_WORDS[step] }) {
      done = fraction !== undefined && fraction < 1 ? fraction : undefined;
      words = fraction !== undefined && fraction >= 1 ? task : label ?? task;
      update();
    },
    /** Hides the progress. */
    end() {
      clearInterval(updateTimer);
      clearTimeout(showTimer);
      panel.hidden = true;
    },
  };
}
