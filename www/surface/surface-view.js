/** Shows a surface on a canvas under the shared light, which can be moved from here. */
import { oncePerFrame, matchDevicePixels } from '../dom.js';
import { drawLines } from './layer.js';
import { drawMarks } from './marks.js';
import { rasteriseNormals } from './raster.js';
import { ARROW_DIRECTIONS } from './view-keys.js';
import { makeZoomable } from './zoom.js';

/** @import {Light} from './light.js' */
/** @import {Normals} from './normals.js' */
/** @import {Layer} from './layer.js' */
/** @import {PixelMarks} from './marks.js' */
/** @import {NormalRaster} from './raster.js' */
/** @import {Zoom} from './zoom.js' */

/** Maximum number of raster pixels per pixel of a preview, along a side: a finer picture replaces it soon. */
const MAX_PREVIEW_DENSITY = 2;
/** Movement of the light for a press of an arrow key, in radii of the disk. */
const KEY_LIGHT_STEP = 0.08;

export class SurfaceView {
  /** @type {Normals | null} */
  #normals = null;
  /** @type {{ width: number, height: number } | null} */
  #frame = null;
  /** @type {NormalRaster | null} */
  #raster = null;
  /** The shaded raster, which the canvas shows at its own size. */
  #shadedCanvas = document.createElement('canvas');
  /** @type {ImageData | null} */
  #pixels = null;
  /** Marked pixels over the surface. @type {readonly PixelMarks[]} */
  #marks = [];
  /** The marks drawn in the canvas' pixels; null until they are. @type {HTMLCanvasElement | null} */
  #overlay = null;
  /** @type {Layer | null} */
  #layer = null;
  #hasLight = false;
  #paintSoon = oncePerFrame(() => this.#paint());

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
    matchDevicePixels(canvas, () => {
      this.#raster = null;
      this.#overlay = null;
      // Without delay, since resizing clears the canvas.
      this.#paint();
    });
    light.onMove(() => {
      this.#paintSoon();
      this.#describeLight();
    });
    this.#listen();
    this.#describeLight();
  }

  /**
   * Shows a surface.
   * @param {Normals | null} normals
   * @param {boolean} [lit] whether the position of the light is shown
   * @param {{ width: number, height: number } | null} [frame] full size of the surface, if the normals are those of a preview
   */
  show(normals, lit = normals !== null, frame = normals) {
    this.#normals = normals;
    this.#frame = frame;
    this.#raster = null;
    this.#overlay = null;
    this.#hasLight = lit;
    this.#updateSun();
    this.#paintSoon();
  }

  /**
   * Hides the surface where a picture is shown instead.
   * @param {boolean} aside
   */
  setAside(aside) {
    this.canvas.hidden = aside;
    this.#updateSun();
  }

  /** Shows the position of the light only on a visible surface. */
  #updateSun() {
    if (this.sun) this.sun.hidden = !this.#hasLight || this.canvas.hidden;
  }

  /**
   * Marks pixels of the surface.
   * @param {readonly PixelMarks[]} marks
   */
  setMarks(marks) {
    this.#marks = marks;
    this.#overlay = null;
    this.#paintSoon();
  }

  /**
   * Replaces the layer over the surface.
   * @param {Layer | null} layer
   */
  setLayer(layer) {
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
    this.#raster ??= rasteriseNormals(normals, coarse ? Math.min(density, MAX_PREVIEW_DENSITY) : density);
    this.#shade(this.#raster);
    const unzoomed = { width: Math.max(1, Math.round(frame.width * fit)), height: Math.max(1, Math.round(frame.height * fit)) };
    const { left, top, width, height } = this.#placement(unzoomed);
    context.imageSmoothingEnabled = this.#raster.width !== width || this.#raster.height !== height;
    context.imageSmoothingQuality = 'medium';
    const layer = this.#layer;
    if (layer?.image) {
      context.drawImage(layer.image, left, top, width, height);
      // Soft light at half opacity shows the shape and nearly keeps the colours of the legend.
      context.globalCompositeOperation = 'soft-light';
      context.globalAlpha = 0.5;
    }
    context.drawImage(this.#shadedCanvas, left, top, width, height);
    context.globalCompositeOperation = 'source-over';
    context.globalAlpha = 1;
    if (layer?.lines) {
      const { grid, lines } = layer;
      const scale = width / (grid.width * grid.pixelSize);
      drawLines(context, (x, y) => [left + (x - grid.left) * scale, top + (grid.top - y) * scale], lines, window.devicePixelRatio);
    }
    if (this.#marks.length === 0) return;
    this.#overlay ??= drawMarks(this.#marks, unzoomed.width, unzoomed.height, window.devicePixelRatio);
    context.drawImage(this.#overlay, left, top, width, height);
  }

  /** The rectangle of the surface on the canvas. @param {{ width: number, height: number }} size without zoom */
  #placement({ width, height }) {
    const { canvas } = this;
    return this.zoom.transformBox(canvas, {
      left: Math.floor((canvas.width - width) / 2), top: Math.floor((canvas.height - height) / 2), width, height,
    });
  }

  /**
   * The place under the pointer, as shares of the surface's width and height from its upper left corner; null outside.
   * @param {MouseEvent} event
   * @returns {[number, number] | null}
   */
  positionAt({ offsetX, offsetY }) {
    const { canvas } = this;
    const frame = this.#frame;
    if (!frame) return null;
    const fit = Math.min(canvas.width / frame.width, canvas.height / frame.height);
    const { left, top, width, height } = this.#placement({ width: frame.width * fit, height: frame.height * fit });
    const ratio = canvas.width / canvas.clientWidth;
    const [x, y] = [(offsetX * ratio - left) / width, (offsetY * ratio - top) / height];
    return x >= 0 && y >= 0 && x < 1 && y < 1 ? [x, y] : null;
  }

  /** Colours a raster under the light. @param {NormalRaster} raster */
  #shade({ width, height, index }) {
    const context = this.#shadedCanvas.getContext('2d');
    if (!context) return;
    if (this.#pixels?.width !== width || this.#pixels.height !== height) {
      this.#shadedCanvas.width = width;
      this.#shadedCanvas.height = height;
      this.#pixels = context.createImageData(width, height);
    }
    const pixels = this.#pixels;
    const out = new Uint32Array(pixels.data.buffer);
    const colours = this.light.colours();
    for (let i = 0; i < out.length; i++) out[i] = colours[index[i]];
    context.putImageData(pixels, 0, 0);
  }

  /** Updates the direction of the light for screen readers and the mark of its position. */
  #describeLight() {
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
    const zooms = makeZoomable(canvas, this.zoom);
    canvas.addEventListener('pointerdown', (event) => {
      if (event.button === 0 && !zooms()) follow(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (canvas.hasPointerCapture(event.pointerId) && !zooms()) follow(event);
    });
    canvas.addEventListener('keydown', (event) => {
      const arrow = ARROW_DIRECTIONS[event.key];
      if (arrow) light.moveTo(light.x + KEY_LIGHT_STEP * arrow[0], light.y + KEY_LIGHT_STEP * arrow[1]);
      else if (event.key === 'Home') light.reset();
      else return;
      event.preventDefault();
    });
  }
}
