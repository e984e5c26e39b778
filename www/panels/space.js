/** Input and result as surfaces in space, one on each side of a divider; and the animation that unfolds the result. */
import { oncePerFrame, element, elements } from '../dom.js';
import { number, heightReading, strainInWords } from '../format.js';
import { valueOnRay } from '../surface/anchored-lines.js';
import { Camera } from '../surface/camera.js';
import { controlCamera } from '../surface/gestures.js';
import { inputNormals, resultImage, resultNormals, takeTextures } from '../surface/derived-data.js';
import { gridOf } from '../surface/lattice.js';
import { normalsOf } from '../surface/normals.js';
import { expandBox, heightfieldBox, clampToUnit, heightAt, pinPosition, markPoints, reliefOf } from '../surface/relief.js';
import { SurfaceRenderer } from '../surface/surface-renderer.js';

/** @import {Pin} from '../design.js' */
/** @import {DragTarget} from '../surface/gestures.js' */
/** @import {Input, Result, Session} from '../session.js' */
/** @import {Colour} from '../surface/colours.js' */
/** @import {Layer, Line} from '../surface/layer.js' */
/** @import {Light} from '../surface/light.js' */
/** @import {PixelMarks} from '../surface/marks.js' */
/** @import {ViewContent} from '../views/view-content.js' */

/** Key of the arrangement (in space or flat) in the local storage. */
const ARRANGEMENT_KEY = 'developable: arrangement';
/** Delay after the last movement before the surfaces are drawn in full quality, in milliseconds. */
const FULL_QUALITY_DELAY_MS = 250;
/** Duration of the unfolding, in milliseconds. */
const UNFOLDING_MS = 2200;
/** Delay before the unfolding begins, in milliseconds. */
const UNFOLDING_DELAY_MS = 500;
/** Colour of a line that is being drawn. @type {Colour} */
const TRAIL_COLOUR = [214, 64, 43];
/** Distance that an arrow key moves the divider, as a share of the canvas' width. */
const DIVIDER_KEY_STEP = 0.05;
/** Distance that an arrow key moves the light, in radii of the disk of its directions. */
const LIGHT_KEY_STEP = 0.08;
/** Minimum cosine of the camera's tilt for moving pins along the ground: smaller ones would move them too far. */
const MIN_TILT_COSINE = 0.2;

/**
 * @param {Session} session
 * @param {Light} light
 */
export function spacePanel(session, light) {
  const panel = element('space', HTMLElement);
  const flat = element('views', HTMLElement);
  const canvas = element('space-canvas', HTMLCanvasElement);
  const divider = element('divider', HTMLElement);
  const reading = element('reading', HTMLElement);
  const left = element('space-before', HTMLElement);
  const right = element('space-after', HTMLElement);
  const exaggeration = element('exaggeration', HTMLInputElement);
  const exaggerated = element('exaggerated', HTMLElement);
  const drag = element('drag', HTMLSelectElement);
  const unfold = element('unfold', HTMLInputElement);
  const unfoldField = element('unfold-field', HTMLElement);
  const [tools] = elements('.space-tools', HTMLElement);
  const arrangement = elements('input[name="arrangement"]', HTMLInputElement);
  const hints = { flat: element('light-hint', HTMLElement), picture: element('picture-hint', HTMLElement), space: element('space-hint', HTMLElement) };
  const camera = new Camera();
  const space = createSpace(canvas, () => drawSoon());
  /** Position of the divider, as a share of the canvas' width. */
  let dividerShare = 0.5;
  /** The handler of the present drag over the surface. @type {DragTarget | null} */
  let dragHandler = null;
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
  const sides = /** @type {const} */ (['before', 'after']);

  const isChosen = () => arrangement.find(({ checked }) => checked)?.value === 'space';
  const isShown = () => space !== null && isChosen() && (!shown.after || shown.unfolding !== undefined);
  let qualityTimer = 0;
  let isFullQuality = false;
  const draw = () => {
    if (!space || panel.hidden || canvas.clientWidth === 0) return;
    const hasResult = space.relief('after') !== null;
    // The input of a design is not a surface, and an unfolding shows the result only.
    const hidesInput = shown.unfolding !== undefined || session.input?.design === true;
    const inputShare = hasResult && hidesInput ? 0 : hasResult ? dividerShare : 1;
    divider.hidden = !hasResult || hidesInput;
    divider.style.left = `${100 * dividerShare}%`;
    space.draw(camera, light, inputShare, unfold.valueAsNumber);
    for (const onDraw of drawListeners) onDraw();
    if (!isFullQuality) {
      clearTimeout(qualityTimer);
      qualityTimer = window.setTimeout(() => {
        isFullQuality = true;
        space.rest();
        draw();
        isFullQuality = false;
      }, FULL_QUALITY_DELAY_MS);
    }
  };
  const drawSoon = oncePerFrame(draw);
  /** @param {number} x in pixels of the canvas @returns {'before' | 'after'} */
  const sideAt = (x) => (x < dividerShare * canvas.width || !space?.relief('after') ? 'before' : 'after');

  const arrange = () => {
    panel.hidden = !isShown();
    tools.hidden = !isChosen();
    flat.hidden = isShown();
    hints.space.hidden = panel.hidden;
    element('flat-reading', HTMLElement).hidden = !panel.hidden;
    hints.flat.hidden = !panel.hidden || (shown.before !== undefined && shown.after !== undefined);
    hints.picture.hidden = !panel.hidden || shown.after === undefined;
    drawSoon();
  };

  if (space) {
    // Drawn at once, because a resized canvas is blank.
    new ResizeObserver(draw).observe(canvas);
    light.onMove(drawSoon);
    controlCamera(canvas, camera, {
      onChange: drawSoon,
      moveLight: (x, y) => light.moveTo(x, y),
      shiftLight: (x, y) => light.moveTo(light.x + LIGHT_KEY_STEP * x, light.y + LIGHT_KEY_STEP * y),
      resetLight: () => light.reset(),
      controlsLight: () => drag.value === 'light',
      dragTarget: {
        begin: (x, y) => {
          dragHandler = dragHandlers.find((one) => one.begin(x, y)) ?? null;
          return dragHandler !== null;
        },
        move: (x, y) => dragHandler?.move(x, y),
        end: () => dragHandler?.end(),
      },
    });
    try {
      const remembered = localStorage.getItem(ARRANGEMENT_KEY);
      for (const radio of arrangement) radio.checked = radio.value === (remembered ?? 'space');
    } catch {
      // Without local storage the choice is not remembered.
    }
  } else {
    element('arrangement', HTMLElement).hidden = true;
    for (const radio of arrangement) radio.checked = radio.value === 'flat';
  }
  for (const radio of arrangement) {
    radio.addEventListener('change', () => {
      arrange();
      try {
        localStorage.setItem(ARRANGEMENT_KEY, radio.value);
      } catch {
        // Without local storage the choice is not remembered.
      }
    });
  }

  exaggeration.addEventListener('input', () => {
    camera.exaggeration = 2 ** exaggeration.valueAsNumber;
    exaggerated.textContent = `× ${number(camera.exaggeration, 2)}`;
    exaggeration.setAttribute('aria-valuetext', `heights ${number(camera.exaggeration, 2)} times`);
    drawSoon();
  });
  element('from-above', HTMLButtonElement).addEventListener('click', () => {
    camera.viewFromAbove();
    drawSoon();
  });
  element('at-an-angle', HTMLButtonElement).addEventListener('click', () => {
    camera.viewObliquely();
    drawSoon();
  });

  unfold.addEventListener('input', () => {
    newestAnimation++;
    drawSoon();
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
      draw();
      if (progress < 1) requestAnimationFrame(step);
    };
    if (isMotionReduced) drawSoon();
    else requestAnimationFrame(step);
  };

  /** Moves the divider. @param {number} share of the canvas' width */
  const moveDivider = (share) => {
    dividerShare = Math.min(1, Math.max(0, share));
    const percent = Math.round(100 * dividerShare);
    divider.setAttribute('aria-valuenow', String(percent));
    divider.setAttribute('aria-valuetext', `input on ${percent} % of the picture, result on the rest`);
    drawSoon();
  };
  divider.addEventListener('pointerdown', (event) => {
    if (event.button === 0) divider.setPointerCapture(event.pointerId);
  });
  divider.addEventListener('pointermove', (event) => {
    if (!divider.hasPointerCapture(event.pointerId)) return;
    const box = canvas.getBoundingClientRect();
    moveDivider((event.clientX - box.left) / box.width);
  });
  divider.addEventListener('keydown', (event) => {
    const to = { ArrowLeft: dividerShare - DIVIDER_KEY_STEP, ArrowDown: dividerShare - DIVIDER_KEY_STEP, ArrowRight: dividerShare + DIVIDER_KEY_STEP, ArrowUp: dividerShare + DIVIDER_KEY_STEP, Home: 0, End: 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    moveDivider(to);
  });

  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons !== 0 || !space || panel.hidden) return;
    const ratio = canvas.width / canvas.clientWidth;
    const [x, y] = [event.offsetX * ratio, event.offsetY * ratio];
    if (shown.unfolding) {
      reading.textContent = strainInWords(valueOnRay(shown.unfolding, unfold.valueAsNumber, camera.rayAt(x, y), shown.unfolding.strains));
      return;
    }
    const side = sideAt(x);
    const relief = space.relief(side);
    const point = relief && camera.intersectHeightfield(x, y, (px, py) => heightAt(relief, px, py));
    const layer = side === 'before' ? shown.input : shown.result;
    reading.textContent = point ? heightReading(point[2], session.input?.unit, layer?.read?.(point[0], point[1])) : '';
  });
  canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  /** Draws layers, marks and the trail over both surfaces. */
  const updateLayers = () => {
    if (!space) return;
    const layers = { before: shown.input, after: shown.result };
    for (const side of sides) {
      const layer = layers[side];
      const hasMarks = side === 'before' || session.input?.design;
      const points = hasMarks && session.input ? markPoints(marks, session.input) : [];
      space.setOverlay(side, layer?.image ?? null, [...(layer?.lines ?? []), ...points, ...(trail ? [trail] : [])]);
    }
    drawSoon();
  };

  session.on('input', (input) => {
    if (!space) return;
    // While a design is dragged, the camera stays.
    if (!input.designShape || session.phase !== 'running') camera.box = heightfieldBox(input);
    space.setRelief('before', reliefOf(input, inputNormals(input), input.data, input.heightScale, takeTextures(input)));
    left.textContent = input.design ? '' : 'Input';
    updateLayers();
  });
  session.on('cleared', () => showResult(null));
  session.on('preview', ({ input, image: { width, height, pixelSize, data } }) => {
    if (!space || !isShown()) return;
    space.setRelief('after', reliefOf(input, normalsOf(data, width, height, 1 / pixelSize), data, 1));
    right.textContent = 'Result · preview';
    if (input.design) updateLayers();
    drawSoon();
  });
  /** @param {Result | null} result */
  const showResult = (result) => {
    if (!space) return;
    if (!result) {
      space.setRelief('after', null);
      right.textContent = '';
      drawSoon();
      return;
    }
    space.setRelief('after', reliefOf(result.input, resultNormals(result), resultImage(result).data, 1, takeTextures(result)));
    right.textContent = result.surface.report.stopReason === 'cancelled' ? 'Result · cancelled' : 'Result';
    updateLayers();
  };
  session.on('result', showResult);
  // The last result replaces the previews.
  session.on('unsolved', () => showResult(session.result));
  arrange();

  return {
    /** Whether the surfaces are shown in space. */
    isShown,
    /** Draws the canvas and returns it; its pixels are valid until the end of the frame. */
    drawnCanvas: () => {
      draw();
      return canvas;
    },
    /** Adds a handler, which may accept drags over the surface. @param {DragTarget} handler */
    addDragHandler: (handler) => dragHandlers.push(handler),
    canvas,
    /** Adds a listener, which is called after each draw. @param {() => void} listener */
    onDraw: (listener) => drawListeners.push(listener),
    /** Tilt of the camera in radians, from straight above. */
    cameraTilt: () => camera.tip,
    /** The place of the surface at a position of the canvas. @param {number} x @param {number} y @returns {Pin | null} */
    placeAt: (x, y) => {
      const { input } = session;
      if (!input) return null;
      const relief = space?.relief(input.design ? 'after' : sideAt(x));
      const point = camera.intersectHeightfield(x, y, (px, py) => (relief ? heightAt(relief, px, py) : 0));
      if (!point) return null;
      const { left: start, top, pixelSize, width, height } = gridOf(input);
      return {
        x: clampToUnit(((point[0] - start) / pixelSize - 0.5) / (width - 1)),
        y: clampToUnit(1 - ((top - point[1]) / pixelSize - 0.5) / (height - 1)),
        z: point[2] / (width * pixelSize),
      };
    },
    /** A function from pixels of the input to heights of the result, or of the input if there is none, in steps of `heightScale`. */
    heightSampler: () => {
      const { input } = session;
      const relief = space?.relief('after') ?? space?.relief('before');
      if (!input || !relief) return () => NaN;
      const { normals, heights, heightScale } = relief;
      /** @param {number} pixel */
      return (pixel) => {
        const col = Math.floor((((pixel % input.width) + 0.5) / input.width) * normals.width);
        const row = Math.floor(((Math.floor(pixel / input.width) + 0.5) / input.height) * normals.height);
        return (heights[row * normals.width + col] * heightScale) / input.heightScale;
      };
    },
    /**
     * Shows a line that is being drawn on the surfaces.
     * @param {readonly { x: number, y: number }[]} places
     * @param {boolean} closed
     */
    showTrail: (places, closed) => {
      const { input } = session;
      const relief = space?.relief('after') ?? space?.relief('before');
      const points = input && relief ? [...places, ...(closed && places[0] ? [places[0]] : [])].map(({ x, y }) => {
        const [px, py] = pinPosition(input, { x, y, z: 0 });
        const z = heightAt(relief, px, py);
        return /** @type {const} */ ([px, py, Number.isNaN(z) ? camera.centre[2] : z]);
      }) : [];
      trail = points.length > 0 ? { points, colour: TRAIL_COLOUR, width: 4 } : null;
      updateLayers();
    },
    /** Height of the result, in sides of the square. @param {number} x @param {number} y */
    heightAt: (x, y) => {
      const relief = space?.relief('after');
      const [px, py] = session.input ? pinPosition(session.input, { x, y, z: 0 }) : [0, 0];
      const z = relief ? heightAt(relief, px, py) : 0;
      return Number.isNaN(z) ? 0 : z / (relief?.extent.width ?? 1);
    },
    /** Position of a pin on the canvas, in CSS pixels. @param {Pin} pin @returns {[number, number]} */
    screenPosition: (pin) => {
      if (!session.input) return [0, 0];
      const [x, y] = camera.project(pinPosition(session.input, pin));
      const ratio = canvas.clientWidth / canvas.width;
      return [x * ratio, y * ratio];
    },
    /**
     * A pin moved by a drag: upwards, or along the ground.
     * @param {Pin} pin
     * @param {number} across CSS pixels to the right
     * @param {number} up CSS pixels upwards
     * @param {boolean} onGround whether it keeps its height
     * @returns {Pin}
     */
    movePin: (pin, across, up, onGround) => {
      const pixelsPerSide = (camera.scale * canvas.clientWidth) / canvas.width * (space?.relief('after')?.extent.width ?? 1);
      const [a, b] = [across / pixelsPerSide, up / pixelsPerSide];
      if (!onGround) return { ...pin, z: pin.z + b / (Math.sin(camera.tip) * camera.exaggeration) };
      const [c, s] = [Math.cos(camera.turn), Math.sin(camera.turn)];
      const depth = b / Math.max(MIN_TILT_COSINE, Math.cos(camera.tip));
      return { x: clampToUnit(pin.x + c * a - s * depth), y: clampToUnit(pin.y + s * a + c * depth), z: pin.z };
    },
    /** Shows the layers of a view, or an unfolding. @param {Partial<ViewContent>} now */
    show: (now) => {
      const isOtherUnfolding = now.unfolding !== shown.unfolding;
      shown = now;
      unfoldField.hidden = !now.unfolding;
      if (isOtherUnfolding && space && session.input) {
        space.setMorphingMesh(now.unfolding ?? null);
        camera.box = now.unfolding ? expandBox(now.unfolding, heightfieldBox(session.input)) : heightfieldBox(session.input);
        panel.dataset.unfolding = String(now.unfolding !== undefined);
        if (now.unfolding) animateUnfolding();
      }
      arrange();
      updateLayers();
    },
    /** Shows marks on the input. @param {readonly PixelMarks[]} now */
    setMarks: (now) => {
      marks = now;
      updateLayers();
    },
  };
}

/** Null if the browser has no WebGL 2. @param {HTMLCanvasElement} canvas @param {() => void} onQualityChange */
function createSpace(canvas, onQualityChange) {
  try {
    return new SurfaceRenderer(canvas, onQualityChange);
  } catch {
    return null;
  }
}
