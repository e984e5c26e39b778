/** Flat pictures, looked at from closer: by wheel, two fingers, keys, and with Shift moved. */

/** How many times larger, at most. */
const MOST = 40;
const KEY_ZOOM = 1.25;

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
 * @param {HTMLCanvasElement} canvas
 * @param {Zoom} zoom
 * @returns {() => boolean} whether pointers move or scale the picture, and are nobody else's
 */
export function zoomable(canvas, zoom) {
  /** @type {Map<number, { x: number, y: number }>} */
  const fingers = new Map();
  let moving = false;

  /** @param {MouseEvent} event */
  const placeOf = ({ clientX, clientY }) => {
    const box = canvas.getBoundingClientRect();
    return { x: (clientX - box.left) / box.width, y: (clientY - box.top) / box.height };
  };
  const span = () => {
    const [a, b = a] = [...fingers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot((a.x - b.x) * canvas.clientWidth, (a.y - b.y) * canvas.clientHeight) };
  };
  canvas.addEventListener('pointerdown', (event) => {
    moving = event.shiftKey || event.button === 1 || event.button === 2;
    fingers.set(event.pointerId, placeOf(event));
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
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
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    // A page that is scrolled past it goes on being scrolled.
    if (!event.ctrlKey && document.activeElement !== canvas) return;
    event.preventDefault();
    const { x, y } = placeOf(event);
    zoom.by(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), x, y);
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    if (event.key === '+' || event.key === '=') zoom.by(KEY_ZOOM, 0.5, 0.5);
    else if (event.key === '-') zoom.by(1 / KEY_ZOOM, 0.5, 0.5);
    else if (event.key === '0') zoom.reset();
    else return;
    event.preventDefault();
  });
  return () => moving || fingers.size > 1;
}
