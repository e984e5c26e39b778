/** Input and result in space, or pictures in their place. */
import { download, element, elements } from '../dom.js';
import { number, shortLambda } from '../format.js';
import { PictureView } from '../surface/picture-view.js';
import { heldInWords } from '../messages.js';
import { key } from '../views/legend.js';
import { spacePanel } from './space.js';

/** @import {Input, Session} from '../session.js' */
/** @import {PixelMarks} from '../surface/layer.js' */
/** @import {ViewContent} from '../views/view-content.js' */

/** @param {Session} session */
export function viewsPanel(session) {
  const space = spacePanel(session);
  const stage = element('space', HTMLElement);
  const pictures = element('views', HTMLElement);
  const [photo, flat] = ['input-picture', 'result-picture'].map((id) => new PictureView(element(id, HTMLCanvasElement)));
  const inputCaption = element('input-caption', HTMLElement);
  const caption = element('result-caption', HTMLElement);
  const stamp = element('result-mark', HTMLElement);
  const legend = element('input-legend', HTMLElement);
  const save = element('view-save', HTMLButtonElement);
  const reading = element('flat-reading', HTMLElement);
  const arrangement = element('arrangement', HTMLElement);
  const arrangements = elements('input[name="arrangement"]', HTMLInputElement);
  /** Content of the current view that is drawn over the surfaces, or in their place. @type {Partial<ViewContent>} */
  let present = {};

  flat.canvas.addEventListener('pointermove', (event) => (reading.textContent = flat.read(event)));
  flat.canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  /** Shows the surfaces, or pictures in their places. */
  const arrange = () => {
    const { before, after, unfolding } = present;
    arrangement.hidden = !after || !unfolding;
    const isInSpace = !after || (unfolding !== undefined && arrangements[1].checked);
    stage.hidden = !isInSpace;
    element('unfold-field', HTMLElement).hidden = !unfolding || !isInSpace;
    pictures.hidden = reading.hidden = element('picture-hint', HTMLElement).hidden = isInSpace;
    for (const tools of elements('.space-tools', HTMLElement)) tools.hidden = !isInSpace;
    element('space-hint', HTMLElement).hidden = !isInSpace;
    element('input-view', HTMLElement).hidden = !before;
    if (isInSpace) space.drawnCanvas();
    if (isInSpace && unfolding) space.animateUnfolding();
    updateSave();
  };
  /** Enables the button that saves the picture if there is one. */
  const updateSave = () => {
    save.disabled = !session.result || (space.isShown() && space.isMissing());
  };
  for (const radio of arrangements) radio.addEventListener('change', arrange);

  session.on('input', (input) => {
    const { name, width, height } = input;
    pictures.style.setProperty('--aspect', String(width / height));
    inputCaption.textContent = `${name}, ${number(width, 6)} × ${number(height, 6)}`;
    const marks = marksOf(input);
    space.setMarks(marks);
    legend.replaceChildren(...(marks ? [key(marks.colour, heldInWords(marks.pixels.length))] : []));
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

  /**
   * Shows layers over the surfaces, or pictures in their places.
   * @param {Partial<ViewContent>} shown
   */
  return (shown) => {
    const { before, after } = shown;
    present = shown;
    arrange();
    space.show(shown);
    photo.show(before ?? null);
    flat.show(after ?? null);
    element('result-title', HTMLElement).textContent = after?.title ?? '';
  };
}

/**
 * The pixels whose heights a design passes through; none of other inputs.
 * @param {Input} input
 * @returns {PixelMarks | null}
 */
function marksOf({ width, height, data, design }) {
  if (!design) return null;
  const pixels = [...data.keys()].filter((i) => !Number.isNaN(data[i]));
  return { width, height, pixels, colour: getComputedStyle(document.body).getPropertyValue('--mark-held').trim() };
}
