/**
 * Points on a photo that are dragged by mouse, pen or finger, or moved by the arrow keys, and the lines through them,
 * which can be pulled into new points.
 */
import { make } from '../dom.js';
import { Magnifier } from './magnifier.js';

/** @import {Pixels} from './magnifier.js' */
/** @typedef {readonly [x: number, y: number]} Place in pixels of the photo */
/** @typedef {{ x: number, y: number, name: string, kind: 'corner' | 'bend' | 'text', held?: boolean }} Handle */
/** @typedef {{ points: readonly Place[], kind: 'edge' | 'side' | 'text' | 'text drawn' | 'text against', pulls?: number }} Line `pulls`: what is told when it is pulled */
/** @typedef {{ handles: readonly Handle[], lines: readonly Line[] }} Drawing */
/**
 * @typedef {object} Doings
 * @property {(handle: number, to: [number, number], how: { key: boolean, ended: boolean }) => void} move
 * @property {(pulls: number, place: [number, number]) => number} [pull] makes a handle there, and tells which it is
 * @property {(handle: number) => void} [remove]
 * @property {(handle: number) => void} [choose] it has the focus now
 * @property {(place: [number, number]) => number} [begin] makes a handle where the photo itself is dragged, and tells which it
 *   is; none, if it says less than 0
 */

/** Pixels of the page for a press of an arrow key; with Shift it is ten times as much. */
const STEP = 0.5;
/** Pixels of the page by which a line is pulled before that counts. */
const PULL = 4;
/** Room around places outside the photo, as a share of its side. */
const RIM = 0.03;
/** @type {Record<string, readonly [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export class Handles {
  /** @type {Pixels} */
  #photo = { width: 1, height: 1, data: new Uint8ClampedArray(4) };
  /** @type {Drawing} */
  #drawing = { handles: [], lines: [] };
  /** @type {HTMLButtonElement[]} */
  #buttons = [];
  /** Whether a drag over the photo begins something new. */
  drawing = false;
  #svg = shape('svg', { 'aria-hidden': 'true' });
  #magnifier;
  #doings;

  /**
   * @param {HTMLElement} box exactly over the photo
   * @param {Doings} doings
   */
  constructor(box, doings) {
    this.box = box;
    this.#doings = doings;
    box.append(this.#svg);
    this.#magnifier = new Magnifier(box);
    this.#pulled();
  }

  /** @param {Pixels} photo */
  on(photo) {
    this.#photo = photo;
    this.#magnifier.hide();
    this.#svg.setAttribute('viewBox', `-0.5 -0.5 ${photo.width} ${photo.height}`);
    this.box.style.setProperty('--aspect', String(photo.width / photo.height));
  }

  /** @param {Drawing} drawing */
  draw(drawing) {
    this.#drawing = drawing;
    const { handles, lines } = drawing;
    while (this.#buttons.length > handles.length) this.#buttons.pop()?.remove();
    while (this.#buttons.length < handles.length) this.#add(this.#buttons.length);
    handles.forEach(({ x, y, name, kind, held = false }, i) => {
      const button = this.#buttons[i];
      button.className = `handle ${kind}${held ? ' held' : ''}`;
      button.style.setProperty('--x', String((x + 0.5) / this.#photo.width));
      button.style.setProperty('--y', String((y + 0.5) / this.#photo.height));
      button.setAttribute('aria-label', `${name}, at ${Math.round(x)}, ${Math.round(y)}`);
    });
    this.#svg.replaceChildren(...lines.flatMap(({ points, kind, pulls }) => {
      const d = `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}`;
      // What is found lies close together: no rim, or nothing is left of the photo.
      const rims = kind === 'text' || kind === 'text against' ? [] : [shape('path', { d, class: 'under' })];
      const seen = [...rims, shape('path', { d, class: kind })];
      return pulls === undefined ? seen : [...seen, shape('path', { d, class: 'grip', 'data-pulls': String(pulls) })];
    }));
  }

  /**
   * Reduces the photo in its frame until places outside of it are in the frame, too.
   * @param {readonly Place[]} places
   */
  fit(places) {
    const { width, height } = this.#photo;
    // From the middle, in sides of the photo.
    const far = places.map(([x, y]) => [(x + 0.5) / width - 0.5, (y + 0.5) / height - 0.5]);
    const bounds = [0, 1].map((k) => [Math.min(-0.5, ...far.map((place) => place[k] - RIM)), Math.max(0.5, ...far.map((place) => place[k] + RIM))]);
    const outside = far.some((place) => Math.max(...place.map(Math.abs)) > 0.5);
    const zoom = outside ? 1 / Math.max(...bounds.map(([low, high]) => high - low)) : 1;
    this.box.style.setProperty('--zoom', String(zoom));
    ['--across', '--down'].forEach((name, k) => {
      this.box.style.setProperty(name, String(outside ? (-zoom * (bounds[k][0] + bounds[k][1])) / 2 : 0));
    });
  }

  /** @param {number} handle */
  focus(handle) {
    this.#buttons[handle]?.focus();
  }

  /** Pixels of the photo for one of the page. */
  get #scale() {
    return this.#photo.width / this.box.clientWidth;
  }

  /** @param {number} handle */
  #magnify(handle) {
    const { handles, lines } = this.#drawing;
    const { x, y } = handles[handle];
    this.#magnifier.show(this.#photo, [x, y], lines.map(({ points }) => points));
  }

  /**
   * Where in the photo something happened.
   * @param {MouseEvent} event
   * @returns {[number, number]}
   */
  place({ clientX, clientY }) {
    const { left, top } = this.box.getBoundingClientRect();
    return [(clientX - left) * this.#scale - 0.5, (clientY - top) * this.#scale - 0.5];
  }

  /** Of handles that overlap, as they do under a finger, the one that is meant. @param {PointerEvent} event */
  #nearest(event) {
    const [x, y] = this.place(event);
    const off = this.#drawing.handles.map((handle) => Math.hypot(handle.x - x, handle.y - y));
    return off.indexOf(Math.min(...off));
  }

  /** @param {number} handle */
  #add(handle) {
    const button = make('button', 'handle');
    button.type = 'button';
    this.#buttons.push(button);
    this.box.append(button);
    button.addEventListener('focus', () => this.#doings.choose?.(handle));
    button.addEventListener('blur', () => this.#magnifier.hide());
    button.addEventListener('pointerdown', (event) => {
      if (event.button === 0) this.#drag(event, button, this.#nearest(event));
    });
    button.addEventListener('keydown', (event) => {
      const arrow = ARROWS[event.key];
      if (arrow) {
        const step = Math.max(1, STEP * this.#scale) * (event.shiftKey ? 10 : 1);
        const { x, y } = this.#drawing.handles[handle];
        this.#doings.move(handle, [x + step * arrow[0], y + step * arrow[1]], { key: true, ended: true });
        this.#magnify(handle);
      } else if (event.key === 'Delete' || event.key === 'Backspace') {
        this.#doings.remove?.(handle);
      } else if (event.key === 'Escape') {
        this.#magnifier.hide();
      } else return;
      event.preventDefault();
    });
  }

  /**
   * From where it is taken hold of, so that the finger may stay beside it.
   * @param {PointerEvent} event
   * @param {Element} holder of the pointer
   * @param {number} handle
   * @param {PointerEvent} [since] where the pointer is by now
   */
  #drag(event, holder, handle, since) {
    const { x, y } = this.#drawing.handles[handle];
    const [px, py] = this.place(event);
    /** @param {PointerEvent} moved @returns {[number, number]} */
    const to = (moved) => {
      const [u, v] = this.place(moved);
      return [x + u - px, y + v - py];
    };
    holder.setPointerCapture(event.pointerId);
    this.#buttons[handle]?.focus({ preventScroll: true });
    this.#magnify(handle);
    const over = new AbortController();
    /** @param {Event} next */
    const follow = (next) => {
      const moved = /** @type {PointerEvent} */ (next);
      if (moved.pointerId !== event.pointerId) return;
      this.#doings.move(handle, to(moved), { key: false, ended: false });
      this.#magnify(handle);
    };
    /** @param {Event} next */
    const end = (next) => {
      const last = /** @type {PointerEvent} */ (next);
      if (last.pointerId !== event.pointerId) return;
      over.abort();
      this.#magnifier.hide();
      const now = this.#drawing.handles[handle];
      // A click alone moves nothing.
      if (now.x !== x || now.y !== y) this.#doings.move(handle, [now.x, now.y], { key: false, ended: true });
    };
    const { signal } = over;
    holder.addEventListener('pointermove', follow, { signal });
    for (const type of ['pointerup', 'pointercancel']) holder.addEventListener(type, end, { signal });
    // A quick finger is heard of once before it leaves.
    if (since) follow(since);
    event.preventDefault();
  }

  /** Lets lines be pulled. */
  #pulled() {
    const svg = this.#svg;
    svg.addEventListener('pointerdown', (event) => {
      const pulls = event.target instanceof Element ? event.target.getAttribute('data-pulls') : null;
      const { pull, begin } = this.#doings;
      if (event.button !== 0) return;
      /** @param {[number, number]} place */
      const start = (place) => begin?.(place) ?? -1;
      const make = this.drawing ? start : pulls !== null && pull ? (/** @type {[number, number]} */ place) => pull(Number(pulls), place) : null;
      if (!make) return;
      // The line itself is drawn anew meanwhile.
      svg.setPointerCapture(event.pointerId);
      const over = new AbortController();
      const { signal } = over;
      svg.addEventListener('pointermove', (moved) => {
        if (moved.pointerId !== event.pointerId || Math.hypot(moved.clientX - event.clientX, moved.clientY - event.clientY) < PULL) return;
        over.abort();
        const handle = make(this.place(event));
        if (handle >= 0) this.#drag(event, svg, handle, moved);
      }, { signal });
      for (const type of /** @type {const} */ (['pointerup', 'pointercancel'])) svg.addEventListener(type, () => over.abort(), { signal });
      event.preventDefault();
    });
  }
}

/**
 * @template {keyof SVGElementTagNameMap} T
 * @param {T} name
 * @param {Record<string, string>} attributes
 */
function shape(name, attributes) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}
