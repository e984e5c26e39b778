/** Input and result side by side, under one light; or in space. */
import { download, element, elements } from '../dom.js';
import { number, heightReading, shortLambda } from '../format.js';
import { gridOf, nearestVertices } from '../surface/lattice.js';
import { inputNormals, resultImage, resultNormals } from '../surface/derived-data.js';
import { normalsOf } from '../surface/normals.js';
import { Light } from '../surface/light.js';
import { PictureView } from '../surface/picture-view.js';
import { SurfaceView } from '../surface/surface-view.js';
import { Zoom } from '../surface/zoom.js';
import { MARK_WORDS } from '../messages.js';
import { spacePanel } from './space.js';

/** @import {Occlusions} from '../api.js' */
/** @import {Input, Session} from '../session.js' */
/** @import {PixelMarks} from '../surface/marks.js' */
/** @import {ViewContent} from '../views/view-content.js' */

/** Confidence below which heights are marked. */
const MAX_MARKED_CONFIDENCE = 0.5;

/** @param {Session} session */
export function viewsPanel(session) {
  const light = new Light();
  const zoom = new Zoom();
  const before = new SurfaceView(element('input-canvas', HTMLCanvasElement), light, zoom);
  const after = new SurfaceView(element('result-canvas', HTMLCanvasElement), light, zoom);
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
  const space = spacePanel(session, light);
  const views = element('views', HTMLElement);
  const figure = element('result-view', HTMLElement);
  const inputCaption = element('input-caption', HTMLElement);
  const caption = element('result-caption', HTMLElement);
  const stamp = element('result-mark', HTMLElement);
  const empty = element('result-empty', HTMLElement);
  const legend = element('input-legend', HTMLElement);
  /** @type {Occlusions | null} */
  let occlusions = null;

  /** Content of the current view that is drawn over the surfaces, or in their place. @type {Partial<ViewContent>} */
  let present = {};
  const reading = element('flat-reading', HTMLElement);
  for (const [view, side] of /** @type {const} */ ([[before, 'input'], [after, 'result']])) {
    view.canvas.addEventListener('pointermove', (event) => {
      const { input, result } = session;
      const place = view.positionAt(event);
      const shown = side === 'result' ? result && resultImage(result) : input;
      if (!input || !shown || !place) {
        reading.textContent = '\u00a0';
        return;
      }
      const { width, height, pixelSize, left, top } = gridOf(input);
      const z = shown.data[Math.floor(place[1] * height) * width + Math.floor(place[0] * width)] * (side === 'input' ? input.heightScale : 1);
      reading.textContent = heightReading(z, input.unit, present[side]?.read?.(left + place[0] * width * pixelSize, top - place[1] * height * pixelSize)) || '\u00a0';
    });
    view.canvas.addEventListener('pointerleave', () => (reading.textContent = '\u00a0'));
  }

  flat.canvas.addEventListener('pointermove', (event) => (reading.textContent = flat.read(event) || '\u00a0'));
  flat.canvas.addEventListener('pointerleave', () => (reading.textContent = '\u00a0'));

  const updateMarks = () => {
    const { input } = session;
    const marks = input ? marksOf(input, occlusions, getComputedStyle(views)) : [];
    before.setMarks(marks);
    space.setMarks(marks);
    legend.replaceChildren(...marks.map(({ colour, words }) => {
      const item = document.createElement('span');
      item.className = 'key';
      item.style.setProperty('--colour', colour);
      item.textContent = words;
      return item;
    }));
  };

  session.on('input', (input) => {
    const { name, width, height } = input;
    before.show(inputNormals(input), !input.design);
    views.style.setProperty('--aspect', String(width / height));
    inputCaption.textContent = `${name}, ${number(width, 6)} × ${number(height, 6)}`;
    occlusions = null;
    updateMarks();
  });
  session.on('occlusions', (found) => {
    occlusions = found;
    updateMarks();
  });
  session.on('cleared', () => {
    show(null);
    caption.textContent = '';
  });
  session.on('preview', ({ input, lambda, image: { width, height, pixelSize, data } }) => {
    after.show(normalsOf(data, width, height, 1 / pixelSize), true, input);
    // The layers belong to the last result, not to the preview.
    after.setLayer(null);
    caption.textContent = input.design ? '' : `λ = ${shortLambda(lambda)}`;
    figure.dataset.preview = '';
    stamp.textContent = 'preview';
    stamp.hidden = false;
    empty.hidden = true;
  });
  /** @param {import('../session.js').Result | null} result */
  const show = (result) => {
    delete figure.dataset.preview;
    if (!result) {
      after.show(null);
      stamp.hidden = true;
      empty.hidden = false;
      return;
    }
    after.show(resultNormals(result));
    // λ has no effect on a design.
    caption.textContent = result.input.design ? '' : `λ = ${shortLambda(result.surface.report.lambda)}`;
    stamp.textContent = result.surface.report.stopReason === 'cancelled' ? 'cancelled' : '';
    stamp.hidden = !stamp.textContent;
    empty.hidden = true;
  };
  session.on('result', show);
  // The last result replaces the previews.
  session.on('unsolved', () => {
    show(session.result);
    after.setLayer(present.result ?? null);
  });
  session.on('phase', (phase) => {
    figure.setAttribute('aria-busy', String(phase === 'running'));
    empty.textContent = phase === 'running' ? 'Solving…' : 'Not solved yet';
  });

  const save = element('view-save', HTMLButtonElement);
  save.addEventListener('click', async () => {
    const shown = space.isShown() ? [space.drawnCanvas()] : elements('#views canvas', HTMLCanvasElement).filter((canvas) => canvas.checkVisibility());
    const picture = new OffscreenCanvas(shown.reduce((sum, { width }) => sum + width, 0), Math.max(...shown.map(({ height }) => height)));
    const context = picture.getContext('2d');
    if (!context) return;
    context.fillStyle = getComputedStyle(views).getPropertyValue('--well').trim();
    context.fillRect(0, 0, picture.width, picture.height);
    let left = 0;
    for (const canvas of shown) {
      context.drawImage(canvas, left, 0);
      left += canvas.width;
    }
    download(await picture.convertToBlob({ type: 'image/png' }), 'image/png', `${session.input?.name ?? 'view'}-view.png`);
  });
  session.on('result', () => (save.disabled = false));
  session.on('cleared', () => (save.disabled = true));

  return {
    space,
    /**
     * Shows layers over the surfaces, or pictures in their places.
     * @param {Partial<ViewContent>} shown
     */
    show: (shown) => {
      const { input, result, before: left, after: right } = shown;
      present = shown;
      space.show(shown);
      before.setLayer(input ?? null);
      after.setLayer(result ?? null);
      photo.show(left ?? null);
      flat.show(right ?? null);
      element('input-title', HTMLElement).textContent = left?.title ?? 'Input';
      element('result-title', HTMLElement).textContent = right?.title ?? 'Result';
      before.setAside(left !== undefined);
      after.setAside(right !== undefined);
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
