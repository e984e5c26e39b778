/** A camera in the hands of a mouse, a touch screen or a keyboard. */

/** @import {Camera} from './camera.js' */

/** Radians for each press of an arrow key, and how much nearer for each of + and −. */
const KEY_TURN = Math.PI / 24;
const KEY_ZOOM = 1.2;
/** @type {Record<string, readonly [number, number]>} to the right and up */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * @typedef {object} Taken over by who wants to drag something else
 * @property {(x: number, y: number) => boolean} begin at a place in the canvas' pixels
 * @property {(x: number, y: number) => void} move
 * @property {() => void} end
 */

/**
 * @param {HTMLCanvasElement} canvas
 * @param {Camera} camera
 * @param {{ changed: () => void, relight: (x: number, y: number) => void, tilt: (x: number, y: number) => void, unlit: () => void, lights: () => boolean, other: Taken }} ask
 *   `relight`: the light, as a place of the disk; `tilt`: by so much
 */
export function takeInHand(canvas, camera, { changed, relight, tilt, unlit, lights, other }) {
  /** @type {Map<number, { x: number, y: number }>} */
  const fingers = new Map();
  /** @type {'turn' | 'move' | 'light' | 'other'} */
  let doing = 'turn';

  /** In the canvas' pixels. @param {MouseEvent} event */
  const placeOf = (event) => {
    const box = canvas.getBoundingClientRect();
    const ratio = canvas.width / box.width;
    return { x: (event.clientX - box.left) * ratio, y: (event.clientY - box.top) * ratio };
  };
  /** @param {{ x: number, y: number }} place */
  const shine = ({ x, y }) => {
    const radius = Math.min(canvas.width, canvas.height) / 2;
    relight((x - canvas.width / 2) / radius, (canvas.height / 2 - y) / radius);
  };
  /** Middle of all fingers, and how far they are apart. */
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
    if (event.button > 0 || event.shiftKey) doing = 'move';
    else if (other.begin(place.x, place.y)) doing = 'other';
    else doing = lights() || event.altKey ? 'light' : 'turn';
    if (doing === 'light') shine(place);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = span();
    const place = placeOf(event);
    const last = fingers.get(event.pointerId) ?? place;
    fingers.set(event.pointerId, place);
    if (fingers.size > 1) {
      const after = span();
      camera.move(after.x - before.x, after.y - before.y);
      if (before.apart > 0) camera.scaleAt(after.apart / before.apart, after.x, after.y);
      changed();
    } else if (doing === 'move') {
      camera.move(place.x - last.x, place.y - last.y);
      changed();
    } else if (doing === 'light') shine(place);
    else if (doing === 'other') other.move(place.x, place.y);
    else {
      const radius = Math.min(canvas.width, canvas.height) / 2;
      camera.rotate((place.x - last.x) / radius, (place.y - last.y) / radius);
      changed();
    }
  });
  /** @param {PointerEvent} event */
  const lift = ({ pointerId }) => {
    if (!fingers.delete(pointerId)) return;
    if (doing === 'other' && fingers.size === 0) other.end();
  };
  canvas.addEventListener('pointerup', lift);
  canvas.addEventListener('pointercancel', lift);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());

  canvas.addEventListener('wheel', (event) => {
    // A page that is scrolled past it goes on being scrolled.
    if (!event.ctrlKey && document.activeElement !== canvas) return;
    event.preventDefault();
    const { x, y } = placeOf(event);
    camera.scaleAt(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), x, y);
    changed();
  }, { passive: false });

  canvas.addEventListener('keydown', (event) => {
    const arrow = ARROWS[event.key];
    const [x, y] = [canvas.width / 2, canvas.height / 2];
    if (arrow && (event.altKey || lights())) tilt(...arrow);
    else if (arrow && event.shiftKey) camera.move(0.05 * canvas.width * arrow[0], -0.05 * canvas.height * arrow[1]);
    else if (arrow) camera.rotate(KEY_TURN * arrow[0], -KEY_TURN * arrow[1]);
    else if (event.key === '+' || event.key === '=') camera.scaleAt(KEY_ZOOM, x, y);
    else if (event.key === '-') camera.scaleAt(1 / KEY_ZOOM, x, y);
    else if (event.key === 'Home' && lights()) unlit();
    else if (event.key === 'Home') camera.oblique();
    else return;
    event.preventDefault();
    changed();
  });
}
