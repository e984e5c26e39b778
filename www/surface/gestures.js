/** Keys of a view in space, and drags with Alt, which move the light; three.js moves the camera itself. */
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
 * @param {HTMLCanvasElement} canvas
 * @param {SceneView} view
 */
export function addGestures(canvas, view) {
  /** The pointer that holds the light; others, such as a second finger, are ignored. */
  let holder = -1;
  /** @param {PointerEvent} event */
  const lightFrom = ({ offsetX, offsetY }) => {
    const { clientWidth: width, clientHeight: height } = canvas;
    const radius = Math.min(width, height) / 2;
    light.moveTo((offsetX - width / 2) / radius, (height / 2 - offsetY) / radius);
  };
  // Before the listeners of three.js, which move the camera.
  canvas.addEventListener('pointerdown', (event) => {
    if (holder >= 0 || event.button !== 0 || !event.altKey) return;
    event.stopImmediatePropagation();
    holder = event.pointerId;
    canvas.setPointerCapture(holder);
    lightFrom(event);
  }, { capture: true });
  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerId === holder) lightFrom(event);
  });
  for (const end of /** @type {const} */ (['pointerup', 'pointercancel'])) {
    canvas.addEventListener(end, ({ pointerId }) => {
      if (pointerId === holder) holder = -1;
    });
  }
  canvas.addEventListener('wheel', (event) => {
    // Without focus the wheel scrolls the page.
    if (!event.ctrlKey && document.activeElement !== canvas) event.stopImmediatePropagation();
  }, { capture: true, passive: true });
  canvas.addEventListener('keydown', (event) => {
    const arrow = ARROW_DIRECTIONS[event.key];
    if (arrow && event.altKey) light.moveTo(light.x + KEY_LIGHT_STEP * arrow[0], light.y + KEY_LIGHT_STEP * arrow[1]);
    else if (arrow && event.shiftKey) view.pan(KEY_PAN_SHARE * canvas.clientWidth * arrow[0], -KEY_PAN_SHARE * canvas.clientHeight * arrow[1]);
    else if (arrow) view.turn(KEY_TURN_RADIANS * arrow[0], -KEY_TURN_RADIANS * arrow[1]);
    else if (event.key === '+' || event.key === '=') view.zoom(KEY_ZOOM_FACTOR);
    else if (event.key === '-') view.zoom(1 / KEY_ZOOM_FACTOR);
    else if (event.key === 'Home' && event.altKey) light.reset();
    else if (event.key === 'Home') view.look();
    else return;
    event.preventDefault();
  });
}
