/** Input and result as surfaces in space, one on each side of a divider. */
import { eachFrame, element, elements } from '../dom.js';
import { number, readingOf, strainInWords } from '../format.js';
import { valueOnMesh } from '../surface/anchors.js';
import { Camera } from '../surface/camera.js';
import { takeInHand } from '../surface/gestures.js';
import { inputNormals, resultImage, resultNormals, takenTexels } from '../surface/known.js';
import { gridOf } from '../surface/lattice.js';
import { normalsOf } from '../surface/normals.js';
import { boxAround, boxOf, clamp, heightOn, lengthsOf, pointsOf, reliefOf } from '../surface/relief.js';
import { Space } from '../surface/space.js';

/** @import {Pin} from '../design.js' */
/** @import {Taken} from '../surface/gestures.js' */
/** @import {Input, Result, Session} from '../session.js' */
/** @import {Colour} from '../surface/colours.js' */
/** @import {Layer, Line} from '../surface/layer.js' */
/** @import {Light} from '../surface/light.js' */
/** @import {Marks} from '../surface/marks.js' */
/** @import {Shown} from '../views/shown.js' */

/** What is remembered of the arrangement. */
const MEMORY = 'developable: arrangement';
/** Milliseconds after which nothing moves. */
const REST = 250;
/** Milliseconds from bent to flat, and before it begins. */
const PLAY = 2200;
const WAIT = 500;
/** @type {Colour} */
const TRAIL = [214, 64, 43];
/** Of the way across, for each press of an arrow key. */
const KEY_STEP = 0.05;

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
  const arrangement = elements('input[name="arrangement"]', HTMLInputElement);
  const hints = { flat: element('light-hint', HTMLElement), picture: element('picture-hint', HTMLElement), space: element('space-hint', HTMLElement) };
  const camera = new Camera();
  const space = spaceOn(canvas, () => drawSoon());
  let share = 0.5;
  /** Who takes drags over the surface, and who follows what is drawn. @type {Taken | null} */
  let taken = null;
  /** @type {Taken[]} */
  const takers = [];
  /** What is being drawn on the surface. @type {Line | null} */
  let trail = null;
  /** @type {(() => void)[]} */
  const followers = [];
  /** Counts what moved the slider, to tell the newest. */
  let playing = 0;
  /** @type {Partial<Shown>} */
  let shown = {};
  /** @type {readonly Marks[]} */
  let marks = [];
  const sides = /** @type {const} */ (['before', 'after']);

  const wanted = () => arrangement.find(({ checked }) => checked)?.value === 'space';
  const there = () => space !== null && wanted() && (!shown.after || shown.unfolding !== undefined);
  let rest = 0;
  let resting = false;
  const draw = () => {
    if (!space || panel.hidden || canvas.clientWidth === 0) return;
    const both = space.relief('after') !== null;
    // Of a design there is nothing to be seen before.
    const alone = shown.unfolding !== undefined || session.input?.design === true;
    const seen = both && alone ? 0 : both ? share : 1;
    divider.hidden = !both || alone;
    divider.style.left = `${100 * share}%`;
    space.draw(camera, light, seen, unfold.valueAsNumber);
    for (const follow of followers) follow();
    if (!resting) {
      clearTimeout(rest);
      rest = window.setTimeout(() => {
        resting = true;
        space.rest();
        draw();
        resting = false;
      }, REST);
    }
  };
  const drawSoon = eachFrame(draw);
  /** @param {number} x in the canvas' pixels @returns {'before' | 'after'} */
  const sideAt = (x) => (x < share * canvas.width || !space?.relief('after') ? 'before' : 'after');

  const arrange = () => {
    panel.hidden = !there();
    flat.hidden = there();
    hints.space.hidden = panel.hidden;
    element('flat-reading', HTMLElement).hidden = !panel.hidden;
    hints.flat.hidden = !panel.hidden || (shown.before !== undefined && shown.after !== undefined);
    hints.picture.hidden = !panel.hidden || shown.after === undefined;
    drawSoon();
  };

  if (space) {
    // At once, for a resized canvas is blank.
    new ResizeObserver(draw).observe(canvas);
    light.onMove(drawSoon);
    takeInHand(canvas, camera, {
      changed: drawSoon,
      relight: (x, y) => light.moveTo(x, y),
      tilt: (x, y) => light.moveTo(light.x + 0.08 * x, light.y + 0.08 * y),
      unlit: () => light.reset(),
      lights: () => drag.value === 'light',
      other: {
        begin: (x, y) => {
          taken = takers.find((one) => one.begin(x, y)) ?? null;
          return taken !== null;
        },
        move: (x, y) => taken?.move(x, y),
        end: () => taken?.end(),
      },
    });
    try {
      const remembered = localStorage.getItem(MEMORY);
      for (const radio of arrangement) radio.checked = radio.value === (remembered ?? 'space');
    } catch {
      // Without storage it is forgotten.
    }
  } else {
    element('arrangement', HTMLElement).hidden = true;
    for (const radio of arrangement) radio.checked = radio.value === 'flat';
  }
  for (const radio of arrangement) {
    radio.addEventListener('change', () => {
      arrange();
      try {
        localStorage.setItem(MEMORY, radio.value);
      } catch {
        // Likewise.
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
    camera.above();
    drawSoon();
  });
  element('at-an-angle', HTMLButtonElement).addEventListener('click', () => {
    camera.oblique();
    drawSoon();
  });

  unfold.addEventListener('input', () => {
    playing++;
    drawSoon();
  });
  /** From bent to flat by itself, once, unless that is unwelcome or the slider is taken. */
  const play = () => {
    const turn = ++playing;
    const start = performance.now();
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    unfold.value = still ? '1' : '0';
    /** @param {number} now */
    const step = (now) => {
      if (turn !== playing || !shown.unfolding) return;
      const share = Math.min(1, Math.max(0, (now - start - WAIT) / PLAY));
      unfold.value = String(share * share * (3 - 2 * share));
      draw();
      if (share < 1) requestAnimationFrame(step);
    };
    if (still) drawSoon();
    else requestAnimationFrame(step);
  };

  /** @param {number} to */
  const divide = (to) => {
    share = Math.min(1, Math.max(0, to));
    const percent = Math.round(100 * share);
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
    divide((event.clientX - box.left) / box.width);
  });
  divider.addEventListener('keydown', (event) => {
    const to = { ArrowLeft: share - KEY_STEP, ArrowDown: share - KEY_STEP, ArrowRight: share + KEY_STEP, ArrowUp: share + KEY_STEP, Home: 0, End: 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    divide(to);
  });

  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons !== 0 || !space || panel.hidden) return;
    const ratio = canvas.width / canvas.clientWidth;
    const [x, y] = [event.offsetX * ratio, event.offsetY * ratio];
    if (shown.unfolding) {
      reading.textContent = strainInWords(valueOnMesh(shown.unfolding, unfold.valueAsNumber, camera.sight(x, y), shown.unfolding.strains));
      return;
    }
    const side = sideAt(x);
    const relief = space.relief(side);
    const point = relief && camera.hit(x, y, (px, py) => heightOn(relief, px, py));
    const layer = side === 'before' ? shown.input : shown.result;
    reading.textContent = point ? readingOf(point[2], session.input?.unit, layer?.read?.(point[0], point[1])) : '';
  });
  canvas.addEventListener('pointerleave', () => (reading.textContent = ''));

  const cover = () => {
    if (!space) return;
    const layers = { before: shown.input, after: shown.result };
    for (const side of sides) {
      const layer = layers[side];
      const here = side === 'before' || session.input?.design;
      const points = here && session.input ? pointsOf(marks, session.input) : [];
      space.cover(side, layer?.image ?? null, [...(layer?.lines ?? []), ...points, ...(trail ? [trail] : [])]);
    }
    drawSoon();
  };

  session.on('input', (input) => {
    if (!space) return;
    // A design that is being changed by hand is looked at from where it was.
    if (!input.drawn || session.phase !== 'running') camera.box = boxOf(input);
    space.show('before', reliefOf(input, inputNormals(input), input.data, input.heightScale, takenTexels(input)));
    left.textContent = input.design ? '' : 'Input';
    cover();
  });
  session.on('cleared', () => showResult(null));
  session.on('preview', ({ input, image: { width, height, pixelSize, data } }) => {
    if (!space || !there()) return;
    space.show('after', reliefOf(input, normalsOf(data, width, height, 1 / pixelSize), data, 1));
    right.textContent = 'Result · preview';
    if (input.design) cover();
    drawSoon();
  });
  /** @param {Result | null} result */
  const showResult = (result) => {
    if (!space) return;
    if (!result) {
      space.show('after', null);
      right.textContent = '';
      drawSoon();
      return;
    }
    space.show('after', reliefOf(result.input, resultNormals(result), resultImage(result).data, 1, takenTexels(result)));
    right.textContent = result.surface.report.stopReason === 'cancelled' ? 'Result · cancelled' : 'Result';
    cover();
  };
  session.on('result', showResult);
  // Previews of it are no more.
  session.on('unsolved', () => showResult(session.result));
  arrange();

  return {
    /** Whether surfaces are seen here. */
    there,
    /** The canvas as it is seen, to be copied within the same frame. */
    drawn: () => {
      draw();
      return canvas;
    },
    /** Drags over the surface are somebody's, if he wants them. @param {Taken} by */
    takes: (by) => takers.push(by),
    canvas,
    /** @param {() => void} follow */
    onDraw: (follow) => followers.push(follow),
    tip: () => camera.tip,
    /** The place of the surface at one of the canvas. @param {number} x @param {number} y @returns {Pin | null} */
    placeAt: (x, y) => {
      const { input } = session;
      if (!input) return null;
      const relief = space?.relief(input.design ? 'after' : sideAt(x));
      const point = camera.hit(x, y, (px, py) => (relief ? heightOn(relief, px, py) : 0));
      if (!point) return null;
      const { left: start, top, pixelSize, width, height } = gridOf(input);
      return {
        x: clamp(((point[0] - start) / pixelSize - 0.5) / (width - 1)),
        y: clamp(1 - ((top - point[1]) / pixelSize - 0.5) / (height - 1)),
        z: point[2] / (width * pixelSize),
      };
    },
    /** The height of the result at a pixel, or of the input where there is none, in its steps. */
    seenHeight: () => {
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
     * A line that is being drawn on the surfaces.
     * @param {readonly { x: number, y: number }[]} places
     * @param {boolean} closed
     */
    trail: (places, closed) => {
      const { input } = session;
      const relief = space?.relief('after') ?? space?.relief('before');
      const points = input && relief ? [...places, ...(closed && places[0] ? [places[0]] : [])].map(({ x, y }) => {
        const [px, py] = lengthsOf(input, { x, y, z: 0 });
        const z = heightOn(relief, px, py);
        return /** @type {const} */ ([px, py, Number.isNaN(z) ? camera.middle[2] : z]);
      }) : [];
      trail = points.length > 0 ? { points, colour: TRAIL, width: 4 } : null;
      cover();
    },
    /** How high the surface is, in sides. @param {number} x @param {number} y */
    heightAt: (x, y) => {
      const relief = space?.relief('after');
      const [px, py] = session.input ? lengthsOf(session.input, { x, y, z: 0 }) : [0, 0];
      const z = relief ? heightOn(relief, px, py) : 0;
      return Number.isNaN(z) ? 0 : z / (relief?.extent.width ?? 1);
    },
    /** Where a place is seen, in pixels of the page from the canvas' corner. @param {Pin} pin @returns {[number, number]} */
    seenAt: (pin) => {
      if (!session.input) return [0, 0];
      const [x, y] = camera.seen(lengthsOf(session.input, pin));
      const ratio = canvas.clientWidth / canvas.width;
      return [x * ratio, y * ratio];
    },
    /**
     * A place moved by so many pixels of the page: upwards, or along the ground.
     * @param {Pin} pin
     * @param {number} across
     * @param {number} up
     * @param {boolean} aground
     * @returns {Pin}
     */
    dragged: (pin, across, up, aground) => {
      const dots = (camera.scale * canvas.clientWidth) / canvas.width * (space?.relief('after')?.extent.width ?? 1);
      const [a, b] = [across / dots, up / dots];
      if (!aground) return { ...pin, z: pin.z + b / (Math.sin(camera.tip) * camera.exaggeration) };
      const [c, s] = [Math.cos(camera.turn), Math.sin(camera.turn)];
      const deep = b / Math.max(0.2, Math.cos(camera.tip));
      return { x: clamp(pin.x + c * a - s * deep), y: clamp(pin.y + s * a + c * deep), z: pin.z };
    },
    /** @param {Partial<Shown>} now */
    show: (now) => {
      const anew = now.unfolding !== shown.unfolding;
      shown = now;
      unfoldField.hidden = !now.unfolding;
      if (anew && space && session.input) {
        space.lay(now.unfolding ?? null);
        camera.box = now.unfolding ? boxAround(now.unfolding, boxOf(session.input)) : boxOf(session.input);
        panel.dataset.unfolding = String(now.unfolding !== undefined);
        if (now.unfolding) play();
      }
      arrange();
      cover();
    },
    /** @param {readonly Marks[]} now */
    mark: (now) => {
      marks = now;
      cover();
    },
  };
}

/** Nothing where there is no WebGL 2. @param {HTMLCanvasElement} canvas @param {() => void} finer */
function spaceOn(canvas, finer) {
  try {
    return new Space(canvas, finer);
  } catch {
    return null;
  }
}
