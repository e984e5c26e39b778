/** Data derived from inputs and results: normals, textures, previews and errors. They are computed once, before panels show the input or result. */
import { gridOf } from './lattice.js';
import { reduceForPreview } from './textures.js';
import { normalsOf } from './normals.js';
import { callWorker } from './worker-client.js';

/** @import {Input, Result} from '../session.js' */
/** @import {Heights} from './downsampling.js' */
/** @import {SurfaceData, SurfaceTextures} from './textures.js' */
/** @import {Normals} from './normals.js' */
/** @typedef {{ heights: { before: number, after: number }, normals: { before: number, after: number } }} Accuracy */
/** @typedef {{ width: number, height: number, pixelSize: number, data: Float64Array }} Image */

/** @type {WeakMap<Input, Normals>} */
const normalsOfInputs = new WeakMap();
/** Normals by heights, which inputs that differ in other properties share. @type {WeakMap<ArrayLike<number>, { steepness: number, normals: Normals }>} */
const normalsOfHeights = new WeakMap();
/** Textures until they are uploaded to the graphics card. @type {WeakMap<object, SurfaceTextures>} */
const pendingTextures = new WeakMap();
/** Reduced heights for previews, by the values of the pixels. @type {WeakMap<ArrayLike<number>, Heights>} */
const previewHeights = new WeakMap();
/** @type {WeakMap<Float64Array, Promise<{ normals: Normals, heightError: number, normalError: number }>>} */
const truthData = new WeakMap();
/** @type {WeakMap<Result, { image: Image, normals: Normals, accuracy: Accuracy | null }>} */
const resultData = new WeakMap();

/** Computes normals of heights on the grid of an input. @param {Input} input @param {ArrayLike<number>} heights */
const computeNormals = ({ width, height, heightScale, pixelSize }, heights) =>
  callWorker('normalsOf', heights, width, height, heightScale / pixelSize);

/** Computes normals, textures and the preview of an input. @param {Input} input */
export async function prepareInput(input) {
  if (normalsOfInputs.has(input)) return;
  const { data, width, height, heightScale, pixelSize } = input;
  if (normalsOfHeights.get(data)?.steepness !== heightScale / pixelSize) storeSurfaceData(input, await callWorker('computeSurfaceDataAndPreview', data, width, height, heightScale, pixelSize));
  const found = normalsOfHeights.get(data);
  if (found) normalsOfInputs.set(input, found.normals);
  // Textures belong to the heights of a file first; the input that shows these takes them over.
  const textures = pendingTextures.get(data);
  if (textures) pendingTextures.set(input, textures);
  pendingTextures.delete(data);
}

/**
 * Stores data that were computed when heights were read from a file.
 * @param {Pick<Input, 'data' | 'heightScale' | 'pixelSize'>} input
 * @param {SurfaceData & { small: Heights }} look
 */
export function storeSurfaceData({ data, heightScale, pixelSize }, { normals, textures, small: reduced }) {
  normalsOfHeights.set(data, { steepness: heightScale / pixelSize, normals });
  pendingTextures.set(data, textures);
  storePreviewHeights(data, reduced);
}

/** Stores reduced heights for previews. @param {ArrayLike<number>} values of all pixels @param {Heights} reduced */
export function storePreviewHeights(values, reduced) {
  previewHeights.set(values, reduced);
}

/** Heights reduced for previews. @param {Heights} image */
export function previewHeightsOf(image) {
  const found = previewHeights.get(image.data) ?? reduceForPreview(image);
  previewHeights.set(image.data, found);
  return found;
}

/** Returns the textures of an input or result, and forgets them. @param {Input | Result} owner */
export function takeTextures(owner) {
  const found = pendingTextures.get(owner);
  pendingTextures.delete(owner);
  return found;
}

/** Computes the normals of a small input at once, without the worker. @param {Input} input */
export function prepareSmallInput(input) {
  const { data, width, height, heightScale, pixelSize } = input;
  normalsOfInputs.set(input, normalsOf(data, width, height, heightScale / pixelSize));
}

/** Computes the image, normals, textures and errors of a result. @param {Result} result */
export async function prepareResult(result) {
  const { input, surface } = result;
  const image = surface.image ?? await rasteriseResult(result);
  const { width, height, pixelSize, data } = image;
  const { normals, textures } = await callWorker('computeSurfaceData', data, width, height, 1, pixelSize);
  pendingTextures.set(result, textures);
  resultData.set(result, { image, normals, accuracy: await measureAccuracy(input, data, normals) });
}

/** Interpolates a surface to the pixels that show the input's lattice. @param {Result} result @returns {Promise<Image>} */
async function rasteriseResult({ input, surface: { rows, cols, spacing, origin, heights } }) {
  const grid = gridOf(input);
  const data = await callWorker('interpolateToGrid', { rows, cols, spacing, origin }, heights, grid);
  return { width: grid.width, height: grid.height, pixelSize: grid.pixelSize, data };
}

/**
 * Errors of input and result against the truth; null if the truth is not known.
 * @param {Input} input
 * @param {Float64Array} heights of the result
 * @param {Normals} normals of the result
 * @returns {Promise<Accuracy | null>}
 */
async function measureAccuracy(input, heights, normals) {
  const { truth, heightScale, data } = input;
  if (!truth) return null;
  const known = truthData.get(truth) ?? prepareTruth(input, truth, data);
  truthData.set(truth, known);
  const { normals: right, heightError, normalError } = await known;
  const [after, angle] = await Promise.all([
    callWorker('rmsError', heights, 1, truth, heightScale),
    callWorker('meanAngle', normals, right),
  ]);
  return { heights: { before: heightError, after }, normals: { before: normalError, after: angle } };
}

/** The normals of the truth, and the errors of the input against it. @param {Input} input @param {Float64Array} truth @param {Float64Array} data */
async function prepareTruth(input, truth, data) {
  const [normals, heightError] = await Promise.all([
    computeNormals(input, truth),
    callWorker('rmsError', data, input.heightScale, truth, input.heightScale),
  ]);
  return { normals, heightError, normalError: await callWorker('meanAngle', inputNormals(input), normals) };
}

/** The normals of an input that was prepared. @param {Input} input */
export function inputNormals(input) {
  return cachedValue(normalsOfInputs, input);
}

/** The heights of a result at the input's pixels, or at the pixels that show the input's lattice. @param {Result} result */
export function resultImage(result) {
  return cachedValue(resultData, result).image;
}

/** The normals of a result at the same pixels. @param {Result} result */
export function resultNormals(result) {
  return cachedValue(resultData, result).normals;
}

/**
 * Errors of input and result against the truth: root mean square of the heights, mean angle between normals in degrees. Null
 * if the truth is not known.
 * @param {Result} result
 */
export function accuracyOf(result) {
  return cachedValue(resultData, result).accuracy;
}

/**
 * The value of a key in a cache.
 * @template {object} K
 * @template V
 * @param {WeakMap<K, V>} known
 * @param {K} key
 */
function cachedValue(known, key) {
  const found = known.get(key);
  if (!found) throw new Error('it has not been looked at yet');
  return found;
}
