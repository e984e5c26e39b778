/** The flat page beside its photo: what it is worth in words, its figures, and its files. */
import { element } from '../dom.js';
import { degrees, number, percent } from '../format.js';
import { whole } from '../page/flatten.js';
import { imagePicture, PictureView } from '../surface/picture.js';
import { Zoom } from '../surface/zoom.js';
import { canvasOf } from '../views/dewarped.js';
import { figures } from '../views/legend.js';
import { pageErrors, pageVerdict } from '../messages.js';
import { offerToSave } from './save-dialog.js';

/** @import {Api} from '../api.js' */
/** @import {Worker} from '../worker-task.js' */
/** @import {DewarpedPage} from '../page/flatten.js' */
/** @import {PageSession} from '../page/session.js' */

/**
 * @param {Api} api
 * @param {PageSession} session
 * @param {(flat: DewarpedPage, name: string) => void} goOn with the page as a surface
 */
export function pageResultPanel(api, session, goOn) {
  const figure = element('flat-view', HTMLElement);
  const view = new PictureView(element('flat-canvas', HTMLCanvasElement), new Zoom());
  const empty = element('flat-empty', HTMLElement);
  const verdict = element('flat-verdict', HTMLElement);
  const detail = element('flat-detail', HTMLElement);
  const about = element('flat-about', HTMLElement);
  const caption = element('flat-caption', HTMLElement);
  const save = element('page-save', HTMLButtonElement);
  const surface = element('flat-surface', HTMLButtonElement);
  /** @type {DewarpedPage | null} */
  let shown = null;

  /** @param {boolean} ready */
  const enable = (ready) => {
    save.disabled = surface.disabled = !ready;
  };
  session.on('photo', () => {
    shown = null;
    view.show(null);
    empty.hidden = false;
    empty.textContent = 'Working it out…';
    caption.textContent = '';
    about.replaceChildren();
    enable(false);
  });
  session.on('working', (working) => figure.setAttribute('aria-busy', String(working)));
  session.on('flat', (flat) => {
    shown = flat;
    const { width, height, data, report } = flat;
    view.show(imagePicture(canvasOf(new ImageData(data, width, height)), 'Flat', 'The page made flat'));
    empty.hidden = true;
    caption.textContent = flat.unit === 'mm' ? sizeOf(flat) : '';
    verdict.textContent = pageVerdict(report);
    detail.textContent = pageErrors(report);
    about.replaceChildren(figures(factsOf(flat, session.photo?.grey.scale ?? 1)));
    enable(true);
  });
  session.on('problem', (error) => {
    shown = null;
    view.show(null);
    empty.hidden = false;
    empty.textContent = 'No flat page from these edges';
    caption.textContent = '';
    verdict.textContent = 'It cannot be made flat like this.';
    detail.textContent = sentence(error);
    about.replaceChildren();
    enable(false);
  });

  save.addEventListener('click', () => {
    const wish = session.wish();
    if (!wish || !shown) return;
    /** With all pixels of the photo: made once for all formats. @type {DewarpedPage | null} */
    let flat = null;
    /** @param {'png' | 'jpeg' | 'pdf'} format */
    const written = (format) => async (/** @type {Worker} */ worker) => {
      flat ??= await whole(worker, wish);
      return worker.writePhoto(flat, { format });
    };
    offerToSave(api, {
      title: 'Flat page',
      stem: `${wish.photo.name}-flat`,
      size: wish.photo.width * wish.photo.height,
      formats: [
        { value: 'png', name: 'PNG', words: 'nothing is lost', type: 'image/png', write: written('png') },
        { value: 'jpg', name: 'JPEG', words: 'a smaller file', type: 'image/jpeg', write: written('jpeg') },
        {
          value: 'pdf', name: 'PDF', words: 'to print, in true size', type: 'application/pdf', write: written('pdf'),
          without: shown.unit === 'mm' ? undefined : 'of what size it is, a page format or a ruler would say',
        },
      ],
    });
  });
  surface.addEventListener('click', () => {
    if (shown) goOn(shown, session.photo?.name ?? 'page');
  });
}

/** @param {DewarpedPage} flat */
function sizeOf({ size: [wide, high], unit }) {
  return unit === 'mm' ? `${number(wide, 4)} × ${number(high, 4)} mm` : `${number(wide / high, 3)} : 1`;
}

/**
 * @param {DewarpedPage} flat
 * @param {number} scale pixels of the reduced photo for one of the whole one
 * @returns {[string, string][]}
 */
function factsOf(flat, scale) {
  const { verdict, error, pinholeErrorBound, focalLength, focalDeviation, tilt, bend, disagreement, residual, lines, linesFound } = flat.report;
  const wrong = verdict === 'notThisKind';
  return [
    ['Likely error', wrong ? '–' : `${percent(error / 100)} of the width`],
    ['In 95 of 100 cases below, if the lens does not distort', wrong ? '–' : percent(pinholeErrorBound / 100)],
    ['Edges disagree by', `${percent(disagreement / 100)} of the width`],
    ...(lines + linesFound === 0 ? [] : [/** @type {[string, string]} */ (['Lines of text', linesFacts(flat.report)])]),
    ['Points off the edges', `${number(residual / scale, 2)} pixels`],
    ['Bent by', degrees((bend * Math.PI) / 180)],
    ['Tilted by', degrees((tilt * Math.PI) / 180)],
    ['Focal length', `${number(focalLength / scale, 4)} pixels ± ${percent(focalDeviation / 100)}`],
    [flat.unit === 'mm' ? 'Size' : 'Width to height', sizeOf(flat)],
  ];
}

/** @param {DewarpedPage['report']} report */
function linesFacts({ lines, linesFound, linesUsed, linesDisagreement }) {
  const drawn = lines - linesUsed;
  const count = [...(linesFound > 0 ? [`${linesFound} found`] : []), ...(drawn > 0 ? [`${drawn} drawn`] : [])].join(', ');
  if (linesDisagreement > 0) return `${count}, off by ${percent(linesDisagreement / 100)}`;
  return `${count}, ${linesUsed < linesFound ? 'not used' : 'as the edges'}`;
}

/** @param {unknown} error */
function sentence(error) {
  const words = error instanceof Error ? error.message : String(error);
  return `${words[0].toUpperCase()}${words.slice(1).replace(/\.$/, '')}.`;
}
