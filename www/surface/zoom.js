/** Zooms and moves flat pictures by wheel, two fingers, keys, and dragging with Shift. */

/** Direction of each arrow key: x to the right, y up. @type {Record<string, readonly [x: number, y: number]>} */
export const ARROW_DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** Zoom per pixel and per line that the wheel scrolls, as a logarithm. */
const WHEEL_ZOOM_PER_PIXEL = 0.0015;
const WHEEL_ZOOM_PER_LINE = 0.05;
/** Maximum enlargement. */
const MAX_ZOOM = 40;
/** Enlargement for a press of +. */
const KEY_ZOOM_FACTOR = 1.25;
/** Movement for a press of an arrow key, as a share of the picture. */
const KEY_MOVE_SHARE = 0.1;
/** Maximum movement of the pointer in a click, in CSS pixels. */
const MAX_CLICK_MOVE_PIXELS = 4;

export class Zoom {
  scale = 1;
  /** Shift of the centre, as shares of the canvas. */
  shift = { x: 0, y: 0 };
  /** @type {(() => void)[]} */
  #listeners = [];

  /** @param {() => void} listener */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /** The zoomed rectangle of a box on a canvas. @param {{ width: number, height: number }} canvas @param {{ left: number, top: number, width: number, height: number }} box */
  transformBox({ width, height }, box) {
    const { scale, shift } = this;
    return {
      left: width / 2 + (box.left - width / 2) * scale + shift.x * width,
      top: height / 2 + (box.top - height / 2) * scale + shift.y * height,
      width: box.width * scale,
      height: box.height * scale,
    };
  }

  /** Zooms about a fixed place, given as shares of the canvas. @param {number} factor @param {number} x @param {number} y */
  zoomAt(factor, x, y) {
    const scale = Math.min(MAX_ZOOM, Math.max(1, this.scale * factor));
    const change = scale / this.scale;
    this.scale = scale;
    this.#moveTo(x - 0.5 + (this.shift.x - x + 0.5) * change, y - 0.5 + (this.shift.y - y + 0.5) * change);
  }

  /** Moves the picture. @param {number} x @param {number} y as shares of the canvas */
  move(x, y) {
    this.#moveTo(this.shift.x + x, this.shift.y + y);
  }

  reset() {
    this.scale = 1;
    this.#moveTo(0, 0);
  }

  /** Sets the shift, limited so that the picture covers the centre of the canvas. @param {number} x @param {number} y */
  #moveTo(x, y) {
    const maxShift = (this.scale - 1) / 2;
    this.shift = { x: Math.min(maxShift, Math.max(-maxShift, x)), y: Math.min(maxShift, Math.max(-maxShift, y)) };
    for (const listener of this.#listeners) listener();
  }
}

/**
 * Lets the user zoom and move a picture.
 * @param {HTMLElement} canvas the canvas or an element over it; events of its children are ignored
 * @param {Zoom} zoom
 * @param {{ exclusive?: boolean }} [how] `exclusive`: dragging and arrow keys have no other function there
 * @returns {() => boolean} whether the pointers are moving or zooming the picture
 */
export function makeZoomable(canvas, zoom, { exclusive = false } = {}) {
  const frame = canvas.closest('.frame') ?? canvas;
  /** @type {Map<number, { x: number, y: number }>} */
  const fingers = new Map();
  let moving = false;
  let start = { x: 0, y: 0 };
  let clicked = true;

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
    if (event.target !== canvas) return;
    moving = event.shiftKey || event.button === 1 || event.button === 2 || (exclusive && zoom.scale > 1);
    start = { x: event.clientX, y: event.clientY };
    clicked = true;
    fingers.set(event.pointerId, placeOf(event));
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    if (Math.hypot(event.clientX - start.x, event.clientY - start.y) > MAX_CLICK_MOVE_PIXELS) clicked = false;
    const before = pinch();
    fingers.set(event.pointerId, placeOf(event));
    if (fingers.size < 2 && !moving) return;
    const after = pinch();
    zoom.move(after.x - before.x, after.y - before.y);
    if (fingers.size > 1 && before.apart > 0) zoom.zoomAt(after.apart / before.apart, after.x, after.y);
  });
  for (const end of /** @type {const} */ (['pointerup', 'pointercancel'])) {
    canvas.addEventListener(end, ({ pointerId }) => {
      fingers.delete(pointerId);
      if (fingers.size === 0) moving = false;
    });
  }
  // The click at the end of a drag is suppressed.
  if (exclusive) canvas.addEventListener('click', (event) => clicked || event.stopImmediatePropagation(), { capture: true });
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    // Without focus the wheel scrolls the page.
    if (!event.ctrlKey && !canvas.contains(document.activeElement)) return;
    event.preventDefault();
    const { x, y } = placeOf(event);
    zoom.zoomAt(wheelZoomFactor(event), x, y);
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    if (event.key === '+' || event.key === '=') zoom.zoomAt(KEY_ZOOM_FACTOR, 0.5, 0.5);
    else if (event.key === '-') zoom.zoomAt(1 / KEY_ZOOM_FACTOR, 0.5, 0.5);
    else if (event.key === '0') zoom.reset();
    else if (exclusive && event.target === canvas && zoom.scale > 1 && ARROW_DIRECTIONS[event.key]) {
      const [x, y] = ARROW_DIRECTIONS[event.key];
      zoom.move(-KEY_MOVE_SHARE * x, KEY_MOVE_SHARE * y);
    } else return;
    event.preventDefault();
  });
  return () => moving || fingers.size > 1;
}

/** The factor by which a turn of the wheel enlarges a picture. @param {WheelEvent} event */
function wheelZoomFactor({ deltaY, deltaMode }) {
  return Math.exp(-deltaY * (deltaMode === WheelEvent.DOM_DELTA_LINE ? WHEEL_ZOOM_PER_LINE : WHEEL_ZOOM_PER_PIXEL));
}
