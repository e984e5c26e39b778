/** The flat page: its verdict, figures and files. */
import { stemOf } from '../file-kinds.js';
import { element, make } from '../dom.js';
import { capitalised, number, percent } from '../format.js';
import { flattenWholePhoto } from '../page/flatten.js';
import { PAPERS, pictureFiles, similarPaper, turnPicture } from '../page/paper.js';
import { imagePicture, PictureView } from '../surface/picture-view.js';
import { canvasFromImage } from '../surface/layer.js';
import { figures } from '../views/legend.js';
import { BATCH_WORDS, FORMAT_WORDS, SAVE_WORDS, TASK_WORDS } from '../messages.js';
import { BOOK_WORDS, PAGE_WORDS, pageCautions, pageErrors, pageVerdict } from '../page/messages.js';
import { zipOf } from '../zip.js';
import { dividerOver } from './divider.js';
import { offerToSave } from './save-dialog.js';
import { PROGRESS_DELAY_MS, waitingPanel } from './waiting.js';

/** @import {Book} from '../page/book.js' */
/** @import {PaperName} from '../page/paper.js' */
/** @import {Format} from './save-dialog.js' */

/**
 * @param {Api} api
 * @param {PageSession} session
 * @param {Book} book the photos that are open
 * @param {() => void} onWritten called when a PDF was written, which may lack some photos
 */
export function pageResultPanel(api, session, book, onWritten) {
  const figure = element('flat-view', HTMLElement);
  const view = new PictureView(element('flat-canvas', HTMLCanvasElement));
  const divider = dividerOver('flat-divider', ['photo', 'flat page'], () => view.repaint(), 0);
  const empty = element('flat-empty', HTMLElement);
  const verdict = element('flat-verdict', HTMLElement);
  const detail = element('flat-detail', HTMLElement);
  const side = element('page-side', HTMLElement);
  const about = element('flat-about', HTMLElement);
  const facts = element('flat-facts', HTMLElement);
  const proposal = element('format-proposal', HTMLButtonElement);
  const caption = element('flat-caption', HTMLElement);
  const save = element('page-save', HTMLButtonElement);
  /** @type {DewarpedPage | null} */
  let shown = null;
  /** The last verdict, and the details below it. */
  let said = [verdict.textContent ?? '', ''];
  let isMoving = false;
  let workingTimer = 0;
  /** Whether text is recognised in the PDF. */
  let wantsText = false;
  /** The reduced photo, once it is needed. @type {Picture | null} */
  let before = null;
  /** Whether the divider has shown that there is a photo behind it. */
  let wasCompared = false;

  const flattening = waitingPanel(element('flattening', HTMLElement), undefined, PROGRESS_DELAY_MS);
  session.on('progress', (fraction) => {
    if (fraction === 0) flattening.begin('flattening');
    else flattening.tell({ fraction });
  });
  /** @param {string} sentence @param {string} [details] */
  const say = (sentence, details = '') => {
    clearTimeout(workingTimer);
    [verdict.textContent, detail.textContent] = said = [sentence, details];
  };
  /** Whether there is a flat page of this photo, or may be one of another. */
  const isSavable = () => shown !== null || book.photos.some(({ file, state }) => file !== session.photo?.file && state?.traces !== null);
  /** Removes the flat page. @param {string} message shown in its place */
  const clear = (message) => {
    shown = null;
    view.show(null);
    divider.show(false);
    empty.hidden = false;
    empty.textContent = message;
    caption.textContent = '';
    about.replaceChildren();
    facts.hidden = proposal.hidden = true;
    save.disabled = !isSavable();
  };
  session.on('photo', ({ file }) => {
    before = null;
    element('page-examples', HTMLElement).hidden = file !== undefined;
    clear('');
    say(`${TASK_WORDS.flattening}…`);
  });
  session.on('outline', ({ moving }) => {
    isMoving = moving;
    // The layout of the page does not change during a drag.
    if (!moving) side.dataset.state = session.unplacedCorners > 0 ? 'unfound' : 'found';
  });
  session.on('working', (working) => {
    figure.setAttribute('aria-busy', String(working));
    clearTimeout(workingTimer);
    flattening.end();
    if (!working) [verdict.textContent, detail.textContent] = said;
    if (isMoving) return;
    save.disabled = working || !isSavable();
    // Until the new flat page is there, nothing is said of the old one.
    if (!working) return;
    workingTimer = window.setTimeout(() => {
      [verdict.textContent, detail.textContent, caption.textContent] = [`${TASK_WORDS.flattening}…`, '', ''];
      about.replaceChildren();
      proposal.hidden = true;
    }, PROGRESS_DELAY_MS);
  });
  session.on('unfound', () => {
    clear(PAGE_WORDS.unfoundFlat);
    say(PAGE_WORDS.unfound, PAGE_WORDS.unplaced(session.unplacedCorners));
  });
  session.on('flat', ({ flat, moving }) => {
    shown = flat;
    const { report } = flat;
    const { width, height, data } = turnPicture(flat, session.quarters);
    const reduced = session.photo?.reduced;
    before ??= reduced ? imagePicture(canvasFromImage(reduced), 'The photo') : null;
    const after = imagePicture(canvasFromImage(new ImageData(data, width, height)), 'The page made flat');
    view.show({ ...after, paint: (context, ratio) => {
      after.paint(context, ratio);
      if (before && divider.share > 0) paintBefore(context, before, divider.share, ratio);
    } });
    divider.show(before !== null);
    if (before && !wasCompared) divider.glide();
    wasCompared ||= before !== null;
    empty.hidden = true;
    // The result of a drag that is over already must not be saved in place of the final one.
    if (moving && isMoving) save.disabled = false;
    // During a drag the page is flattened without its lines of text, so that the figures would differ.
    if (moving) return;
    caption.textContent = flat.unit === 'mm' ? sizeOf(flat, session.quarters) : '';
    const cautions = pageCautions({ outside: session.outsideCorners, weak: session.weakEdges });
    const lightNote = flat.light === 'keep' && session.options.light !== 'keep' ? [PAGE_WORDS.keptLight] : [];
    say(pageVerdict(report), [...cautions, pageErrors(report, flat.unit === 'mm' ? flat.size[0] / session.outline.pages : undefined), ...lightNote].filter(Boolean).join(' '));
    facts.hidden = false;
    const similar = flat.unit === 'mm' ? null : similarPaper(flat.size[0] / session.outline.pages, flat.size[1]);
    proposal.hidden = similar === null;
    if (similar) [proposal.value, proposal.textContent] = [similar, PAGE_WORDS.looksLike(SAVE_WORDS.papers[similar])];
    about.replaceChildren(figures(factsOf(flat, session.quarters, session.photo)));
  });
  session.on('problem', (error) => {
    clear(PAGE_WORDS.noFlat);
    say(PAGE_WORDS.unflattened, errorSentence(error));
  });

  save.addEventListener('click', () => {
    const [wish, found] = [session.request(), shown];
    if (!wish) return;
    const { outline: { pages }, quarters } = session;
    const measured = found?.unit === 'mm';
    const [wide, high] = found ? [found.size[0] / pages, found.size[1]] : [0, 0];
    const similar = similarPaper(wide, high);
    const paper = make('select', '', ...(measured ? [new Option(SAVE_WORDS.trueSize(sizeOf(/** @type {DewarpedPage} */ (found), quarters)), '')] : []),
      ...Object.entries(SAVE_WORDS.papers).filter(([name]) => !name.endsWith('-wide')).map(([name, words]) => new Option(words, name)));
    paper.value = measured ? '' : similar?.replace('-wide', '') ?? 'a4';
    const text = Object.assign(make('input', ''), { type: 'checkbox', checked: wantsText });
    const several = book.photos.length > 1;
    const title = several ? stemOf(book.photos[0].file) : wish.photo.name;
    const status = element('save-size', HTMLElement);
    const chosenPaper = () => (paper.value === '' ? null : PAPERS[/** @type {PaperName} */ (paper.value)]);
    /** @param {PackageWorker} worker @param {AbortSignal} signal @param {boolean} [withText] */
    const flatBook = (worker, signal, withText = false) => book.flatPages(api, worker, chosenPaper(), withText, signal, (done) => {
      status.textContent = BOOK_WORDS.writing(done + 1, book.photos.length);
    }).finally(onWritten);
    const ofBook = several ? { stem: `${title}-pages`, note: () => BATCH_WORDS.without(book.problems()) } : {};
    /** The flat page with all pixels of the photo, which is made once for all formats. @type {FlatPage | null} */
    let flat = null;
    /** @param {'png' | 'jpeg'} format */
    const writeImage = (format) => async (/** @type {PackageWorker} */ worker) => {
      flat ??= await flattenWholePhoto(worker, wish, /** @type {DewarpedPage} */ (found));
      return worker.writePhoto({ ...flat, ...turnPicture(flat, quarters) }, { format });
    };
    const offer = offerToSave(api, {
      title: 'Flat page',
      stem: `${wish.photo.name}-flat`,
      formats: [
        { value: 'pdf', name: 'PDF', ...ofBook, words: several ? BOOK_WORDS.pdf(book.photos.length) : pages > 1 ? SAVE_WORDS.pdfOfTwo : SAVE_WORDS.pdf, type: 'application/pdf', write: async (worker, signal) => {
          if (several) return worker.writeBook(await flatBook(worker, signal, text.checked), { title });
          flat ??= await flattenWholePhoto(worker, wish, /** @type {DewarpedPage} */ (found));
          return worker.writeBook(await pictureFiles(worker, flat, pages, quarters, chosenPaper(), { ink: wish.options.ink, text: text.checked }), { title });
        } },
        ...(several ? [/** @type {Format} */ ({ value: 'zip', name: 'ZIP', ...ofBook, words: BOOK_WORDS.zip, type: 'application/zip', write: async (worker, signal) =>
          zipOf(Object.fromEntries((await flatBook(worker, signal)).map(({ picture, ending }, i) => [`${title}-${i + 1}.${ending}`, picture]))) })] : []),
        ...(found ? [/** @type {Format} */ ({ value: 'jpg', name: 'JPEG', words: FORMAT_WORDS.jpg, type: 'image/jpeg', write: writeImage('jpeg') }), /** @type {Format} */ ({ value: 'png', name: 'PNG', words: FORMAT_WORDS.png, type: 'image/png', write: writeImage('png') })] : []),
      ],
      extra: [make('label', 'field for-pdf', SAVE_WORDS.paper(similar !== null && !measured ? SAVE_WORDS.papers[similar] : ''), paper), make('label', 'check for-pdf', text, SAVE_WORDS.searchable)],
    });
    for (const field of [paper, text]) field.addEventListener('change', () => {
      wantsText = text.checked;
      offer.renew();
    });
  });
  proposal.addEventListener('click', () => {
    const format = element('page-format', HTMLSelectElement);
    format.value = proposal.value;
    format.dispatchEvent(new Event('change'));
    format.focus();
  });
}

/** Paints a picture over a share of a canvas, at its left. @param {CanvasRenderingContext2D} context @param {Picture} picture @param {number} share @param {number} ratio device pixels per CSS pixel */
function paintBefore(context, picture, share, ratio) {
  const zoomed = context.getTransform();
  context.resetTransform();
  context.beginPath();
  context.rect(0, 0, share * context.canvas.width, context.canvas.height);
  context.clip();
  context.fillStyle = getComputedStyle(context.canvas.parentElement ?? context.canvas).backgroundColor;
  context.fill();
  context.setTransform(zoomed);
  picture.paint(context, ratio);
}

/** Size of the flat page in words. @param {DewarpedPage} flat @param {number} quarters number of quarter turns */
function sizeOf({ size, unit }, quarters) {
  const [wide, high] = quarters % 2 === 0 ? size : size.toReversed();
  return unit === 'mm' ? `${number(wide, 4)} × ${number(high, 4)} mm` : `${number(wide / high, 3)} : 1`;
}

/**
 * Figures of the flat page: names and values.
 * @param {DewarpedPage} flat
 * @param {number} quarters number of quarter turns
 * @param {PagePhoto | null} photo
 * @returns {[string, string][]}
 */
function factsOf(flat, quarters, photo) {
  const { verdict, error, errorBound, focalLength, linesFound, linesDisagreement } = flat.report;
  const { scale = 1, film35 } = photo ?? {};
  const isOtherKind = verdict === 'notThisKind';
  return [
    ['Likely error', isOtherKind ? '–' : `${percent(error / 100)} of the width`],
    ['95 % limit', isOtherKind ? '–' : percent(errorBound / 100)],
    ...(linesFound === 0 ? [] : [/** @type {[string, string]} */ (['Lines of text', `${linesFound} found, off by ${percent(linesDisagreement / 100)}`])]),
    ['Focal length', `${number(focalLength / scale, 4)} pixels, ${film35 === undefined ? 'by the perspective' : 'as the photo’s file says'}`],
    [flat.unit === 'mm' ? 'Size' : 'Width to height', sizeOf(flat, quarters)],
  ];
}

/** The message of an error as a sentence. @param {unknown} error */
function errorSentence(error) {
  const message = error instanceof Error ? error.message : String(error);
  const [, edge] = /the (\w+) edge has a point at .* outside of the photo/.exec(message) ?? [];
  return `${capitalised(edge ? PAGE_WORDS.tooFarOutside(edge) : message).replace(/\.$/, '')}.`;
}
