/** Handles over a photo: points that are dragged by mouse, pen or finger, or moved by the arrow keys, and the lines through them. Dragging a line makes a new point. */
import { make } from '../dom.js';
import { ARROW_DIRECTIONS } from '../surface/zoom.js';
import { Magnifier } from './magnifier.js';

/** @import {Pixels} from './magnifier.js' */
/** @typedef {readonly [x: number, y: number]} Place in pixels of the photo */
/** @typedef {{ x: number, y: number, name: string, kind: 'corner' | 'bend' }} Handle */
/** @typedef {{ points: readonly Place[], kind: 'edge' | 'side' | 'text', pullId?: number }} Line `pullId`: passed to `pull` when the line is dragged; without it the line cannot be dragged */
/** @typedef {{ handles: readonly Handle[], lines: readonly Line[] }} HandleOverlay */
/**
 * @typedef {object} HandleCallbacks
 * @property {(handle: number, to: [number, number], ended: boolean) => void} move `ended`: whether the drag has ended
 * @property {(pulls: number, place: [number, number]) => number} pull makes a handle at a place of a line and returns its index
 * @property {(handle: number) => void} remove
 * @property {(handle: number) => void} choose the handle has got the focus
 */

/** Movement for a press of an arrow key, in CSS pixels; ten times as much with Shift. */
const ARROW_STEP_PIXELS = 0.5;
/** Distance that the pointer must move before a line counts as dragged, in CSS pixels. */
const MIN_PULL_PIXELS = 4;
/** Margin around places outside the photo, as a share of the photo's side. */
const OUTSIDE_MARGIN_SHARE = 0.03;

export class Handles {
  /** @type {Pixels} */
  #photo = { width: 1, height: 1, data: new Uint8ClampedArray(4) };
  /** @type {HandleOverlay} */
  #overlay = { handles: [], lines: [] };
  /** @type {HTMLButtonElement[]} */
  #buttons = [];
  #svg = svgElement('svg', { 'aria-hidden': 'true' });
  #magnifier;
  #callbacks;

  /** @param {HTMLElement} box element that covers the photo exactly @param {HandleCallbacks} callbacks */
  constructor(box, callbacks) {
    this.box = box;
    this.#callbacks = callbacks;
    box.append(this.#svg);
    this.#magnifier = new Magnifier(box);
    this.#listenForPulls();
  }

  /** Sets the photo that the handles are on. @param {Pixels} photo */
  setPhoto(photo) {
    this.#photo = photo;
    this.#magnifier.hide();
    this.#svg.setAttribute('viewBox', `-0.5 -0.5 ${photo.width} ${photo.height}`);
    this.box.style.setProperty('--aspect', String(photo.width / photo.height));
  }

  /** Draws handles and lines in place of the earlier ones. @param {HandleOverlay} overlay */
  draw(overlay) {
    this.#overlay = overlay;
    const { handles, lines } = overlay;
    while (this.#buttons.length > handles.length) this.#buttons.pop()?.remove();
    while (this.#buttons.length < handles.length) this.#addHandle(this.#buttons.length);
    handles.forEach(({ x, y, name, kind }, i) => {
      const button = this.#buttons[i];
      button.className = `handle ${kind}`;
      button.style.setProperty('--x', String((x + 0.5) / this.#photo.width));
      button.style.setProperty('--y', String((y + 0.5) / this.#photo.height));
      button.setAttribute('aria-label', `${name}, at ${Math.round(x)}, ${Math.round(y)}`);
    });
    this.#svg.replaceChildren(...lines.flatMap(({ points, kind, pullId }) => {
      const d = `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join('L')}`;
      // Detected lines of text lie close together: without a halo, or they would cover the photo.
      const halo = kind === 'text' ? [] : [svgElement('path', { d, class: 'under' })];
      const drawn = [...halo, svgElement('path', { d, class: kind })];
      return pullId === undefined ? drawn : [...drawn, svgElement('path', { d, class: 'grip', 'data-pulls': String(pullId) })];
    }));
  }

  /** Shrinks the photo inside its frame until places outside the photo are visible in the frame. @param {readonly Place[]} places */
  showWithin(places) {
    const { width, height } = this.#photo;
    // Relative to the centre, as shares of the photo's sides.
    const positions = places.map(([x, y]) => [(x + 0.5) / width - 0.5, (y + 0.5) / height - 0.5]);
    const bounds = [0, 1].map((k) => [Math.min(-0.5, ...positions.map((place) => place[k] - OUTSIDE_MARGIN_SHARE)), Math.max(0.5, ...positions.map((place) => place[k] + OUTSIDE_MARGIN_SHARE))]);
    const outside = positions.some((place) => Math.max(...place.map(Math.abs)) > 0.5);
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

  /** Pixels of the photo per CSS pixel. */
  get #scale() {
    return this.#photo.width / this.box.clientWidth;
  }

  /** Shows the magnifier at a handle. @param {number} handle */
  #magnify(handle) {
    const { handles, lines } = this.#overlay;
    const { x, y } = handles[handle];
    this.#magnifier.show(this.#photo, [x, y], lines.map(({ points }) => points));
  }

  /** The place of a pointer event in pixels of the photo. @param {MouseEvent} event @returns {[number, number]} */
  photoPosition({ clientX, clientY }) {
    const { left, top } = this.box.getBoundingClientRect();
    return [(clientX - left) * this.#scale - 0.5, (clientY - top) * this.#scale - 0.5];
  }

  /** The index of the handle nearest to an event: handles overlap under a finger. @param {PointerEvent} event */
  #nearest(event) {
    const [x, y] = this.photoPosition(event);
    const off = this.#overlay.handles.map((handle) => Math.hypot(handle.x - x, handle.y - y));
    return off.indexOf(Math.min(...off));
  }

  /** Creates the button of a handle. @param {number} handle its index */
  #addHandle(handle) {
    const button = make('button', 'handle');
    button.type = 'button';
    this.#buttons.push(button);
    this.box.append(button);
    button.addEventListener('focus', () => this.#callbacks.choose(handle));
    button.addEventListener('blur', () => this.#magnifier.hide());
    button.addEventListener('pointerdown', (event) => {
      if (event.button === 0) this.#drag(event, button, this.#nearest(event));
    });
    button.addEventListener('keydown', (event) => {
      const arrow = ARROW_DIRECTIONS[event.key];
      if (arrow) {
        const step = Math.max(1, ARROW_STEP_PIXELS * this.#scale) * (event.shiftKey ? 10 : 1);
        const { x, y } = this.#overlay.handles[handle];
        this.#callbacks.move(handle, [x + step * arrow[0], y - step * arrow[1]], true);
        this.#magnify(handle);
      } else if (event.key === 'Delete' || event.key === 'Backspace') {
        this.#callbacks.remove(handle);
      } else if (event.key === 'Escape') {
        this.#magnifier.hide();
      } else return;
      event.preventDefault();
    });
  }

  /**
   * Drags a handle until the pointer is lifted. The handle keeps its offset from the pointer, so that a finger need not cover it.
   * @param {PointerEvent} event that started the drag
   * @param {GlobalEventHandlers & Element} holder element that captures the pointer
   * @param {number} handle
   * @param {PointerEvent} [since] latest move of the pointer, if it has moved already
   */
  #drag(event, holder, handle, since) {
    const { x, y } = this.#overlay.handles[handle];
    const [px, py] = this.photoPosition(event);
    /** @param {PointerEvent} moved @returns {[number, number]} */
    const to = (moved) => {
      const [u, v] = this.photoPosition(moved);
      return [x + u - px, y + v - py];
    };
    holder.setPointerCapture(event.pointerId);
    this.#buttons[handle]?.focus({ preventScroll: true });
    this.#magnify(handle);
    const drag = new AbortController();
    const follow = (/** @type {PointerEvent} */ moved) => {
      if (moved.pointerId !== event.pointerId) return;
      this.#callbacks.move(handle, to(moved), false);
      this.#magnify(handle);
    };
    const end = (/** @type {PointerEvent} */ last) => {
      if (last.pointerId !== event.pointerId) return;
      drag.abort();
      this.#magnifier.hide();
      const now = this.#overlay.handles[handle];
      // A click without a move does not move the handle.
      if (now.x !== x || now.y !== y) this.#callbacks.move(handle, [now.x, now.y], true);
    };
    const { signal } = drag;
    holder.addEventListener('pointermove', follow, { signal });
    for (const type of /** @type {const} */ (['pointerup', 'pointercancel'])) holder.addEventListener(type, end, { signal });
    // A quick drag may have only one move event, which has already happened.
    if (since) follow(since);
    event.preventDefault();
  }

  /** Starts a drag when a line is pulled. */
  #listenForPulls() {
    const svg = this.#svg;
    svg.addEventListener('pointerdown', (event) => {
      const pulls = event.target instanceof Element ? event.target.getAttribute('data-pulls') : null;
      if (event.button !== 0 || pulls === null) return;
      // The root element captures the pointer: the line's own element is replaced while it is dragged.
      svg.setPointerCapture(event.pointerId);
      const pending = new AbortController();
      const { signal } = pending;
      svg.addEventListener('pointermove', (moved) => {
        if (moved.pointerId !== event.pointerId || Math.hypot(moved.clientX - event.clientX, moved.clientY - event.clientY) < MIN_PULL_PIXELS) return;
        pending.abort();
        const handle = this.#callbacks.pull(Number(pulls), this.photoPosition(event));
        if (handle >= 0) this.#drag(event, svg, handle, moved);
      }, { signal });
      for (const type of /** @type {const} */ (['pointerup', 'pointercancel'])) svg.addEventListener(type, () => pending.abort(), { signal });
      event.preventDefault();
    });
  }
}

/** Creates an SVG element. @template {keyof SVGElementTagNameMap} T @param {T} name @param {Record<string, string>} attributes */
function svgElement(name, attributes) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}
