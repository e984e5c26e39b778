/** Photos as programs have them: pixels, files, and what a page draws. */
import { isBlob, copyOfFile } from './file-bytes.js';
import { DevelopableError, messageOf } from './errors.js';
import { asPicture } from './mesh-input.js';
import { reading, show } from './values.js';

/**
 * Things of a page that a canvas can draw, and their size in pixels.
 * @type {Record<string, (source: any) => [number, number]>}
 */
const DRAWN = {
  HTMLImageElement: ({ naturalWidth, naturalHeight }) => [naturalWidth, naturalHeight],
  HTMLVideoElement: ({ videoWidth, videoHeight }) => [videoWidth, videoHeight],
  HTMLCanvasElement: ({ width, height }) => [width, height],
  OffscreenCanvas: ({ width, height }) => [width, height],
  ImageBitmap: ({ width, height }) => [width, height],
  VideoFrame: ({ displayWidth, displayHeight }) => [displayWidth, displayHeight],
};

/**
 * A photo as its pixels or the bytes of its file.
 * @param {unknown} source
 * @returns {Promise<Uint8Array | import('./types.js').Photo & { film35?: number }>}
 */
export async function photoOf(source) {
  const size = reading('INPUT', 'the photo', () => {
    const found = Object.keys(DRAWN).find((name) => {
      const type = Reflect.get(globalThis, name);
      return typeof type === 'function' && source instanceof type;
    });
    return found && DRAWN[found](source);
  });
  if (size) return drawn(/** @type {CanvasImageSource} */ (source), size);
  if (isFile(source)) return fileOf(source);
  // Pixels stay as they are: those who need no copy make none.
  asPicture(source);
  return /** @type {import('./types.js').Photo} */ (source);
}

/**
 * The bytes of a photo's file, which may be a Blob, a Response, or at an address.
 * @param {unknown} source
 * @returns {Promise<Uint8Array<ArrayBuffer>>}
 */
export async function fileOf(source) {
  try {
    if (typeof source === 'string' || source instanceof URL) return await fileOf(await fetch(source));
    if (!isResponse(source)) return await copyOfFile(/** @type {Blob} */ (source));
    if (!source.ok) throw new Error(`the server answers ${source.status} ${source.statusText}`);
    return new Uint8Array(await source.arrayBuffer());
  } catch (cause) {
    if (cause instanceof DevelopableError) throw cause;
    throw new DevelopableError('INPUT', `the photo could not be read: ${messageOf(cause)}`, { cause });
  }
}

/** Whether it is a file or where one is, and no pixels or bytes. @param {unknown} source */
function isFile(source) {
  return typeof source === 'string' || isBlob(source) || reading('INPUT', 'the photo', () => source instanceof URL || isResponse(source));
}

/** @param {unknown} source @returns {source is Response} */
const isResponse = (source) => typeof Response === 'function' && source instanceof Response;

/**
 * The pixels of what a canvas can draw.
 * @param {CanvasImageSource} source
 * @param {[number, number]} size
 * @returns {import('./types.js').Photo}
 */
function drawn(source, [width, height]) {
  if (!(width > 0 && height > 0)) throw new DevelopableError('EMPTY', `the photo has no pixels yet (${show(source)}): wait until it is loaded`);
  try {
    const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    if (!context) throw new Error('there is no 2d context');
    context.drawImage(source, 0, 0, width, height);
    const { data } = context.getImageData(0, 0, width, height);
    return { width, height, data };
  } catch (cause) {
    throw new DevelopableError('INPUT', `the photo's pixels cannot be read: ${messageOf(cause)}`, { cause });
  }
}
