/** Keys of a view in space, and drags that move something else than its camera, which three.js moves itself. */
import { light } from './light.js';
import { ARROW_DIRECTIONS } from './zoom.js';

/** @import {SceneView} from './scene.js' */

/** Rotation for a press of an arrow key. */
const KEY_TURN_RADIANS = Math.PI / 24;
/** Enlargement for a press of + or −. */
const KEY_ZOOM_FACTOR = 1.2;
/** Movement for a press of an arrow key with Shift, as a share of the canvas. */
const KEY_PAN_SHARE = 0.05;
/** Distance that an arrow key moves the light, in radii of the disk of its directions. */
const KEY_LIGHT_STEP = 0.08;

/**
 * @typedef {object} DragTarget something on the canvas that can be dragged
 * @property {(x: number, y: number) => boolean} begin whether a drag from this place, in CSS pixels, moves it
 * @property {(x: number, y: number) => void} move
 * @property {() => void} end
 */

/**
 * @param {HTMLCanvasElement} canvas
 * @param {SceneView} view
 * @param {{ controlsLight?: () => boolean, target?: DragTarget }} options as of a scene
 */
export function addGestures(canvas, view, { controlsLight = () => false, target }) {
  /** What the pointer holds. @type {'light' | 'target' | null} */
  let held = null;
  /** The pointer that holds it; others, such as a second finger, are ignored. */
  let holder = -1;
  /** @param {PointerEvent} event */
  const lightFrom = ({ offsetX, offsetY }) => {
    const { clientWidth: width, clientHeight: height } = canvas;
    const radius = Math.min(width, height) / 2;
    light.moveTo((offsetX - width / 2) / radius, (height / 2 - offsetY) / radius);
  };
  // Before the listeners of three.js, which move the camera.
  canvas.addEventListener('pointerdown', (event) => {
    if (held || event.button !== 0 || !event.isPrimary || event.shiftKey) return;
    if (target?.begin(event.offsetX, event.offsetY)) held = 'target';
    else if (controlsLight() || event.altKey) held = 'light';
    else return;
    event.stopImmediatePropagation();
    holder = event.pointerId;
    canvas.setPointerCapture(event.pointerId);
    if (held === 'light') lightFrom(event);
  }, { capture: true });
  // The style sheet lets a finger scroll the page up and down, but a stroke goes on.
  canvas.addEventListener('touchstart', (event) => {
    if (held === 'target') event.preventDefault();
  }, { passive: false });
  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerId !== holder) return;
    if (held === 'light') lightFrom(event);
    else if (held === 'target') target?.move(event.offsetX, event.offsetY);
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => {
      if (/** @type {PointerEvent} */ (event).pointerId !== holder) return;
      if (held === 'target') target?.end();
      [held, holder] = [null, -1];
    });
  }
  canvas.addEventListener('wheel', (event) => {
    // Without focus the wheel scrolls the page.
    if (!event.ctrlKey && document.activeElement !== canvas) event.stopImmediatePropagation();
  }, { capture: true, passive: true });
  canvas.addEventListener('keydown', (event) => {
    const arrow = ARROW_DIRECTIONS[event.key];
    const movesLight = event.altKey || controlsLight();
    if (arrow && movesLight) light.moveTo(light.x + KEY_LIGHT_STEP * arrow[0], light.y + KEY_LIGHT_STEP * arrow[1]);
    else if (arrow && event.shiftKey) view.pan(KEY_PAN_SHARE * canvas.clientWidth * arrow[0], -KEY_PAN_SHARE * canvas.clientHeight * arrow[1]);
    else if (arrow) view.turn(KEY_TURN_RADIANS * arrow[0], -KEY_TURN_RADIANS * arrow[1]);
    else if (event.key === '+' || event.key === '=') view.zoom(KEY_ZOOM_FACTOR);
    else if (event.key === '-') view.zoom(1 / KEY_ZOOM_FACTOR);
    else if (event.key === 'Home' && movesLight) light.reset();
    else if (event.key === 'Home') view.look();
    else return;
    event.preventDefault();
  });
}
