/** Keys of pictures, and how flat ones are zoomed and moved by wheel, two fingers, keys, and dragging once they are enlarged. */

/** Direction of each arrow key: x to the right, y up. @type {Record<string, readonly [x: number, y: number]>} */
export const ARROW_DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** Zoom per pixel and per line that the wheel scrolls, as a logarithm. */
const WHEEL_ZOOM_PER_PIXEL = 0.0015;
const WHEEL_ZOOM_PER_LINE = 0.05;
/** Maximum enlargement. */
export const MAX_ZOOM = 60;
/** Enlargement for a press of +. */
const KEY_ZOOM_FACTOR = 1.25;
/** Movement for a press of an arrow key, as a share of the picture. */
export const KEY_MOVE_SHARE = 0.05;

/**
 * Keys of a picture, flat or in space: arrows, + and −, 0 or Home for all of it. Without focus the wheel scrolls the page.
 * @param {HTMLCanvasElement} canvas
 * @param {object} view
 * @param {(across: number, up: number, isShift: boolean) => boolean | void} view.move false if it cannot be moved
 * @param {(factor: number) => void} view.zoom
 * @param {() => void} view.reset
 */
export function addPictureKeys(canvas, { move, zoom, reset }) {
  canvas.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && document.activeElement !== canvas) event.stopImmediatePropagation();
  }, { capture: true, passive: true });
  canvas.addEventListener('keydown', (event) => {
    const arrow = ARROW_DIRECTIONS[event.key];
    if (event.key === '+' || event.key === '=') zoom(KEY_ZOOM_FACTOR);
    else if (event.key === '-') zoom(1 / KEY_ZOOM_FACTOR);
    else if (event.key === '0' || event.key === 'Home') reset();
    else if (!arrow || move(...arrow, event.shiftKey) === false) return;
    event.preventDefault();
  });
}

/**
 * Lets the user zoom and move a picture.
 * @param {HTMLCanvasElement} canvas
 * @param {() => void} onChange
 * @returns {() => { left: number, top: number, width: number, height: number }} the rectangle of the whole canvas after zooming, in its pixels
 */
export function makeZoomable(canvas, onChange) {
  const frame = canvas.closest('.frame') ?? canvas;
  let scale = 1;
  /** Shift of the centre, as shares of the canvas. */
  let shift = { x: 0, y: 0 };
  /** @type {Map<number, { x: number, y: number }>} */
  const fingers = new Map();

  /** Moves the picture, which keeps the centre of the canvas covered. @param {number} x @param {number} y as shares of the canvas */
  const move = (x, y) => {
    const maxShift = (scale - 1) / 2;
    shift = { x: Math.min(maxShift, Math.max(-maxShift, shift.x + x)), y: Math.min(maxShift, Math.max(-maxShift, shift.y + y)) };
    onChange();
  };
  /** Zooms about a fixed place, given as shares of the canvas. @param {number} factor @param {{ x: number, y: number }} place */
  const zoomAt = (factor, { x, y }) => {
    const before = scale;
    scale = Math.min(MAX_ZOOM, Math.max(1, scale * factor));
    const growth = scale / before - 1;
    move((shift.x - x + 0.5) * growth, (shift.y - y + 0.5) * growth);
  };
  /** @param {MouseEvent} event */
  const placeOf = ({ clientX, clientY }) => {
    const box = frame.getBoundingClientRect();
    return { x: (clientX - box.left) / box.width, y: (clientY - box.top) / box.height };
  };
  const pinch = () => {
    const [a, b = a] = [...fingers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot((a.x - b.x) * frame.clientWidth, (a.y - b.y) * frame.clientHeight) };
  };
  canvas.addEventListener('pointerdown', (event) => {
    fingers.set(event.pointerId, placeOf(event));
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = pinch();
    fingers.set(event.pointerId, placeOf(event));
    const after = pinch();
    move(after.x - before.x, after.y - before.y);
    if (fingers.size > 1 && before.apart > 0) zoomAt(after.apart / before.apart, after);
  });
  for (const end of /** @type {const} */ (['pointerup', 'pointercancel'])) canvas.addEventListener(end, ({ pointerId }) => fingers.delete(pointerId));
  addPictureKeys(canvas, {
    move: (across, up) => scale > 1 && move(-KEY_MOVE_SHARE * across, KEY_MOVE_SHARE * up),
    zoom: (factor) => zoomAt(factor, { x: 0.5, y: 0.5 }),
    reset: () => zoomAt(0, { x: 0.5, y: 0.5 }),
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoomAt(Math.exp(-event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? WHEEL_ZOOM_PER_LINE : WHEEL_ZOOM_PER_PIXEL)), placeOf(event));
  }, { passive: false });
  return () => {
    const [width, height] = [canvas.width * scale, canvas.height * scale];
    return { left: (canvas.width - width) / 2 + shift.x * canvas.width, top: (canvas.height - height) / 2 + shift.y * canvas.height, width, height };
  };
}
