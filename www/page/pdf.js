/** The pages of PDFs as pictures, by pdf.js, which is loaded with the first of them. */
import { stemOf } from '../file-kinds.js';
import { MAX_REDUCED_PHOTO_PIXELS } from './photo.js';

/** Dots in an inch of the pictures, as office scanners have them; a page has 72 points in an inch. */
const [DOTS, POINTS] = [300, 72];

/** Decoders that pdf.js asks for where a page has such pictures. */
const DECODERS = { 'jbig2.wasm': new URL('../vendor/pdf-jbig2.wasm', import.meta.url), 'openjpeg.wasm': new URL('../vendor/pdf-openjpeg.wasm', import.meta.url), 'qcms_bg.wasm': new URL('../vendor/pdf-qcms.wasm', import.meta.url) };
class Decoders {
  /** @param {{ filename: string }} wanted */
  async fetch({ filename }) {
    if (!Object.hasOwn(DECODERS, filename)) throw new Error(`${filename} does not come along`);
    return new Uint8Array(await (await fetch(DECODERS[/** @type {keyof typeof DECODERS} */ (filename)])).arrayBuffer());
  }
}

/** The pages of a PDF as pictures. @param {File} file @param {AbortSignal} signal @returns {Promise<File[]>} */
export async function picturesOfPdf(file, signal) {
  const { getDocument, GlobalWorkerOptions } = await import(new URL('../vendor/pdf-client.js', import.meta.url).href);
  GlobalWorkerOptions.workerSrc = new URL('../vendor/pdf-worker.js', import.meta.url).href;
  const task = getDocument({ data: new Uint8Array(await file.arrayBuffer()), BinaryDataFactory: Decoders, isEvalSupported: false, verbosity: 0 });
  try {
    const document = await task.promise;
    const pictures = [];
    for (let number = 1; number <= document.numPages && !signal.aborted; number++) {
      const page = await document.getPage(number);
      const [left, bottom, right, top] = page.view;
      const scale = Math.min(DOTS / POINTS, Math.sqrt(MAX_REDUCED_PHOTO_PIXELS / ((right - left) * (top - bottom))));
      const viewport = page.getViewport({ scale });
      const canvas = new OffscreenCanvas(Math.floor(viewport.width), Math.floor(viewport.height));
      await page.render({ canvasContext: canvas.getContext('2d'), canvas: null, viewport }).promise;
      const name = `${stemOf(file)}${document.numPages > 1 ? `-${number}` : ''}.jpg`;
      pictures.push(new File([await canvas.convertToBlob({ type: 'image/jpeg', quality: 1 })], name, { type: 'image/jpeg', lastModified: file.lastModified }));
    }
    return pictures;
  } catch (error) {
    const { name, message } = /** @type {Error} */ (error);
    throw new Error(`“${file.name}” is ${name === 'PasswordException' ? 'locked by a password; save it without one' : `damaged, or no PDF (${message}); copy, download or export it again`}`);
  } finally {
    await task.destroy();
  }
}
