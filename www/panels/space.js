/** Input and result as surfaces in space, one on each side of a divider; and the animation that unfolds the result. */
import { oncePerFrame, element } from '../dom.js';
import { number, heightReading, strainInWords } from '../format.js';
import { CREASE_COLOUR } from '../surface/colours.js';
import { resultImage } from '../surface/derived-data.js';
import { gridOf } from '../surface/lattice.js';
import { clampToUnit, expandBox, heightAt, heightfieldBox, intersectHeights, markPoints, pinPosition, reliefMesh, reliefOf } from '../surface/relief.js';
import { SceneView, vectorAt } from '../surface/scene.js';
import { dividerOver } from './divider.js';

/** @import {Pin} from '../design.js' */
/** @import {DragTarget} from '../surface/gestures.js' */
/** @import {Result, Session} from '../session.js' */
/** @import {Colour} from '../surface/colours.js' */
/** @import {Line, PixelMarks} from '../surface/layer.js' */
/** @import {Relief} from '../surface/relief.js' */
/** @import {Box, Vector} from '../surface/scene.js' */
/** @import {ViewContent} from '../views/view-content.js' */

/** Duration of the unfolding, in milliseconds. */
const UNFOLDING_MS = 2200;
/** Delay before the unfolding begins, in milliseconds. */
const UNFOLDING_DELAY_MS = 500;
/** Width of the border of an unfolding, in CSS pixels. */
const BORDER_WIDTH = 1.5;
/** Colour of a line that is being drawn. @type {Colour} */
const TRAIL_COLOUR = [214, 64, 43];
/** Minimum share of the vertical in the direction of view for moving pins along the ground: smaller ones would move them too far. */
const MIN_VERTICAL_SHARE = 0.2;
/** Directions of view. @type {Record<'above' | 'oblique', Vector>} */
const DIRECTIONS = { above: [0, 0, -1], oblique: [0.375, 0.687, -0.622] };

/** @param {Session} session */
export function spacePanel(session) {
  const panel = element('space', HTMLElement);
  const canvas = element('space-canvas', HTMLCanvasElement);
  const reading = element('reading', HTMLElement);
  const missing = element('space-missing', HTMLElement);
  const exaggeration = element('exaggeration', HTMLInputElement);
  const exaggerated = element('exaggerated', HTMLElement);
  const drag = element('drag', HTMLSelectElement);
  const unfold = element('unfold', HTMLInputElement);
  /** Null until the first input, and without WebGL. @type {SceneView | null} */
  let view = null;
  let isCreated = false;
  /** The handler of the present drag over the surface. @type {DragTarget | undefined} */
  let dragHandler;
  /** @type {DragTarget[]} */
  const dragHandlers = [];
  /** The line that is being drawn on the surface. @type {Line | null} */
  let trail = null;
  /** @type {(() => void)[]} */
  const drawListeners = [];
  /** Number of the newest animation; older ones end. */
  let newestAnimation = 0;
  /** @type {Partial<ViewContent>} */
  let shown = {};
  /** @type {readonly PixelMarks[]} */
  let marks = [];
  /** Input and result. @type {[Relief | null, Relief | null]} */
  const reliefs = [null, null];
  /** Whether the result is a preview: the layers belong to the last result. */
  let isPreview = false;
  /** @type {Box} */
  let box = { low: [0, 0, 0], high: [1, 1, 0] };

  const divider = dividerOver('divider', ['input', 'result'], (share) => view?.divide(share));
  /** Factor by which heights are exaggerated. */
  const stretch = () => 2 ** exaggeration.valueAsNumber;
  const isShown = () => !panel.hidden;
  /** The surface that is edited: the result, or the input where there is none. */
  const topRelief = () => reliefs[1] ?? reliefs[0];

  /** Creates the scene with the first input, and shows in it what there is by then. */
  const createView = async () => {
    isCreated = true;
    view = await SceneView.create(canvas, {
      isMetal: true,
      isSeenFromAbove: true,
      onDraw: () => drawListeners.forEach((onDraw) => onDraw()),
      controlsLight: () => drag.value === 'light',
      target: {
        begin: (x, y) => {
          dragHandler = dragHandlers.find((one) => one.begin(x, y));
          return dragHandler !== undefined;
        },
        move: (x, y) => dragHandler?.move(x, y),
        end: () => dragHandler?.end(),
      },
    }).catch(() => null);
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
    const { triangles, forms, colors, borders } = unfolding;
    const place = unfold.valueAsNumber * (forms.length - 1);
    const first = Math.min(forms.length - 2, Math.floor(place));
    const positions = forms[first].map((value, i) => value + (place - first) * (forms[first + 1][i] - value));
    view?.setSurface(1, { positions, triangles, colors });
    view?.setLines(1, borders.map((line) => ({ points: Array.from(line, (vertex) => vectorAt(positions, vertex)), colour: CREASE_COLOUR, width: BORDER_WIDTH })));
  };
  const unfoldSoon = oncePerFrame(updateUnfolding);
  /** Draws layers, marks and the trail over the surfaces, and the divider between them. */
  const updateLayers = () => {
    const { input } = session;
    [shown.input, isPreview ? undefined : shown.result].forEach((layer, i) => {
      const side = /** @type {0 | 1} */ (i);
      if (side === 1 && shown.unfolding) return;
      const points = input && (side === 0 || input.design) ? markPoints(marks, input) : [];
      view?.setImage(side, layer?.image ?? null);
      view?.setLines(side, [...(layer?.lines ?? []), ...points, ...(trail ? [trail] : [])]);
    });
    // The input of a design is not a surface, and an unfolding shows the result only.
    const hidesInput = shown.unfolding !== undefined || input?.design === true;
    divider.show(reliefs[1] !== null && !hidesInput);
    element('space-before', HTMLElement).hidden = hidesInput && (shown.unfolding !== undefined || reliefs[1] !== null);
    element('space-after', HTMLElement).hidden = !reliefs[1] || shown.unfolding !== undefined;
    view?.divide(hidesInput && reliefs[1] ? 0 : divider.share);
  };

  exaggeration.addEventListener('input', () => {
    exaggerated.textContent = `× ${number(stretch(), 2)}`;
    exaggeration.setAttribute('aria-valuetext', `heights ${number(stretch(), 2)} times`);
    view?.exaggerate(stretch());
    view?.fit();
  });
  element('from-above', HTMLButtonElement).addEventListener('click', () => view?.look(DIRECTIONS.above));
  element('at-an-angle', HTMLButtonElement).addEventListener('click', () => view?.look(DIRECTIONS.oblique));

  unfold.addEventListener('input', () => {
    newestAnimation++;
    unfoldSoon();
  });
  /** Animates the unfolding once. Users who prefer reduced motion see the end at once; moving the slider ends the animation. */
  const animateUnfolding = () => {
    const animation = ++newestAnimation;
    const start = performance.now();
    const isMotionReduced = matchMedia('(prefers-reduced-motion: reduce)').matches;
    unfold.value = isMotionReduced ? '1' : '0';
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

  /** The place of the surface at a place of the canvas. @param {number} x @param {number} y in CSS pixels @param {Relief | null} relief */
  const surfaceAt = (x, y, relief) => view && intersectHeights(view.rayAt(x, y), box, (px, py) => (relief ? heightAt(relief, px, py) : 0));
  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons !== 0 || !view) return;
    if (shown.unfolding) {
      const { triangles, strains } = shown.unfolding;
      const place = view.pick(event);
      reading.textContent = strainInWords(place ? place.shares.reduce((sum, share, k) => sum + share * strains[triangles[3 * place.triangle + k]], 0) : NaN);
      return;
    }
    const side = view.sideAt(event.offsetX);
    const point = reliefs[side] && surfaceAt(event.offsetX, event.offsetY, reliefs[side]);
    reading.textContent = point ? heightReading(point[2], session.input?.unit, [shown.input, shown.result][side]?.read?.(point[0], point[1])) : '';
  });
  canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  session.on('input', (input) => {
    const isDragged = input.designShape !== undefined && session.phase === 'running';
    reliefs[0] = reliefOf(input, input, input.heightScale);
    if (!isCreated) void createView();
    // While a design is dragged, the camera stays.
    else if (isDragged) updateSurfaces([0]);
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
    isShown,
    /** Whether this browser cannot draw the surfaces. */
    isMissing: () => !missing.hidden,
    /** Draws the surfaces, with twice as many pixels for a file, and returns the canvas. @param {number} [ratio] pixels of the canvas per CSS pixel */
    drawnCanvas: (ratio) => {
      view?.draw(ratio);
      view?.drawSoon();
      return canvas;
    },
    /** Adds a handler, which may accept drags over the surface. @param {DragTarget} handler */
    addDragHandler: (handler) => dragHandlers.push(handler),
    canvas,
    /** Adds a listener, which is called after each draw. @param {() => void} listener */
    onDraw: (listener) => drawListeners.push(listener),
    /** Tilt of the camera in radians, from straight above. */
    cameraTilt: () => view?.tilt ?? 0,
    /** The place of the surface at a place of the canvas, in CSS pixels. @param {number} x @param {number} y @returns {Pin | null} */
    placeAt: (x, y) => {
      const { input } = session;
      if (!input || !view) return null;
      const point = surfaceAt(x, y, reliefs[input.design ? 1 : view.sideAt(x)]);
      if (!point) return null;
      const { left, top, pixelSize, width, height } = gridOf(input);
      return {
        x: clampToUnit(((point[0] - left) / pixelSize - 0.5) / (width - 1)),
        y: clampToUnit(1 - ((top - point[1]) / pixelSize - 0.5) / (height - 1)),
        z: point[2] / (width * pixelSize),
      };
    },
    /** A function from pixels of the input to heights of the result, or of the input if there is none, in steps of `heightScale`. */
    heightSampler: () => {
      const { input } = session;
      const relief = topRelief();
      if (!input || !relief) return () => NaN;
      const { width, height, heights, heightScale } = relief;
      /** @param {number} pixel */
      return (pixel) => {
        const col = Math.floor((((pixel % input.width) + 0.5) / input.width) * width);
        const row = Math.floor(((Math.floor(pixel / input.width) + 0.5) / input.height) * height);
        return (heights[row * width + col] * heightScale) / input.heightScale;
      };
    },
    /**
     * Shows a line that is being drawn on the surfaces.
     * @param {readonly { x: number, y: number }[]} places
     * @param {boolean} closed
     */
    showTrail: (places, closed) => {
      const { input } = session;
      const relief = topRelief();
      const points = input && relief ? [...places, ...(closed && places[0] ? [places[0]] : [])].map(({ x, y }) => {
        const [px, py] = pinPosition(input, { x, y, z: 0 });
        const z = heightAt(relief, px, py);
        return /** @type {const} */ ([px, py, Number.isNaN(z) ? (box.low[2] + box.high[2]) / 2 : z]);
      }) : [];
      trail = points.length > 0 ? { points, colour: TRAIL_COLOUR, width: 4 } : null;
      updateLayers();
    },
    /** Height of the result, in sides of the square. @param {number} x @param {number} y */
    heightAt: (x, y) => {
      const [, relief] = reliefs;
      const [px, py] = session.input ? pinPosition(session.input, { x, y, z: 0 }) : [0, 0];
      const z = relief ? heightAt(relief, px, py) : 0;
      return Number.isNaN(z) ? 0 : z / (relief?.extent.width ?? 1);
    },
    /** Position of a pin on the canvas, in CSS pixels. @param {Pin} pin @returns {[number, number]} */
    screenPosition: (pin) => (session.input && view ? view.project(pinPosition(session.input, pin)) : [0, 0]),
    /**
     * A pin moved by a drag: upwards, or along the ground.
     * @param {Pin} pin
     * @param {number} across CSS pixels to the right
     * @param {number} up CSS pixels upwards
     * @param {boolean} onGround whether it keeps its height
     * @returns {Pin}
     */
    movePin: (pin, across, up, onGround) => {
      const { input } = session;
      if (!input || !view) return pin;
      const [side, [x, y, z]] = [reliefs[0]?.extent.width ?? 1, pinPosition(input, pin)];
      const [column, row] = view.project([x, y, z]);
      if (!onGround) return { ...pin, z: pin.z + up / (row - view.project([x, y, z + side])[1]) };
      const [from, to] = [view.rayAt(column, row), view.rayAt(column + across, row - up)].map(({ point, towards }) => {
        const along = (z - point[2]) / Math.max(MIN_VERTICAL_SHARE / stretch(), towards[2]);
        return [point[0] + along * towards[0], point[1] + along * towards[1]];
      });
      return { x: clampToUnit(pin.x + (to[0] - from[0]) / side), y: clampToUnit(pin.y + (to[1] - from[1]) / side), z: pin.z };
    },
    /** Shows the layers of a view, or an unfolding. @param {Partial<ViewContent>} now */
    show: (now) => {
      const isOther = now.unfolding !== shown.unfolding;
      shown = now;
      if (!isOther) return updateLayers();
      if (now.unfolding) animateUnfolding();
      updateBox();
      view?.fit();
    },
    /** Shows marks on the input. @param {readonly PixelMarks[]} now */
    setMarks: (now) => {
      marks = now;
      updateLayers();
    },
  };
}
