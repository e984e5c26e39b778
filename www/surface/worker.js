/** The worker in which the page computes what it shows; `worker-client.js` calls it. */
import { interpretFile } from '../import-interpretation.js';
import { rmsError } from './compare.js';
import { downsample } from './downsampling.js';
import { interpolateToGrid } from './lattice.js';
import { reducePhoto, decodePicture } from './photo-decoding.js';
import { meshStrainImage, labelPixels, photoPixels, sheetStrainImage, valuePixels } from './colour-images.js';
import { curvaturesOf, totalGaussianCurvature } from './gaussian-curvature.js';

/** The tasks by name. The buffers of arrays in an answer are transferred. */
export const tasks = {
  curvaturesOf, meshStrainImage, interpolateToGrid, labelPixels, interpretFile, downsample,
  reducePhoto, photoPixels, decodePicture, rmsError, totalGaussianCurvature, sheetStrainImage, valuePixels,
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
