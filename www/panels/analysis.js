/** The switch between views of the result, and what stands below them. */
import { element, elements, make } from '../dom.js';
import { gaussian, kappa2 } from '../views/curvature.js';
import { dewarped, photoPicture } from '../views/dewarped.js';
import { patches } from '../views/patches.js';
import { hasColours, photo as coloured } from '../views/photo.js';
import { flat as laidFlat } from '../views/pieces.js';
import { rulings } from '../views/rulings.js';
import { VIEWS as VIEWS_SAY } from '../messages.js';
import { photoPanel } from './photo.js';
import { waitingPanel } from './waiting.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Result, Session} from '../session.js' */
/** @import {Shown} from '../views/shown.js' */
/** @typedef {(analyses: Analyses, result: Result) => Promise<Shown>} View */

/** Milliseconds for a vertex, until that was measured. */
const EACH = 0.005;
/** @type {Record<string, View>} */
const VIEWS = { gaussian, kappa2, rulings, patches, photo: coloured, sheet: laidFlat };

/**
 * @param {Session} session
 * @param {Analyses} analyses
 * @param {(shown: Partial<Shown>) => void} show
 */
export function analysisPanel(session, analyses, show) {
  const radios = elements('input[name="view"]', HTMLInputElement);
  const panel = element('analysis', HTMLElement);
  const about = element('about-view', HTMLElement);
  const says = element('view-says', HTMLElement);
  /** Counts what was asked for, to tell the newest. */
  let asked = 0;

  const chosen = () => radios.find((radio) => radio.checked)?.value ?? 'shaded';

  /** @param {Partial<Shown>} shown */
  const put = (shown) => {
    show(shown);
    about.replaceChildren(...(shown.about ?? []));
    panel.dataset.view = chosen();
    panel.setAttribute('aria-busy', 'false');
  };

  /** What is shown now: while it is only worked out anew it stays, with its handles. */
  let present = '';
  /** @type {Result | null} */
  let presentOf = null;

  const update = async () => {
    const turn = ++asked;
    const { result } = session;
    const name = chosen();
    says.textContent = VIEWS_SAY[name] ?? '';
    const anew = present === name && presentOf === result;
    [present, presentOf] = [name, result];
    photo.made(null);
    if (!anew) {
      photo.show(name === 'dewarped');
      put({});
    }
    panel.hidden = name === 'shaded';
    waiting.end();
    if (name === 'shaded') return;
    if (!result) {
      about.textContent = 'Appears when a run has ended.';
      return;
    }
    panel.setAttribute('aria-busy', 'true');
    if (!anew) about.replaceChildren();
    const slow = { words: 'Preparing this view', kind: name, size: result.surface.heights.length, each: EACH };
    waiting.begin(slow);
    try {
      const shown = await (name === 'dewarped' ? flat(result) : VIEWS[name](analyses, result));
      if (turn !== asked) return;
      waiting.end(slow);
      put(shown);
    } catch (error) {
      if (turn !== asked) return;
      waiting.end();
      // The photo stays, with what may be wrong on it.
      const wish = name === 'dewarped' ? await photo.wish(result).catch(() => null) : null;
      put(wish ? { before: photoPicture(wish.photo) } : {});
      session.fail('This view could not be worked out', error);
    }
  };

  /** @param {Result} result @returns {Promise<Partial<Shown>>} */
  const flat = async (result) => {
    const turn = asked;
    const wish = await photo.wish(result);
    if (!wish) return { about: [make('p', 'muted', 'Open a photo that shows what the heights show: from above, or for depths from the same place. It may have more pixels.')] };
    const shown = await dewarped(analyses, result, wish.photo, wish.options);
    if (turn === asked) photo.made(shown.flat);
    return shown;
  };

  const waiting = waitingPanel(element('waiting', HTMLElement), () => {
    asked++;
    analyses.stop();
    waiting.end();
    const again = make('button', '', 'Try again');
    again.type = 'button';
    again.addEventListener('click', () => void update());
    put({ about: [make('p', 'muted', 'Cancelled.'), again] });
    again.focus();
  });
  const photo = photoPanel(session, analyses, () => void update());
  /** What has begun for another result is of no use. */
  const renew = () => {
    analyses.stop();
    void update();
  };
  for (const radio of radios) radio.addEventListener('change', renew);
  session.on('input', (input) => {
    const own = element('view-photo', HTMLElement);
    own.hidden = !hasColours(input);
    if (own.hidden && chosen() === 'photo') radios[0].click();
  });
  session.on('result', renew);
  session.on('cleared', renew);
  /** @param {string} view */
  const choose = (view) => {
    for (const radio of radios) radio.checked = radio.value === view;
    renew();
  };
  return {
    choose,
    /** Makes a photo of the result flat. @param {string} name @param {ImageData} image */
    usePhoto(name, image) {
      photo.use(name, image);
      choose('dewarped');
    },
  };
}
