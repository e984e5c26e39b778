/** A picture in the place of a surface: a photo, or a flat sheet. */
import { eachFrame, followDevicePixels } from '../dom.js';
import { zoomable } from './zoom.js';

/** @import {Zoom} from './zoom.js' */

/**
 * @typedef {object} Picture
 * @property {string} title in the place of “Input” or “Result”
 * @property {string} words what is seen
 * @property {(context: CanvasRenderingContext2D, ratio: number) => void} paint `ratio`: pixels of the screen for one of the page
 */

export class PictureView {
  /** @type {Picture | null} */
  #picture = null;
  #paintSoon = eachFrame(() => this.#paint());

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Zoom} [zoom] none where something else lies over the picture
   */
  constructor(canvas, zoom) {
    this.canvas = canvas;
    this.zoom = zoom;
    zoom?.onChange(this.#paintSoon);
    if (zoom) zoomable(canvas, zoom);
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

  #paint() {
    const { canvas } = this;
    const context = canvas.getContext('2d');
    if (!context || !this.#picture || canvas.clientWidth === 0) return;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.save();
    if (this.zoom) {
      const { left, top, width, height } = this.zoom.placed(canvas, { left: 0, top: 0, width: canvas.width, height: canvas.height });
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
 * @returns {Picture}
 */
export function imagePicture(image, title, words) {
  return {
    title,
    words,
    paint: (context) => {
      const { width, height } = context.canvas;
      const scale = Math.min(width / image.width, height / image.height);
      const [w, h] = [image.width * scale, image.height * scale];
      context.imageSmoothingEnabled = scale < 4;
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, (width - w) / 2, (height - h) / 2, w, h);
    },
  };
}
