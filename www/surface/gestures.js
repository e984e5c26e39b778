/** Keys of a view in space; three.js moves the camera by the pointer itself. */
import { ARROW_DIRECTIONS } from './zoom.js';

/** @import {SceneView} from './scene.js' */

/** Rotation for a press of an arrow key. */
const KEY_TURN_RADIANS = Math.PI / 24;
/** Enlargement for a press of + or −. */
const KEY_ZOOM_FACTOR = 1.2;
/** Movement for a press of an arrow key with Shift, as a share of the canvas. */
const KEY_PAN_SHARE = 0.05;

/**
 * @param {HTMLCanvasElement} canvas
 * @param {SceneView} view
 */
export function addGestures(canvas, view) {
  canvas.addEventListener('wheel', (event) => {
    // Without focus the wheel scrolls the page.
    if (!event.ctrlKey && document.activeElement !== canvas) event.stopImmediatePropagation();
  }, { capture: true, passive: true });
  canvas.addEventListener('keydown', (event) => {
    const arrow = ARROW_DIRECTIONS[event.key];
    if (arrow && event.shiftKey) view.pan(KEY_PAN_SHARE * canvas.clientWidth * arrow[0], -KEY_PAN_SHARE * canvas.clientHeight * arrow[1]);
    else if (arrow) view.turn(KEY_TURN_RADIANS * arrow[0], -KEY_TURN_RADIANS * arrow[1]);
    else if (event.key === '+' || event.key === '=') view.zoom(KEY_ZOOM_FACTOR);
    else if (event.key === '-') view.zoom(1 / KEY_ZOOM_FACTOR);
    else if (event.key === 'Home') view.look();
    else return;
    event.preventDefault();
  });
}
