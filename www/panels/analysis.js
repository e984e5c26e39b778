/** Choice of a view of the result, and the text below it. */
import { element, elements, make } from '../dom.js';
import { gaussian, kappa2 } from '../views/curvature.js';
import { dewarped } from '../views/dewarped.js';
import { patches } from '../views/patches.js';
import { hasColours, photo as coloured } from '../views/photo.js';
import { flat as laidFlat } from '../views/pieces.js';
import { rulings } from '../views/rulings.js';
import { TASK_WORDS, VIEW_WORDS } from '../messages.js';
import { photoPanel } from './photo.js';
import { waitingPanel } from './waiting.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result, Session} from '../session.js' */
/** @import {ViewContent} from '../views/view-content.js' */
/** @typedef {(analyses: Analyses, result: Result, tell: import('../mesh-fit.js').Tell) => Promise<ViewContent>} View */

/** Functions that prepare the views, by their names. @type {Record<string, View>} */
const VIEWS = { gaussian, kappa2, rulings, patches, photo: coloured, sheet: laidFlat };

/**
 * @param {Session} session
 * @param {Analyses} analyses
 * @param {(shown: Partial<ViewContent>) => void} show
 */
export function analysisPanel(session, analyses, show) {
  const radios = elements('input[name="view"]', HTMLInputElement);
  /** The choice of a flat photo, which is offered where there is one to flatten. */
  const flatPhoto = element('view-dewarped', HTMLElement);
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
    about.replaceChildren(...(shown.about ?? []));
    const isReady = chosen() === 'shaded' || presentResult !== null;
    description.textContent = isReady ? VIEW_WORDS[chosen()] ?? '' : '';
    picture.removeAttribute('aria-busy');
    panel.dataset.view = chosen();
    panel.setAttribute('aria-busy', 'false');
  };

  /** Name of the present view: it stays, with its handles, while it is only computed again. */
  let presentView = '';
  /** Result of the present view. @type {Result | null} */
  let presentResult = null;

  const update = async () => {
    const turn = ++newestUpdate;
    const { result } = session;
    const name = chosen();
    const isSameView = presentView === name && presentResult === result;
    [presentView, presentResult] = [name, result];
    photo.setFlat(null);
    if (!isSameView) {
      photo.show(name === 'dewarped');
      display({});
    }
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
    if (!isSameView) about.replaceChildren();
    waiting.begin(TASK_WORDS.view);
    try {
      const shown = await (name === 'dewarped' ? dewarpedView(result) : VIEWS[name](analyses, result, waiting.tell));
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

  /** @param {Result} result @returns {Promise<Partial<ViewContent>>} */
  const dewarpedView = async (result) => {
    const turn = newestUpdate;
    const request = await photo.dewarpRequest(result);
    if (!request) return { about: [make('p', 'muted', 'Open a photo that shows what the heights show: from above, or for depths from the same place. It may have more pixels.')] };
    const shown = await dewarped(analyses, result, request.photo, request.options);
    if (turn === newestUpdate) photo.setFlat(shown.flat);
    return shown;
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
  const photo = photoPanel(session, () => void update());
  /** Cancels the analyses of the last result or view, and prepares the present one. */
  const restart = () => {
    analyses.stop();
    void update();
  };
  for (const radio of radios) radio.addEventListener('change', restart);
  session.on('input', (input) => {
    element('view-photo', HTMLElement).hidden = !hasColours(input);
    flatPhoto.hidden = !(input.photo || input.lattice?.uvs || chosen() === 'dewarped');
    if (chosen() === 'photo' && !hasColours(input)) radios[0].click();
  });
  session.on('result', restart);
  session.on('cleared', restart);
  /** Shows a view. @param {string} view */
  const choose = (view) => {
    if (view === 'dewarped') flatPhoto.hidden = false;
    for (const radio of radios) radio.checked = radio.value === view;
    restart();
  };
  return {
    choose,
    /** Dewarps a photo of the result. @param {string} name @param {ImageData} image */
    usePhoto(name, image) {
      photo.setPhoto(name, image);
      choose('dewarped');
    },
  };
}
