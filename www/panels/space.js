/** Input and result as surfaces in space, one on each side of a divider; and the animation that unfolds the result. */
import { element } from '../dom.js';
import { heightReading, strainInWords } from '../format.js';
import { CREASE_COLOUR } from '../surface/colours.js';
import { resultImage } from '../surface/derived-data.js';
import { expandBox, heightAt, heightfieldBox, intersectHeights, markPoints, reliefMesh, reliefOf } from '../surface/relief.js';
import { SceneView, vectorAt } from '../surface/scene.js';
import { unfoldedPositions } from '../surface/unfolding.js';
import { dividerOver } from './divider.js';

/** @import {Result, Session} from '../session.js' */
/** @import {PixelMarks} from '../surface/layer.js' */
/** @import {Relief} from '../surface/relief.js' */
/** @import {Box, Vector} from '../surface/scene.js' */
/** @import {ViewContent} from '../views/view-content.js' */

/** Duration of the unfolding, in milliseconds. */
const UNFOLDING_MS = 2200;
/** Delay before the unfolding begins, in milliseconds. */
const UNFOLDING_DELAY_MS = 500;
/** Width of the border of an unfolding, in CSS pixels. */
const BORDER_WIDTH = 1.5;
/** Directions of view. @type {Record<'above' | 'oblique', Vector>} */
const DIRECTIONS = { above: [0, 0, -1], oblique: [0.375, 0.687, -0.622] };

/** @param {Session} session */
export function spacePanel(session) {
  const panel = element('space', HTMLElement);
  const canvas = element('space-canvas', HTMLCanvasElement);
  const reading = element('reading', HTMLElement);
  const missing = element('space-missing', HTMLElement);
  const unfold = element('unfold', HTMLInputElement);
  /** Null until the first input, and without WebGL. @type {SceneView | null} */
  let view = null;
  let isCreated = false;
  /** Number of the newest animation; older ones end. */
  let newestAnimation = 0;
  /** @type {Partial<ViewContent>} */
  let shown = {};
  /** @type {PixelMarks | null} */
  let marks = null;
  /** Input and result. @type {[Relief | null, Relief | null]} */
  const reliefs = [null, null];
  /** Whether the result is a preview: the layers belong to the last result. */
  let isPreview = false;
  /** @type {Box} */
  let box = { low: [0, 0, 0], high: [1, 1, 0] };

  const divider = dividerOver('divider', ['input', 'result'], (share) => view?.divide(share));

  /** Creates the scene with the first input, and shows in it what there is by then. */
  const createView = async () => {
    isCreated = true;
    view = await SceneView.create(canvas, { isMetal: true, isSeenFromAbove: true }).catch(() => null);
    missing.hidden = view !== null;
    canvas.hidden = view === null;
    view?.setUp([0, 0, 1]);
    updateBox();
    view?.look(DIRECTIONS.oblique);
  };

  /** Shows another box, with all surfaces. */
  const updateBox = () => {
    if (!session.input) return;
    box = heightfieldBox(session.input);
    if (shown.unfolding) box = expandBox(shown.unfolding, box);
    view?.setBox(box);
    updateSurfaces([0, 1]);
  };
  /** @param {readonly (0 | 1)[]} sides */
  const updateSurfaces = (sides) => {
    for (const side of sides) {
      const relief = reliefs[side];
      if (!(side === 1 && shown.unfolding)) view?.setSurface(side, relief && reliefMesh(relief, view.isFast));
    }
    updateUnfolding();
    updateLayers();
  };
  /** Shows the unfolding at its present position. */
  const updateUnfolding = () => {
    const { unfolding } = shown;
    if (!unfolding) return;
    const { triangles, colors, borders } = unfolding;
    const positions = unfoldedPositions(unfolding, unfold.valueAsNumber);
    view?.setSurface(1, { positions, triangles, colors });
    view?.setLines(1, borders.map((line) => ({ points: Array.from(line, (vertex) => vectorAt(positions, vertex)), colour: CREASE_COLOUR, width: BORDER_WIDTH })));
  };
  /** Draws layers and marks over the surfaces, and the divider between them. */
  const updateLayers = () => {
    const { input } = session;
    [shown.input, isPreview ? undefined : shown.result].forEach((layer, i) => {
      const side = /** @type {0 | 1} */ (i);
      if (side === 1 && shown.unfolding) return;
      const points = input && marks ? markPoints(marks, input) : [];
      view?.setImage(side, layer?.image ?? null);
      view?.setLines(side, [...(layer?.lines ?? []), ...points]);
    });
    // The input of a design is not a surface, and an unfolding shows the result only.
    const hidesInput = shown.unfolding !== undefined || input?.design === true;
    divider.show(reliefs[1] !== null && !hidesInput);
    element('space-before', HTMLElement).hidden = hidesInput && (shown.unfolding !== undefined || reliefs[1] !== null);
    element('space-after', HTMLElement).hidden = !reliefs[1] || shown.unfolding !== undefined;
    view?.divide(hidesInput && reliefs[1] ? 0 : divider.share);
  };

  element('from-above', HTMLButtonElement).addEventListener('click', () => view?.look(DIRECTIONS.above));
  element('at-an-angle', HTMLButtonElement).addEventListener('click', () => view?.look(DIRECTIONS.oblique));

  unfold.addEventListener('input', () => {
    newestAnimation++;
    updateUnfolding();
  });
  /** Animates the unfolding once. Users who prefer reduced motion see the end at once; moving the slider ends the animation. */
  const animateUnfolding = () => {
    const animation = ++newestAnimation;
    const start = performance.now();
    const isMotionReduced = matchMedia('(prefers-reduced-motion: reduce)').matches;
    unfold.value = isMotionReduced ? '1' : '0';
    updateUnfolding();
    /** @param {number} now */
    const step = (now) => {
      if (animation !== newestAnimation || !shown.unfolding) return;
      const progress = Math.min(1, Math.max(0, (now - start - UNFOLDING_DELAY_MS) / UNFOLDING_MS));
      unfold.value = String(progress * progress * (3 - 2 * progress));
      updateUnfolding();
      if (progress < 1) requestAnimationFrame(step);
    };
    if (!isMotionReduced) requestAnimationFrame(step);
  };

  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons !== 0 || !view) return;
    if (shown.unfolding) {
      const { triangles, strains } = shown.unfolding;
      const place = view.pick(event);
      reading.textContent = strainInWords(place ? place.shares.reduce((sum, share, k) => sum + share * strains[triangles[3 * place.triangle + k]], 0) : NaN);
      return;
    }
    const side = view.sideAt(event.offsetX);
    const relief = reliefs[side];
    const point = relief && intersectHeights(view.rayAt(event.offsetX, event.offsetY), box, (x, y) => heightAt(relief, x, y));
    reading.textContent = point ? heightReading(point[2], session.input?.unit, [shown.input, shown.result][side]?.read?.(point[0], point[1])) : '';
  });
  canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  session.on('input', (input) => {
    reliefs[0] = reliefOf(input, input, input.heightScale);
    if (!isCreated) void createView();
    else updateBox();
  });
  session.on('preview', ({ input, image }) => {
    reliefs[1] = reliefOf(input, image, 1);
    isPreview = true;
    updateSurfaces([1]);
  });
  /** @param {Result | null} result */
  const showResult = (result) => {
    reliefs[1] = result && reliefOf(result.input, resultImage(result), 1);
    isPreview = false;
    updateSurfaces([1]);
  };
  session.on('cleared', () => {
    showResult(null);
    view?.look(DIRECTIONS.oblique);
  });
  session.on('result', showResult);
  // The last result replaces the previews.
  session.on('unsolved', () => showResult(session.result));

  return {
    animateUnfolding,
    isShown: () => !panel.hidden,
    /** Whether this browser cannot draw the surfaces. */
    isMissing: () => !missing.hidden,
    /** Draws the surfaces, with twice as many pixels for a file, and returns the canvas. @param {number} [ratio] pixels of the canvas per CSS pixel */
    drawnCanvas: (ratio) => {
      view?.draw(ratio);
      view?.drawSoon();
      return canvas;
    },
    /** Shows the layers of a view, or an unfolding. @param {Partial<ViewContent>} now */
    show: (now) => {
      const isOther = now.unfolding !== shown.unfolding;
      shown = now;
      if (!isOther) return updateLayers();
      updateBox();
      view?.fit();
    },
    /** Shows marks on the input. @param {PixelMarks | null} now */
    setMarks: (now) => {
      marks = now;
      updateLayers();
    },
  };
}
