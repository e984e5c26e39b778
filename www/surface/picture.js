/** A picture in the place of a surface: a photo, or a flat sheet. */
import { eachFrame, followDevicePixels } from '../dom.js';
import { zoomable } from './zoom.js';

/** @import {Zoom} from './zoom.js' */

/**
 * @typedef {object} Picture
 * @property {string} title in the place of “Input” or “Result”
 * @property {string} words what is seen
 * @property {(context: CanvasRenderingContext2D, ratio: number) => void} paint `ratio`: pixels of the screen for one of the page
 * @property {(canvas: { width: number, height: number }, ratio: number, x: number, y: number) => string} [read] the value at
 *   a place of the canvas, with its name and unit
 */

export class PictureView {
  /** @type {Picture | null} */
  #picture = null;
  #paintSoon = eachFrame(() => this.#paint());

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Zoom} [zoom]
   * @param {HTMLElement} [over] what lies over the picture
   */
  constructor(canvas, zoom, over = canvas) {
    this.canvas = canvas;
    this.zoom = zoom;
    zoom?.onChange(this.#paintSoon);
    if (zoom) zoomable(over, zoom, { alone: true });
    // At once, for a resized canvas is blank.
    followDevicePixels(canvas, () => this.#paint());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', this.#paintSoon);
  }

  /** @param {Picture | null} picture */
  show(picture) {
    this.#picture = picture;
    this.canvas.hidden = picture === null;
    if (picture) this.canvas.setAttribute('aria-label', picture.words);
    this.#paintSoon();
  }

  /** What is under the pointer. @param {MouseEvent} event */
  read({ offsetX, offsetY }) {
    const { canvas } = this;
    const ratio = canvas.width / canvas.clientWidth;
    const { left, top, width, height } = this.#placed();
    const [x, y] = [((offsetX * ratio - left) / width) * canvas.width, ((offsetY * ratio - top) / height) * canvas.height];
    return this.#picture?.read?.(canvas, ratio, x, y) ?? '';
  }

  /** Where the canvas' own frame is after zooming. */
  #placed() {
    const { canvas: { width, height } } = this;
    const frame = { left: 0, top: 0, width, height };
    return this.zoom?.placed(frame, frame) ?? frame;
  }

  #paint() {
    const { canvas } = this;
    const context = canvas.getContext('2d');
    if (!context || !this.#picture || canvas.clientWidth === 0) return;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.save();
    if (this.zoom) {
      const { left, top, width, height } = this.#placed();
      context.setTransform(width / canvas.width, 0, 0, height / canvas.height, left, top);
    }
    this.#picture.paint(context, canvas.width / canvas.clientWidth);
    context.restore();
  }
}

/**
 * An image as a picture, as large as there is room.
 * @param {HTMLCanvasElement} image
 * @param {string} title
 * @param {string} words
 * @param {(x: number, y: number) => string} [value] at a place of the image, in its pixels
 * @returns {Picture}
 */
export function imagePicture(image, title, words, value) {
  /** @param {{ width: number, height: number }} canvas */
  const placed = ({ width, height }) => {
    const scale = Math.min(width / image.width, height / image.height);
    const [w, h] = [image.width * scale, image.height * scale];
    return { scale, left: (width - w) / 2, top: (height - h) / 2, w, h };
  };
  return {
    title,
    words,
    paint: (context) => {
      const { scale, left, top, w, h } = placed(context.canvas);
      context.imageSmoothingEnabled = scale < 4;
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, left, top, w, h);
    },
    read: value && ((canvas, _, x, y) => {
      const { scale, left, top, w, h } = placed(canvas);
      return x < left || y < top || x >= left + w || y >= top + h ? '' : value((x - left) / scale, (y - top) / scale);
    }),
  };
}
