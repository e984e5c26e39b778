/** Flat pictures, looked at from closer: by wheel, two fingers, keys, and with Shift moved. */

/** How many times larger, at most. */
const MOST = 40;
const KEY_ZOOM = 1.25;
/** Of the picture, for each press of an arrow key. */
const KEY_STEP = 0.1;
/** @type {Record<string, readonly [number, number]>} */
const ARROWS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** Pixels of the page by which a pointer has moved when that is no click any more. */
const CLICK = 4;

export class Zoom {
  scale = 1;
  /** Of the middle, in shares of the canvas. */
  shift = { x: 0, y: 0 };
  /** @type {(() => void)[]} */
  #listeners = [];

  /** @param {() => void} listener */
  onChange(listener) {
    this.#listeners.push(listener);
  }

  /** Where a box is on a canvas of a size. @param {{ width: number, height: number }} canvas @param {{ left: number, top: number, width: number, height: number }} box */
  placed({ width, height }, box) {
    const { scale, shift } = this;
    return {
      left: width / 2 + (box.left - width / 2) * scale + shift.x * width,
      top: height / 2 + (box.top - height / 2) * scale + shift.y * height,
      width: box.width * scale,
      height: box.height * scale,
    };
  }

  /** What is at a place, in shares of the canvas, stays there. @param {number} factor @param {number} x @param {number} y */
  by(factor, x, y) {
    const scale = Math.min(MOST, Math.max(1, this.scale * factor));
    const change = scale / this.scale;
    this.scale = scale;
    this.#moveTo(x - 0.5 + (this.shift.x - x + 0.5) * change, y - 0.5 + (this.shift.y - y + 0.5) * change);
  }

  /** @param {number} x @param {number} y in shares of the canvas */
  move(x, y) {
    this.#moveTo(this.shift.x + x, this.shift.y + y);
  }

  reset() {
    this.scale = 1;
    this.#moveTo(0, 0);
  }

  /** The middle of the canvas stays covered. @param {number} x @param {number} y */
  #moveTo(x, y) {
    const most = (this.scale - 1) / 2;
    this.shift = { x: Math.min(most, Math.max(-most, x)), y: Math.min(most, Math.max(-most, y)) };
    for (const listener of this.#listeners) listener();
  }
}

/**
 * @param {HTMLElement} canvas or what lies over it; what lies on that is left alone
 * @param {Zoom} zoom
 * @param {{ alone?: boolean }} [how] `alone`: nothing else is done by dragging there, or by arrow keys
 * @returns {() => boolean} whether pointers move or scale the picture, and are nobody else's
 */
export function zoomable(canvas, zoom, { alone = false } = {}) {
  const frame = canvas.closest('.frame') ?? canvas;
  /** @type {Map<number, { x: number, y: number }>} */
  const fingers = new Map();
  let moving = false;
  let from = { x: 0, y: 0 };
  let clicked = true;

  /** @param {MouseEvent} event */
  const placeOf = ({ clientX, clientY }) => {
    const box = frame.getBoundingClientRect();
    return { x: (clientX - box.left) / box.width, y: (clientY - box.top) / box.height };
  };
  const span = () => {
    const [a, b = a] = [...fingers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot((a.x - b.x) * frame.clientWidth, (a.y - b.y) * frame.clientHeight) };
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.target !== canvas) return;
    moving = event.shiftKey || event.button === 1 || event.button === 2 || (alone && zoom.scale > 1);
    from = { x: event.clientX, y: event.clientY };
    clicked = true;
    fingers.set(event.pointerId, placeOf(event));
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    if (Math.hypot(event.clientX - from.x, event.clientY - from.y) > CLICK) clicked = false;
    const before = span();
    fingers.set(event.pointerId, placeOf(event));
    if (fingers.size < 2 && !moving) return;
    const after = span();
    zoom.move(after.x - before.x, after.y - before.y);
    if (fingers.size > 1 && before.apart > 0) zoom.by(after.apart / before.apart, after.x, after.y);
  });
  for (const end of /** @type {const} */ (['pointerup', 'pointercancel'])) {
    canvas.addEventListener(end, ({ pointerId }) => {
      fingers.delete(pointerId);
      if (fingers.size === 0) moving = false;
    });
  }
  // The end of a drag.
  if (alone) canvas.addEventListener('click', (event) => clicked || event.stopImmediatePropagation(), { capture: true });
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    // A page that is scrolled past it goes on being scrolled.
    if (!event.ctrlKey && !canvas.contains(document.activeElement)) return;
    event.preventDefault();
    const { x, y } = placeOf(event);
    zoom.by(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), x, y);
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    if (event.key === '+' || event.key === '=') zoom.by(KEY_ZOOM, 0.5, 0.5);
    else if (event.key === '-') zoom.by(1 / KEY_ZOOM, 0.5, 0.5);
    else if (event.key === '0') zoom.reset();
    else if (alone && event.target === canvas && zoom.scale > 1 && ARROWS[event.key]) {
      const [x, y] = ARROWS[event.key];
      zoom.move(KEY_STEP * x, KEY_STEP * y);
    } else return;
    event.preventDefault();
  });
  return () => moving || fingers.size > 1;
}
