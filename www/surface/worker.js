/** The worker in which the page works out what it shows; `work.js` is its other end. */
import { confidenceOf, constraintsOf, lookedThrough } from '../import-interpretation.js';
import { photographed } from '../views/print.js';
import { assembled, bordersOf } from './assembled.js';
import { meanAngle, rmsError } from './compare.js';
import { interpolated } from './lattice.js';
import { hiddenShare } from './hidden.js';
import { firstLook, lookedAt } from './look.js';
import { normalsOf } from './normals.js';
import { photoAt, pictureOf } from './pictures.js';
import { drawnStrains, flatPixels, labelPixels, photoPixels, sheetPixels, valuePixels } from './pixels.js';
import { curvaturesOf, roundness } from './roundness.js';
import { unfolding } from './unfolding.js';

/**
 * Sheets on their way, each by itself, with the lines along which they were cut.
 * @param {Uint8Array} model
 * @param {number} scale
 * @param {number} most
 * @param {Parameters<typeof unfolding>[2]} offset
 */
function unfoldingInPieces(model, scale, most, offset) {
  const sheets = assembled(model, scale);
  return { ...unfolding(sheets, most, offset), lines: bordersOf(sheets.triangles) };
}

/** What can be asked for, by name. Arrays of an answer are handed over. */
export const tasks = {
  confidenceOf, constraintsOf, curvaturesOf, drawnStrains, firstLook, flatPixels, hiddenShare, interpolated, labelPixels, lookedAt, lookedThrough, meanAngle, normalsOf,
  photoAt, photoPixels, photographed, pictureOf, rmsError, roundness, sheetPixels, unfolding, unfoldingInPieces, valuePixels,
};

globalThis.addEventListener('message', async ({ data: { id, task, args } }) => {
  /** @type {{ id: number, value?: unknown, error?: string }} */
  let answer;
  try {
    const work = /** @type {(...args: unknown[]) => unknown} */ (tasks[/** @type {keyof typeof tasks} */ (task)]);
    answer = { id, value: await work(...args) };
  } catch (error) {
    answer = { id, error: error instanceof Error ? error.message : String(error) };
  }
  globalThis.postMessage(answer, { transfer: [...new Set(buffersOf(answer))] });
});

/** @param {unknown} value @returns {Generator<ArrayBufferLike>} */
function* buffersOf(value) {
  if (ArrayBuffer.isView(value)) yield value.buffer;
  else if (value && Object.getPrototypeOf(value) === Object.prototype) for (const one of Object.values(value)) yield* buffersOf(one);
}
