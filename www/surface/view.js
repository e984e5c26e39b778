/** One surface on a canvas, lit by the shared light, which can be moved from here. */
import { eachFrame, followDevicePixels } from '../dom.js';
import { drawLines } from './layer.js';
import { markedCanvas } from './marks.js';
import { rasterOf } from './raster.js';
import { zoomable } from './zoom.js';

/** @import {Light} from './light.js' */
/** @import {Normals} from './normals.js' */
/** @import {Layer} from './layer.js' */
/** @import {Marks} from './marks.js' */
/** @import {Raster} from './raster.js' */
/** @import {Zoom} from './zoom.js' */

/** Pixels for each one of a picture that is soon replaced by a finer one. */
const COARSE = 2;
/** Of the way from the middle to the rim, for each press of an arrow key. */
const KEY_STEP = 0.08;
/** @type {Record<string, readonly [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class SurfaceView {
  /** @type {Normals | null} */
  #normals = null;
  /** @type {{ width: number, height: number } | null} */
  #frame = null;
  /** @type {Raster | null} */
  #raster = null;
  /** The raster, shaded; the canvas shows it reduced to its own pixels. */
  #shaded = document.createElement('canvas');
  /** @type {ImageData | null} */
  #pixels = null;
  /** What is drawn over the surface. @type {readonly Marks[]} */
  #marks = [];
  /** The same in the canvas' pixels. @type {HTMLCanvasElement | null} */
  #overlay = null;
  /** @type {Layer | null} */
  #layer = null;
  #lit = false;
  #paintSoon = eachFrame(() => this.#paint());

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Light} light
   * @param {Zoom} zoom
   */
  constructor(canvas, light, zoom) {
    this.canvas = canvas;
    this.light = light;
    this.zoom = zoom;
    zoom.onChange(this.#paintSoon);
    const sun = canvas.parentElement?.querySelector('.sun');
    this.sun = sun instanceof HTMLElement ? sun : null;
    canvas.setAttribute('aria-valuemin', '0');
    canvas.setAttribute('aria-valuemax', '359');
    followDevicePixels(canvas, () => {
      this.#raster = null;
      this.#overlay = null;
      // At once, for a resized canvas is blank.
      this.#paint();
    });
    light.onMove(() => {
      this.#paintSoon();
      this.#tell();
    });
    this.#listen();
    this.#tell();
  }

  /**
   * @param {Normals | null} normals
   * @param {boolean} [lit] whether there is much to be lit
   * @param {{ width: number, height: number } | null} [frame] in whose proportions, where there are coarser normals
   */
  show(normals, lit = normals !== null, frame = normals) {
    this.#normals = normals;
    this.#frame = frame;
    this.#raster = null;
    this.#overlay = null;
    this.#lit = lit;
    this.#shine();
    this.#paintSoon();
  }

  /**
   * Makes room for a picture in its place.
   * @param {boolean} aside
   */
  setAside(aside) {
    this.canvas.hidden = aside;
    this.#shine();
  }

  #shine() {
    if (this.sun) this.sun.hidden = !this.#lit || this.canvas.hidden;
  }

  /**
   * Marks pixels of what is shown.
   * @param {readonly Marks[]} marks
   */
  mark(marks) {
    this.#marks = marks;
    this.#overlay = null;
    this.#paintSoon();
  }

  /**
   * Draws a layer over the surface, until another is drawn.
   * @param {Layer | null} layer
   */
  cover(layer) {
    this.#layer = layer;
    this.#paintSoon();
  }

  #paint() {
    const { canvas } = this;
    const context = canvas.getContext('2d');
    if (!context) return;
    context.clearRect(0, 0, canvas.width, canvas.height);
    const [normals, frame] = [this.#normals, this.#frame];
    if (!normals || !frame || canvas.clientWidth === 0) return;
    const fit = Math.min(canvas.width / frame.width, canvas.height / frame.height);
    const coarse = frame !== normals;
    const density = (fit * frame.width) / normals.width;
    this.#raster ??= rasterOf(normals, coarse ? Math.min(density, COARSE) : density);
    this.#shade(this.#raster);
    const plain = { width: Math.max(1, Math.round(frame.width * fit)), height: Math.max(1, Math.round(frame.height * fit)) };
    const { left, top, width, height } = this.#place(plain);
    context.imageSmoothingEnabled = this.#raster.width !== width || this.#raster.height !== height;
    context.imageSmoothingQuality = 'medium';
    const layer = this.#layer;
    if (layer?.image) {
      context.drawImage(layer.image, left, top, width, height);
      // The shape shows through, and the colours stay what they are in the legend, nearly.
      context.globalCompositeOperation = 'soft-light';
      context.globalAlpha = 0.5;
    }
    context.drawImage(this.#shaded, left, top, width, height);
    context.globalCompositeOperation = 'source-over';
    context.globalAlpha = 1;
    if (layer?.lines) {
      const { grid, lines } = layer;
      const scale = width / (grid.width * grid.pixelSize);
      drawLines(context, (x, y) => [left + (x - grid.left) * scale, top + (grid.top - y) * scale], lines, window.devicePixelRatio);
    }
    if (this.#marks.length === 0) return;
    this.#overlay ??= markedCanvas(this.#marks, plain.width, plain.height, window.devicePixelRatio);
    context.drawImage(this.#overlay, left, top, width, height);
  }

  /** Where the surface is on the canvas. @param {{ width: number, height: number }} size as it is without zoom */
  #place({ width, height }) {
    const { canvas } = this;
    return this.zoom.placed(canvas, {
      left: Math.floor((canvas.width - width) / 2), top: Math.floor((canvas.height - height) / 2), width, height,
    });
  }

  /**
   * What is under the pointer, in shares of the surface from its upper left corner.
   * @param {MouseEvent} event
   * @returns {[number, number] | null}
   */
  under({ offsetX, offsetY }) {
    const { canvas } = this;
    const frame = this.#frame;
    if (!frame) return null;
    const fit = Math.min(canvas.width / frame.width, canvas.height / frame.height);
    const { left, top, width, height } = this.#place({ width: frame.width * fit, height: frame.height * fit });
    const ratio = canvas.width / canvas.clientWidth;
    const [x, y] = [(offsetX * ratio - left) / width, (offsetY * ratio - top) / height];
    return x >= 0 && y >= 0 && x < 1 && y < 1 ? [x, y] : null;
  }

  /** @param {Raster} raster */
  #shade({ width, height, index }) {
    const context = this.#shaded.getContext('2d');
    if (!context) return;
    if (this.#pixels?.width !== width || this.#pixels.height !== height) {
      this.#shaded.width = width;
      this.#shaded.height = height;
      this.#pixels = context.createImageData(width, height);
    }
    const pixels = this.#pixels;
    const out = new Uint32Array(pixels.data.buffer);
    const colours = this.light.colours();
    for (let i = 0; i < out.length; i++) out[i] = colours[index[i]];
    context.putImageData(pixels, 0, 0);
  }

  /** Says and shows where the light is. */
  #tell() {
    const { canvas, light, sun } = this;
    canvas.setAttribute('aria-valuenow', String(light.azimuth));
    canvas.setAttribute('aria-valuetext', String(light));
    sun?.style.setProperty('--x', String(light.x));
    sun?.style.setProperty('--y', String(light.y));
  }

  #listen() {
    const { canvas, light } = this;
    /** @param {PointerEvent} event */
    const follow = (event) => {
      const box = canvas.getBoundingClientRect();
      const radius = Math.min(box.width, box.height) / 2;
      light.moveTo(
        (event.clientX - box.left - box.width / 2) / radius,
        (box.top + box.height / 2 - event.clientY) / radius,
      );
    };
    const zooms = zoomable(canvas, this.zoom);
    canvas.addEventListener('pointerdown', (event) => {
      if (event.button === 0 && !zooms()) follow(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (canvas.hasPointerCapture(event.pointerId) && !zooms()) follow(event);
    });
    canvas.addEventListener('keydown', (event) => {
      const arrow = ARROWS[event.key];
      if (arrow) light.moveTo(light.x + KEY_STEP * arrow[0], light.y + KEY_STEP * arrow[1]);
      else if (event.key === 'Home') light.reset();
      else return;
      event.preventDefault();
    });
  }
}
