/** What several panels ask about an input or a result: worked out before they are told of it, once for each. */
import { gridOf } from './lattice.js';
import { small } from './look.js';
import { normalsOf } from './normals.js';
import { work } from './work.js';

/** @import {Input, Result} from '../session.js' */
/** @import {Heights} from './coarse.js' */
/** @import {Look, Texels} from './look.js' */
/** @import {Normals} from './normals.js' */
/** @typedef {{ heights: { before: number, after: number }, normals: { before: number, after: number } }} Accuracy */
/** @typedef {{ width: number, height: number, pixelSize: number, data: Float64Array }} Image */

/** @type {WeakMap<Input, Normals>} */
const seen = new WeakMap();
/** The last look at heights, for inputs that differ in something else. @type {WeakMap<ArrayLike<number>, { steepness: number, normals: Normals }>} */
const looks = new WeakMap();
/** Until somebody shows them. @type {WeakMap<object, Texels>} */
const texels = new WeakMap();
/** Of many pixels, so that they are gone through once. @type {WeakMap<ArrayLike<number>, Heights>} */
const smalls = new WeakMap();
/** @type {WeakMap<Float64Array, Promise<{ normals: Normals, heightError: number, normalError: number }>>} */
const truths = new WeakMap();
/** @type {WeakMap<Result, { image: Image, normals: Normals, accuracy: Accuracy | null }>} */
const results = new WeakMap();

/** @param {Input} input @param {ArrayLike<number>} heights */
const normalsLike = ({ width, height, heightScale, pixelSize }, heights) =>
  work('normalsOf', heights, width, height, heightScale / pixelSize);

/** @param {Input} input */
export async function lookAt(input) {
  if (seen.has(input)) return;
  const { data, width, height, heightScale, pixelSize } = input;
  if (looks.get(data)?.steepness !== heightScale / pixelSize) keepLook(input, await work('firstLook', data, width, height, heightScale, pixelSize));
  const found = looks.get(data);
  if (found) seen.set(input, found.normals);
  // Those of the file, which another input may take over.
  const drawn = texels.get(data);
  if (drawn) texels.set(input, drawn);
  texels.delete(data);
}

/**
 * What was found about heights as they were read.
 * @param {Pick<Input, 'data' | 'heightScale' | 'pixelSize'>} input
 * @param {Look & { small: Heights }} look
 */
export function keepLook({ data, heightScale, pixelSize }, { normals, texels: drawn, small: reduced }) {
  looks.set(data, { steepness: heightScale / pixelSize, normals });
  texels.set(data, drawn);
  keepSmall(data, reduced);
}

/** @param {ArrayLike<number>} values of pixels @param {Heights} reduced */
export function keepSmall(values, reduced) {
  smalls.set(values, reduced);
}

/** What previews are made of. @param {Heights} image */
export function smallOf(image) {
  const found = smalls.get(image.data) ?? small(image);
  smalls.set(image.data, found);
  return found;
}

/** Textures of what is shown for the first time. @param {Input | Result} of */
export function takenTexels(of) {
  const found = texels.get(of);
  texels.delete(of);
  return found;
}

/** For inputs that are small. @param {Input} input */
export function lookAtOnce(input) {
  const { data, width, height, heightScale, pixelSize } = input;
  seen.set(input, normalsOf(data, width, height, heightScale / pixelSize));
}

/** @param {Result} result */
export async function lookInto(result) {
  const { input, surface } = result;
  const image = surface.image ?? await pixelsOf(result);
  const { width, height, pixelSize, data } = image;
  const { normals, texels: drawn } = await work('lookedAt', data, width, height, 1, pixelSize);
  texels.set(result, drawn);
  results.set(result, { image, normals, accuracy: await accuracy(input, data, normals) });
}

/** At the pixels that show the input's lattice. @param {Result} result @returns {Promise<Image>} */
async function pixelsOf({ input, surface: { rows, cols, spacing, origin, heights } }) {
  const grid = gridOf(input);
  const data = await work('interpolated', { rows, cols, spacing, origin }, heights, grid);
  return { width: grid.width, height: grid.height, pixelSize: grid.pixelSize, data };
}

/**
 * @param {Input} input
 * @param {Float64Array} heights
 * @param {Normals} normals
 * @returns {Promise<Accuracy | null>}
 */
async function accuracy(input, heights, normals) {
  const { truth, heightScale, data } = input;
  if (!truth) return null;
  const known = truths.get(truth) ?? aboutTruth(input, truth, data);
  truths.set(truth, known);
  const { normals: right, heightError, normalError } = await known;
  const [after, angle] = await Promise.all([
    work('rmsError', heights, 1, truth, heightScale),
    work('meanAngle', normals, right),
  ]);
  return { heights: { before: heightError, after }, normals: { before: normalError, after: angle } };
}

/** @param {Input} input @param {Float64Array} truth @param {Float64Array} data */
async function aboutTruth(input, truth, data) {
  const [normals, heightError] = await Promise.all([
    normalsLike(input, truth),
    work('rmsError', data, input.heightScale, truth, input.heightScale),
  ]);
  return { normals, heightError, normalError: await work('meanAngle', inputNormals(input), normals) };
}

/** @param {Input} input */
export function inputNormals(input) {
  return of(seen, input);
}

/** The result at the input's pixels, or at those that show the input's lattice. @param {Result} result */
export function resultImage(result) {
  return of(results, result).image;
}

/** @param {Result} result */
export function resultNormals(result) {
  return of(results, result).normals;
}

/**
 * Errors against the truth before and after: of the heights, root mean square;
 * of the normals, mean angle in degrees. Null where the truth is not known.
 * @param {Result} result
 */
export function accuracyOf(result) {
  return of(results, result).accuracy;
}

/**
 * @template {object} K
 * @template V
 * @param {WeakMap<K, V>} known
 * @param {K} key
 */
function of(known, key) {
  const found = known.get(key);
  if (!found) throw new Error('it has not been looked at yet');
  return found;
}
