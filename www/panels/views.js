/** Input and result in space, or pictures in their place. */
import { download, element, elements } from '../dom.js';
import { number, shortLambda } from '../format.js';
import { gridOf, nearestVertices } from '../surface/lattice.js';
import { PictureView } from '../surface/picture-view.js';
import { Zoom } from '../surface/zoom.js';
import { MARK_WORDS } from '../messages.js';
import { key } from '../views/legend.js';
import { spacePanel } from './space.js';

/** @import {Occlusions} from '../api.js' */
/** @import {Input, Session} from '../session.js' */
/** @import {PixelMarks} from '../surface/layer.js' */
/** @import {ViewContent} from '../views/view-content.js' */

/** Confidence below which heights are marked. */
const MAX_MARKED_CONFIDENCE = 0.5;

/** @param {Session} session */
export function viewsPanel(session) {
  const space = spacePanel(session);
  const stage = element('space', HTMLElement);
  const pictures = element('views', HTMLElement);
  const over = element('photo-over', HTMLElement);
  const photoZoom = new Zoom();
  const photo = new PictureView(element('input-picture', HTMLCanvasElement), photoZoom, over);
  photoZoom.onChange(() => {
    const { scale, shift } = photoZoom;
    for (const [name, value] of Object.entries({ zoom: scale, across: shift.x, down: shift.y })) over.style.setProperty(`--${name}`, String(value));
  });
  session.on('cleared', () => photoZoom.reset());
  // A handle that gets the keyboard focus outside of the visible part resets the zoom.
  over.addEventListener('focusin', ({ target }) => {
    const [knob, frame] = [target, over.parentElement].map((one) => (one instanceof Element ? one.getBoundingClientRect() : new DOMRect()));
    const isVisible = knob.right > frame.left && knob.left < frame.right && knob.bottom > frame.top && knob.top < frame.bottom;
    if (!isVisible) photoZoom.reset();
  });
  const flat = new PictureView(element('result-picture', HTMLCanvasElement), new Zoom());
  const inputCaption = element('input-caption', HTMLElement);
  const caption = element('result-caption', HTMLElement);
  const stamp = element('result-mark', HTMLElement);
  const legend = element('input-legend', HTMLElement);
  const save = element('view-save', HTMLButtonElement);
  const reading = element('flat-reading', HTMLElement);
  const arrangement = element('arrangement', HTMLElement);
  const arrangements = elements('input[name="arrangement"]', HTMLInputElement);
  /** @type {Occlusions | null} */
  let occlusions = null;
  /** Content of the current view that is drawn over the surfaces, or in their place. @type {Partial<ViewContent>} */
  let present = {};

  flat.canvas.addEventListener('pointermove', (event) => (reading.textContent = flat.read(event)));
  flat.canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  /** Shows the surfaces, or pictures in their places. */
  const arrange = () => {
    const { before, after, unfolding } = present;
    arrangement.hidden = !after || !unfolding;
    const isInSpace = !after || (unfolding !== undefined && arrangements[0].checked);
    stage.hidden = !isInSpace;
    element('unfold-field', HTMLElement).hidden = !unfolding || !isInSpace;
    pictures.hidden = reading.hidden = element('picture-hint', HTMLElement).hidden = isInSpace;
    for (const tools of elements('.space-tools', HTMLElement)) tools.hidden = !isInSpace;
    element('space-hint', HTMLElement).hidden = !isInSpace;
    element('input-view', HTMLElement).hidden = !before;
    if (isInSpace) space.drawnCanvas();
    updateSave();
  };
  /** Enables the button that saves the picture if there is one. */
  const updateSave = () => {
    save.disabled = !session.result || (space.isShown() && space.isMissing());
  };
  for (const radio of arrangements) radio.addEventListener('change', arrange);

  const updateMarks = () => {
    const { input } = session;
    const marks = input ? marksOf(input, occlusions, getComputedStyle(document.body)) : [];
    space.setMarks(marks);
    legend.replaceChildren(...marks.map(({ colour, words }) => key(colour, words)));
  };
  session.on('input', (input) => {
    const { name, width, height } = input;
    pictures.style.setProperty('--aspect', String(width / height));
    inputCaption.textContent = `${name}, ${number(width, 6)} × ${number(height, 6)}`;
    occlusions = null;
    updateMarks();
  });
  session.on('occlusions', (found) => {
    occlusions = found;
    updateMarks();
  });
  /** @param {Input} input @param {number} lambda @param {string} mark */
  const describe = (input, lambda, mark) => {
    // λ has no effect on a design.
    caption.textContent = input.design ? '' : `λ = ${shortLambda(lambda)}`;
    stamp.textContent = mark;
    stamp.hidden = !mark;
  };
  session.on('preview', ({ input, lambda }) => describe(input, lambda, 'preview'));
  const describeResult = () => {
    const { result } = session;
    if (result) describe(result.input, result.surface.report.lambda, result.surface.report.stopReason === 'cancelled' ? 'cancelled' : '');
  };
  session.on('result', describeResult);
  // The last result replaces the previews.
  session.on('unsolved', describeResult);

  save.addEventListener('click', async () => {
    const shown = space.isShown() ? [space.drawnCanvas(2 * devicePixelRatio)] : elements('#views canvas', HTMLCanvasElement).filter((canvas) => canvas.checkVisibility());
    const picture = new OffscreenCanvas(shown.reduce((sum, { width }) => sum + width, 0), Math.max(...shown.map(({ height }) => height)));
    const context = picture.getContext('2d');
    if (!context) return;
    context.fillStyle = getComputedStyle(document.body).getPropertyValue('--well').trim();
    context.fillRect(0, 0, picture.width, picture.height);
    let left = 0;
    for (const canvas of shown) {
      context.drawImage(canvas, left, 0);
      left += canvas.width;
    }
    download(await picture.convertToBlob({ type: 'image/png' }), 'image/png', `${session.input?.name ?? 'view'}-view.png`);
  });
  session.on('result', updateSave);
  session.on('cleared', updateSave);
  arrange();

  return {
    space,
    /**
     * Shows layers over the surfaces, or pictures in their places.
     * @param {Partial<ViewContent>} shown
     */
    show: (shown) => {
      const { before, after } = shown;
      present = shown;
      arrange();
      space.show(shown);
      photo.show(before ?? null);
      flat.show(after ?? null);
      element('result-title', HTMLElement).textContent = after?.title ?? '';
    },
  };
}

/**
 * Marks on the input: low confidence, occlusions and constraints.
 * @param {Input} input
 * @param {Occlusions | null} occlusions
 * @param {CSSStyleDeclaration} style
 * @returns {(PixelMarks & { words: string })[]}
 */
function marksOf(input, occlusions, style) {
  const { width, height, data, design, confidence, constraints } = input;
  const constrained = design ? data : constraints;
  /** @param {string} name @param {(pixel: number) => boolean} has @param {(number: number) => string} words */
  const marks = (name, has, words) => {
    /** @type {number[]} */
    const pixels = [];
    const count = width * height;
    for (let i = 0; i < count; i++) if (has(i)) pixels.push(i);
    return { width, height, pixels, colour: style.getPropertyValue(name).trim(), words: words(pixels.length) };
  };
  const found = [];
  if (confidence) found.push(marks('--mark-doubt', (i) => confidence[i] < MAX_MARKED_CONFIDENCE && !Number.isNaN(data[i]), MARK_WORDS.doubted));
  const flags = occlusions && (occlusions.image ?? nearestVertices(occlusions, gridOf(input)).map((vertex) => occlusions.vertices[vertex] ?? 0));
  if (occlusions && flags) found.push({ ...marks('--mark-torn', (i) => flags[i] !== 0, String), words: MARK_WORDS.torn(occlusions.count) });
  if (constrained) found.push(marks('--mark-held', (i) => !Number.isNaN(constrained[i]), MARK_WORDS.held));
  return found;
}
