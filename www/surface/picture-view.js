/** Shows a picture in place of a surface: a photo or a flat sheet. */
import { oncePerFrame, matchDevicePixels } from '../dom.js';
import { makeZoomable } from './zoom.js';

/**
 * @typedef {object} Picture
 * @property {string} words description for screen readers
 * @property {(context: CanvasRenderingContext2D, ratio: number) => void} paint `ratio`: device pixels per CSS pixel
 * @property {(canvas: { width: number, height: number }, ratio: number, x: number, y: number) => string} [read] the value at
 *   a place of the canvas, with its name and unit
 */

export class PictureView {
  /** @type {Picture | null} */
  #picture = null;
  #zoomedBox;
  /** Paints the picture again with the next frame. */
  repaint = oncePerFrame(() => this.#paint());

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.#zoomedBox = makeZoomable(canvas, this.repaint);
    // Without delay, since resizing clears the canvas.
    matchDevicePixels(canvas, () => this.#paint());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', this.repaint);
  }

  /** Shows a picture, or none. @param {Picture | null} picture */
  show(picture) {
    this.#picture = picture;
    this.canvas.hidden = picture === null;
    if (picture) this.canvas.setAttribute('aria-label', picture.words);
    this.repaint();
  }

  /** The value under the pointer. @param {MouseEvent} event */
  read({ offsetX, offsetY }) {
    const { canvas } = this;
    const ratio = canvas.width / canvas.clientWidth;
    const { left, top, width, height } = this.#zoomedBox();
    const [x, y] = [((offsetX * ratio - left) / width) * canvas.width, ((offsetY * ratio - top) / height) * canvas.height];
    return this.#picture?.read?.(canvas, ratio, x, y) ?? '';
  }

  #paint() {
    const { canvas } = this;
    const context = canvas.getContext('2d');
    if (!context || !this.#picture || canvas.clientWidth === 0) return;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.save();
    const { left, top, width, height } = this.#zoomedBox();
    context.setTransform(width / canvas.width, 0, 0, height / canvas.height, left, top);
    this.#picture.paint(context, canvas.width / canvas.clientWidth);
    context.restore();
  }
}

/**
 * A picture of an image, scaled to fit the canvas.
 * @param {HTMLCanvasElement | HTMLImageElement} image
 * @param {string} words
 * @param {(x: number, y: number) => string} [value] at a place of the image, in its pixels
 * @returns {Picture}
 */
export function imagePicture(image, words, value) {
  /** The rectangle of the image on a canvas. @param {{ width: number, height: number }} canvas */
  const fittedBox = ({ width, height }) => {
    const scale = Math.min(width / image.width, height / image.height);
    const [w, h] = [image.width * scale, image.height * scale];
    return { scale, left: (width - w) / 2, top: (height - h) / 2, w, h };
  };
  return {
    words,
    paint: (context) => {
      const { scale, left, top, w, h } = fittedBox(context.canvas);
      context.imageSmoothingEnabled = scale < 4;
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, left, top, w, h);
    },
    read: value && ((canvas, _, x, y) => {
      const { scale, left, top, w, h } = fittedBox(canvas);
      return x < left || y < top || x >= left + w || y >= top + h ? '' : value((x - left) / scale, (y - top) / scale);
    }),
  };
}
