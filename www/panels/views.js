/** Input and result side by side under one light. */
import { download, element, elements } from '../dom.js';
import { number, readingOf, shortest } from '../format.js';
import { gridOf, nearest } from '../surface/lattice.js';
import { inputNormals, resultImage, resultNormals } from '../surface/known.js';
import { normalsOf } from '../surface/normals.js';
import { Light } from '../surface/light.js';
import { PictureView } from '../surface/picture.js';
import { SurfaceView } from '../surface/view.js';
import { Zoom } from '../surface/zoom.js';
import { MARKS } from '../messages.js';
import { spacePanel } from './space.js';

/** @import {Occlusions} from '../api.js' */
/** @import {Input, Session} from '../session.js' */
/** @import {Marks} from '../surface/marks.js' */
/** @import {Shown} from '../views/shown.js' */

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
  // What the keyboard comes to is seen.
  over.addEventListener('focusin', ({ target }) => {
    const [knob, frame] = [target, over.parentElement].map((one) => (one instanceof Element ? one.getBoundingClientRect() : new DOMRect()));
    const seen = knob.right > frame.left && knob.left < frame.right && knob.bottom > frame.top && knob.top < frame.bottom;
    if (!seen) photoZoom.reset();
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
  let torn = null;

  /** @type {Partial<Shown>} */
  let now = {};
  const reading = element('flat-reading', HTMLElement);
  for (const [view, over] of /** @type {const} */ ([[before, 'input'], [after, 'result']])) {
    view.canvas.addEventListener('pointermove', (event) => {
      const { input, result } = session;
      const place = view.under(event);
      const shown = over === 'result' ? result && resultImage(result) : input;
      if (!input || !shown || !place) {
        reading.textContent = '\u00a0';
        return;
      }
      const { width, height, pixelSize, left, top } = gridOf(input);
      const z = shown.data[Math.floor(place[1] * height) * width + Math.floor(place[0] * width)] * (over === 'input' ? input.heightScale : 1);
      reading.textContent = readingOf(z, input.unit, now[over]?.read?.(left + place[0] * width * pixelSize, top - place[1] * height * pixelSize)) || '\u00a0';
    });
    view.canvas.addEventListener('pointerleave', () => (reading.textContent = '\u00a0'));
  }

  flat.canvas.addEventListener('pointermove', (event) => (reading.textContent = flat.read(event) || '\u00a0'));
  flat.canvas.addEventListener('pointerleave', () => (reading.textContent = '\u00a0'));

  const mark = () => {
    const { input } = session;
    const marks = input ? marksOf(input, torn, getComputedStyle(views)) : [];
    before.mark(marks);
    space.mark(marks);
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
    torn = null;
    mark();
  });
  session.on('occlusions', (found) => {
    torn = found;
    mark();
  });
  session.on('cleared', () => {
    show(null);
    caption.textContent = '';
  });
  session.on('preview', ({ input, lambda, image: { width, height, pixelSize, data } }) => {
    after.show(normalsOf(data, width, height, 1 / pixelSize), true, input);
    // Its colours and lines are those of the result before.
    after.cover(null);
    caption.textContent = input.design ? '' : `λ = ${shortest(lambda)}`;
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
    // λ has no say in a design.
    caption.textContent = result.input.design ? '' : `λ = ${shortest(result.surface.report.lambda)}`;
    stamp.textContent = result.surface.report.stopReason === 'cancelled' ? 'cancelled' : '';
    stamp.hidden = !stamp.textContent;
    empty.hidden = true;
  };
  session.on('result', show);
  // Previews of it are no more.
  session.on('unsolved', () => {
    show(session.result);
    after.cover(now.result ?? null);
  });
  session.on('phase', (phase) => {
    figure.setAttribute('aria-busy', String(phase === 'running'));
    empty.textContent = phase === 'running' ? 'Solving…' : 'Not solved yet';
  });

  const save = element('view-save', HTMLButtonElement);
  save.addEventListener('click', async () => {
    const shown = space.there() ? [space.drawn()] : elements('#views canvas', HTMLCanvasElement).filter((canvas) => canvas.checkVisibility());
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
     * Draws over the surfaces, or puts pictures in their places.
     * @param {Partial<Shown>} shown
     */
    show: (shown) => {
      const { input, result, before: left, after: right } = shown;
      now = shown;
      space.show(shown);
      before.cover(input ?? null);
      after.cover(result ?? null);
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
 * What is drawn over the input: where it is torn, where it is not trusted, and where it is held.
 * @param {Input} input
 * @param {Occlusions | null} torn
 * @param {CSSStyleDeclaration} style
 * @returns {(Marks & { words: string })[]}
 */
function marksOf(input, torn, style) {
  const { width, height, data, design, confidence, constraints } = input;
  const held = design ? data : constraints;
  /** @param {string} name @param {(pixel: number) => boolean} has @param {(number: number) => string} words */
  const marks = (name, has, words) => {
    /** @type {number[]} */
    const pixels = [];
    const count = width * height;
    for (let i = 0; i < count; i++) if (has(i)) pixels.push(i);
    return { width, height, pixels, colour: style.getPropertyValue(name).trim(), words: words(pixels.length) };
  };
  const found = [];
  if (confidence) found.push(marks('--mark-doubt', (i) => confidence[i] < 0.5 && !Number.isNaN(data[i]), MARKS.doubted));
  const flags = torn && (torn.image ?? nearest(torn, gridOf(input)).map((vertex) => torn.vertices[vertex] ?? 0));
  if (torn && flags) found.push({ ...marks('--mark-torn', (i) => flags[i] !== 0, String), words: MARKS.torn(torn.count) });
  if (held) found.push(marks('--mark-held', (i) => !Number.isNaN(held[i]), MARKS.held));
  return found;
}
