/** Choice of a view of the result, and the text below it. */
import { element, elements, make } from '../dom.js';
import { gaussian, kappa2 } from '../views/curvature.js';
import { aboutView } from '../views/legend.js';
import { patches } from '../views/patches.js';
import { hasColours, photo } from '../views/photo.js';
import { flat } from '../views/pieces.js';
import { rulings } from '../views/rulings.js';
import { TASK_WORDS, VIEW_WORDS } from '../messages.js';
import { waitingPanel } from './waiting.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result, Session} from '../session.js' */
/** @import {ViewContent} from '../views/view-content.js' */
/** @typedef {(analyses: Analyses, result: Result, tell: import('../mesh-fit.js').Tell) => Promise<ViewContent>} View */

/** Functions that prepare the views, by their names. @type {Record<string, View>} */
const VIEWS = { gaussian, kappa2, rulings, patches, photo, sheet: flat };

/**
 * @param {Session} session
 * @param {Analyses} analyses
 * @param {(shown: Partial<ViewContent>) => void} show
 */
export function analysisPanel(session, analyses, show) {
  const radios = elements('input[name="view"]', HTMLInputElement);
  const panel = element('analysis', HTMLElement);
  const about = element('about-view', HTMLElement);
  const description = element('view-says', HTMLElement);
  const [picture] = elements('.picture', HTMLElement);
  /** Number of the newest update; answers to older ones are discarded. */
  let newestUpdate = 0;

  const chosen = () => radios.find((radio) => radio.checked)?.value ?? 'shaded';

  /** @param {Partial<ViewContent>} shown */
  const display = (shown) => {
    show(shown);
    about.replaceChildren(...aboutView(shown));
    description.textContent = chosen() === 'shaded' || session.result ? VIEW_WORDS[chosen()] : '';
    picture.removeAttribute('aria-busy');
    panel.dataset.view = chosen();
    panel.setAttribute('aria-busy', 'false');
  };

  const update = async () => {
    const turn = ++newestUpdate;
    const { result } = session;
    const name = chosen();
    display({});
    panel.hidden = name === 'shaded';
    waiting.end();
    if (name === 'shaded') return;
    if (!result) {
      about.textContent = 'Appears when a run has ended.';
      return;
    }
    panel.setAttribute('aria-busy', 'true');
    picture.setAttribute('aria-busy', 'true');
    description.textContent = '';
    waiting.begin(TASK_WORDS.view);
    try {
      const shown = await VIEWS[name](analyses, result, waiting.tell);
      if (turn !== newestUpdate) return;
      waiting.end();
      display(shown);
    } catch (error) {
      if (turn !== newestUpdate) return;
      waiting.end();
      display({});
      session.fail('This view could not be worked out', error);
    }
  };

  const waiting = waitingPanel(element('waiting', HTMLElement), () => {
    newestUpdate++;
    analyses.stop();
    waiting.end();
    const again = make('button', '', 'Try again');
    again.type = 'button';
    again.addEventListener('click', () => void update());
    display({ about: [make('p', 'muted', 'Cancelled.'), again] });
    again.focus();
  });
  /** Cancels the analyses of the last result or view, and prepares the present one. */
  const restart = () => {
    analyses.stop();
    void update();
  };
  for (const radio of radios) radio.addEventListener('change', restart);
  session.on('input', (input) => {
    element('view-photo', HTMLElement).hidden = !hasColours(input);
    if (chosen() === 'photo' && !hasColours(input)) radios[0].click();
  });
  session.on('result', restart);
  session.on('cleared', restart);
  /** Shows a view. @param {string} view */
  const choose = (view) => {
    for (const radio of radios) radio.checked = radio.value === view;
    restart();
  };
  return { choose };
}
