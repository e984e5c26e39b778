/** Pictures that a worker has made, on canvases of the page, which cannot go there. */
import { DevelopableError, messageOf } from './errors.js';
import { show } from './values.js';

/** @typedef {CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D} Context */

/**
 * A canvas' context; the same errors as in the wasm, which has its own way for the direct API.
 * @param {unknown} canvas
 * @returns {Context}
 */
export function contextOf(canvas) {
  if (!isCanvas(canvas)) {
    throw new DevelopableError('INPUT', `the canvas must be an HTMLCanvasElement or an OffscreenCanvas, but is ${show(canvas)}`);
  }
  try {
    const context = canvas.getContext('2d');
    if (context) return /** @type {Context} */ (context);
  } catch {
    // It was handed over.
  }
  throw new DevelopableError('INPUT', 'the canvas has no 2d context: it has one of another kind, or was handed over');
}

/**
 * @param {Context} context
 * @param {import('./types.js').SurfacePicture} picture
 */
export function put(context, picture) {
  try {
    context.canvas.width = picture.width;
    context.canvas.height = picture.height;
    context.putImageData(picture, 0, 0);
  } catch (cause) {
    throw new DevelopableError('INPUT', `the picture cannot be shown: ${messageOf(cause)}`, { cause });
  }
}

/**
 * @param {unknown} value
 * @returns {value is HTMLCanvasElement | OffscreenCanvas}
 */
function isCanvas(value) {
  try {
    return (
      (typeof HTMLCanvasElement === 'function' && value instanceof HTMLCanvasElement) ||
      (typeof OffscreenCanvas === 'function' && value instanceof OffscreenCanvas)
    );
  } catch {
    return false; // a proxy that has been revoked
  }
}
