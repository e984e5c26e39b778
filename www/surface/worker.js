/** The worker in which the page computes what it shows; `worker-client.js` calls it. */
import { expose, transfer } from '../../pkg/wire.js';
import { interpretFile } from '../import-interpretation.js';
import { rmsError } from './compare.js';
import { downsample } from './downsampling.js';
import { jpegOfHeic } from './heic.js';
import { interpolateToGrid } from './lattice.js';
import { decodePicture } from './photo-decoding.js';
import { sheetStrainImage } from './colour-images.js';
import { totalGaussianCurvature } from './gaussian-curvature.js';

/** The tasks by name. */
export const tasks = { interpolateToGrid, interpretFile, downsample, decodePicture, jpegOfHeic, rmsError, totalGaussianCurvature, sheetStrainImage };

// The buffers of arrays in an answer are transferred.
expose(Object.fromEntries(Object.entries(tasks).map(([name, task]) => [name, async (/** @type {any[]} */ ...args) => {
  const answer = await /** @type {(...args: any[]) => any} */ (task)(...args);
  return Object(answer) === answer ? transfer(answer, [...new Set(buffersOf(answer))]) : answer;
}])));

/** @param {unknown} value @returns {Generator<ArrayBuffer>} */
function* buffersOf(value) {
  if (ArrayBuffer.isView(value)) yield /** @type {ArrayBuffer} */ (value.buffer);
  else if (value && Object.getPrototypeOf(value) === Object.prototype) for (const one of Object.values(value)) yield* buffersOf(one);
}
