/** Input and result as surfaces in space, one on each side of a divider; or the surface laid flat, as a picture in their place. */
import { download, element, elements, oncePerFrame } from '../dom.js';
import { heightReading, number, shortLambda } from '../format.js';
import { resultImage } from '../surface/derived-data.js';
import { PictureView } from '../surface/picture-view.js';
import { heightAt, heightfieldBox, reliefMesh, reliefOf } from '../surface/relief.js';
import { SceneView } from '../surface/scene.js';
import { pictureWithColours } from '../views/legend.js';
import { dividerOver } from './divider.js';

/** @import {Input, Result, Session} from '../session.js' */
/** @import {Relief} from '../surface/relief.js' */
/** @import {Vector} from '../surface/scene.js' */
/** @import {ViewContent} from '../views/view-content.js' */

/** Directions of view. @type {Record<'above' | 'oblique', Vector>} */
const DIRECTIONS = { above: [0, 0, -1], oblique: [0.375, 0.687, -0.622] };
/** Pixels of a saved picture per pixel of the screen. */
const SAVED_RATIO = 2;

/**
 * @param {Session} session
 * @returns {(shown: Partial<ViewContent>) => void} shows layers over the surfaces, or a picture in their place
 */
export function spacePanel(session) {
  const canvas = element('space-canvas', HTMLCanvasElement);
  const flat = new PictureView(element('result-picture', HTMLCanvasElement));
  const reading = element('reading', HTMLElement);
  const missing = element('space-missing', HTMLElement);
  const save = element('view-save', HTMLButtonElement);
  const stamp = element('result-mark', HTMLElement);
  /** Null until the first input, and without WebGL. @type {SceneView | null} */
  let view = null;
  let isCreated = false;
  /** @type {Partial<ViewContent>} */
  let shown = {};
  /** Input and result. @type {[Relief | null, Relief | null]} */
  const reliefs = [null, null];
  /** Whether the result is a preview: the layers belong to the last result. */
  let isPreview = false;

  const divider = dividerOver('divider', ['input', 'result'], (share) => view?.divide(share));

  /** Creates the scene with the first input, and shows in it what there is by then. */
  const createView = async () => {
    isCreated = true;
    view = await SceneView.create(canvas, { isMetal: true, isSeenFromAbove: true }).catch(() => null);
    view?.setUp([0, 0, 1]);
    arrange();
    updateBox();
    view?.look(DIRECTIONS.oblique);
  };
  /** Shows the surfaces, or the picture in their place. */
  const arrange = () => {
    const isFlat = shown.after !== undefined;
    const isMissing = isCreated && view === null;
    missing.hidden = !isMissing || isFlat;
    canvas.hidden = isMissing || isFlat;
    element('picture-hint', HTMLElement).hidden = !isFlat;
    for (const tools of elements('#space-hint, .space-tools', HTMLElement)) tools.hidden = isFlat;
    save.disabled = !session.result || (isMissing && !isFlat);
    const isDivided = reliefs[1] !== null && !isFlat;
    divider.show(isDivided);
    element('space-before', HTMLElement).hidden = isFlat;
    element('space-after', HTMLElement).hidden = !isDivided;
  };

  const updateBox = () => {
    if (!session.input) return;
    view?.setBox(heightfieldBox(session.input));
    updateSurfaces([0, 1]);
  };
  /** @param {readonly (0 | 1)[]} sides */
  const updateSurfaces = (sides) => {
    for (const side of sides) {
      const relief = reliefs[side];
      view?.setSurface(side, relief && reliefMesh(relief, view.isFast));
    }
    updateLayers();
  };
  /** Draws layers over the surfaces, and the divider between them. */
  const updateLayers = () => {
    [shown.input, isPreview ? undefined : shown.result].forEach((layer, i) => {
      const side = /** @type {0 | 1} */ (i);
      view?.setImage(side, layer?.image ?? null);
      view?.setLines(side, layer?.lines ?? []);
    });
    view?.divide(divider.share);
    arrange();
  };

  element('from-above', HTMLButtonElement).addEventListener('click', () => view?.look(DIRECTIONS.above));
  element('at-an-angle', HTMLButtonElement).addEventListener('click', () => view?.look(DIRECTIONS.oblique));
  /** Newest place of the pointer. */
  let pointer = { offsetX: 0, offsetY: 0 };
  const readSoon = oncePerFrame(() => {
    const place = view?.pick(pointer);
    const side = place?.after ? 1 : 0;
    const relief = reliefs[side];
    if (!place || !relief) return (reading.textContent = '');
    const [x, y] = place.point;
    reading.textContent = heightReading(heightAt(relief, x, y), session.input?.unit, [shown.input, shown.result][side]?.read?.(x, y));
  });
  canvas.addEventListener('pointermove', ({ offsetX, offsetY, buttons }) => {
    pointer = { offsetX, offsetY };
    if (buttons === 0) readSoon();
  });
  flat.canvas.addEventListener('pointermove', (event) => (reading.textContent = flat.read(event)));
  for (const one of [canvas, flat.canvas]) one.addEventListener('pointerleave', () => (reading.textContent = ''));

  save.addEventListener('click', async () => {
    const isFlat = shown.after !== undefined;
    if (!isFlat) view?.draw(SAVED_RATIO * devicePixelRatio);
    const picture = pictureWithColours(isFlat ? flat.canvas : canvas, shown.colours);
    view?.drawSoon();
    download(await picture.convertToBlob({ type: 'image/png' }), 'image/png', `${session.input?.name ?? 'view'}-view.png`);
  });

  session.on('input', (input) => {
    const { name, width, height, heightScale } = input;
    element('input-caption', HTMLElement).textContent = `${name}, ${number(width, 6)} × ${number(height, 6)}`;
    reliefs[0] = reliefOf(input, input, heightScale);
    if (!isCreated) void createView();
    else updateBox();
  });
  /** @param {Input} input @param {{ width: number, height: number, data: ArrayLike<number> }} image @param {number} lambda @param {string} mark */
  const showSurface = (input, image, lambda, mark) => {
    element('result-caption', HTMLElement).textContent = `λ = ${shortLambda(lambda)}`;
    stamp.textContent = mark;
    stamp.hidden = !mark;
    reliefs[1] = reliefOf(input, image, 1);
    updateSurfaces([1]);
  };
  session.on('preview', ({ input, image, lambda }) => {
    isPreview = true;
    showSurface(input, image, lambda, 'preview');
  });
  /** @param {Result | null} result */
  const showResult = (result) => {
    isPreview = false;
    if (result) return showSurface(result.input, resultImage(result), result.surface.report.lambda, result.surface.report.stopReason === 'cancelled' ? 'cancelled' : '');
    reliefs[1] = null;
    updateSurfaces([1]);
  };
  session.on('cleared', () => {
    showResult(null);
    view?.look(DIRECTIONS.oblique);
  });
  session.on('result', showResult);
  // The last result replaces the previews.
  session.on('unsolved', () => showResult(session.result));
  arrange();

  return (now) => {
    shown = now;
    flat.show(now.after ?? null);
    reading.textContent = '';
    updateLayers();
  };
}
