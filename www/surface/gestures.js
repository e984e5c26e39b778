/** Controls a camera by mouse, touch screen or keyboard. */
import { ARROW_DIRECTIONS, wheelZoomFactor } from './view-keys.js';

/** @import {Camera} from './camera.js' */

/** Rotation for a press of an arrow key. */
const KEY_TURN_RADIANS = Math.PI / 24;
/** Enlargement for a press of + or −. */
const KEY_ZOOM_FACTOR = 1.2;

/**
 * @typedef {object} DragTarget something else on the canvas that can be dragged
 * @property {(x: number, y: number) => boolean} begin whether a drag from this place, in the canvas' pixels, moves it
 * @property {(x: number, y: number) => void} move
 * @property {() => void} end
 */

/**
 * @param {HTMLCanvasElement} canvas
 * @param {Camera} camera
 * @param {{ onChange: () => void, moveLight: (x: number, y: number) => void, shiftLight: (x: number, y: number) => void, resetLight: () => void, controlsLight: () => boolean, dragTarget: DragTarget }} ask
 *   `moveLight`: to a place of the unit disk; `shiftLight`: by a difference; `controlsLight`: whether drags and keys move the light
 */
export function controlCamera(canvas, camera, { onChange, moveLight, shiftLight, resetLight, controlsLight, dragTarget }) {
  /** @type {Map<number, { x: number, y: number }>} */
  const fingers = new Map();
  /** @type {'turn' | 'move' | 'light' | 'other'} */
  let gesture = 'turn';

  /** The place of an event in the canvas' pixels. @param {MouseEvent} event */
  const placeOf = (event) => {
    const box = canvas.getBoundingClientRect();
    const ratio = canvas.width / box.width;
    return { x: (event.clientX - box.left) * ratio, y: (event.clientY - box.top) * ratio };
  };
  /** Moves the light to a place of the canvas. @param {{ x: number, y: number }} place */
  const lightFrom = ({ x, y }) => {
    const radius = Math.min(canvas.width, canvas.height) / 2;
    moveLight((x - canvas.width / 2) / radius, (canvas.height / 2 - y) / radius);
  };
  /** The mean place of all fingers, and the distance of the first two. */
  const span = () => {
    const all = [...fingers.values()];
    const [x, y] = [0, 1].map((k) => all.reduce((sum, finger) => sum + (k ? finger.y : finger.x), 0) / all.length);
    return { x, y, apart: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0 };
  };

  canvas.addEventListener('pointerdown', (event) => {
    if (event.button > 2) return;
    canvas.setPointerCapture(event.pointerId);
    const place = placeOf(event);
    fingers.set(event.pointerId, place);
    if (fingers.size > 1) return;
    if (event.button > 0 || event.shiftKey) gesture = 'move';
    else if (dragTarget.begin(place.x, place.y)) gesture = 'other';
    else gesture = controlsLight() || event.altKey ? 'light' : 'turn';
    if (gesture === 'light') lightFrom(place);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = span();
    const place = placeOf(event);
    const last = fingers.get(event.pointerId) ?? place;
    fingers.set(event.pointerId, place);
    if (fingers.size > 1) {
      const after = span();
      camera.pan(after.x - before.x, after.y - before.y);
      if (before.apart > 0) camera.zoomAt(after.apart / before.apart, after.x, after.y);
      onChange();
    } else if (gesture === 'move') {
      camera.pan(place.x - last.x, place.y - last.y);
      onChange();
    } else if (gesture === 'light') lightFrom(place);
    else if (gesture === 'other') dragTarget.move(place.x, place.y);
    else {
      const radius = Math.min(canvas.width, canvas.height) / 2;
      camera.rotate((place.x - last.x) / radius, (place.y - last.y) / radius);
      onChange();
    }
  });
  /** @param {PointerEvent} event */
  const endPointer = ({ pointerId }) => {
    if (!fingers.delete(pointerId)) return;
    if (gesture === 'other' && fingers.size === 0) dragTarget.end();
  };
  canvas.addEventListener('pointerup', endPointer);
  canvas.addEventListener('pointercancel', endPointer);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());

  canvas.addEventListener('wheel', (event) => {
    // Without focus the wheel scrolls the page.
    if (!event.ctrlKey && document.activeElement !== canvas) return;
    event.preventDefault();
    const { x, y } = placeOf(event);
    camera.zoomAt(wheelZoomFactor(event), x, y);
    onChange();
  }, { passive: false });

  canvas.addEventListener('keydown', (event) => {
    const arrow = ARROW_DIRECTIONS[event.key];
    const [x, y] = [canvas.width / 2, canvas.height / 2];
    if (arrow && (event.altKey || controlsLight())) shiftLight(...arrow);
    else if (arrow && event.shiftKey) camera.pan(0.05 * canvas.width * arrow[0], -0.05 * canvas.height * arrow[1]);
    else if (arrow) camera.rotate(KEY_TURN_RADIANS * arrow[0], -KEY_TURN_RADIANS * arrow[1]);
    else if (event.key === '+' || event.key === '=') camera.zoomAt(KEY_ZOOM_FACTOR, x, y);
    else if (event.key === '-') camera.zoomAt(1 / KEY_ZOOM_FACTOR, x, y);
    else if (event.key === 'Home' && controlsLight()) resetLight();
    else if (event.key === 'Home') camera.viewObliquely();
    else return;
    event.preventDefault();
    onChange();
  });
}
