/** What several panels ask about an input or a result, worked out once for each. */
import { meanAngle, rmsError } from './compare.js';
import { gridOf, interpolated } from './lattice.js';
import { normalsOf } from './normals.js';

/** @import {Input, Result} from '../session.js' */

/**
 * @template {object} K
 * @template V
 * @param {(key: K) => V} make
 * @returns {(key: K) => V}
 */
function once(make) {
  /** @type {WeakMap<K, { value: V }>} */
  const known = new WeakMap();
  return (key) => {
    const found = known.get(key) ?? { value: make(key) };
    known.set(key, found);
    return found.value;
  };
}

export const inputNormals = once((/** @type {Input} */ input) =>
  normalsOf(input.data, input.width, input.height, input.heightScale / input.pixelSize));

/** The result at the input's pixels, or at those that show the input's lattice. */
export const resultImage = once((/** @type {Result} */ { input, surface }) => {
  if (surface.image) return surface.image;
  const grid = gridOf(input);
  const { width, height, pixelSize } = grid;
  return { width, height, pixelSize, data: interpolated(surface, surface.heights, grid) };
});

export const resultNormals = once((/** @type {Result} */ result) => {
  const { data, width, height, pixelSize } = resultImage(result);
  return normalsOf(data, width, height, 1 / pixelSize);
});

/** The truth and the input's errors against it, where it is known. */
const truthOf = once((/** @type {Input} */ input) => {
  const { truth, data, width, height, pixelSize, heightScale } = input;
  if (!truth) return null;
  const normals = normalsOf(truth, width, height, heightScale / pixelSize);
  return {
    heights: truth,
    normals,
    heightError: rmsError(data, heightScale, truth, heightScale),
    normalError: meanAngle(inputNormals(input), normals),
  };
});

/**
 * Errors against the truth before and after: of the heights, root mean square;
 * of the normals, mean angle in degrees. Null where the truth is not known.
 */
export const accuracyOf = once((/** @type {Result} */ result) => {
  const { input } = result;
  const truth = truthOf(input);
  if (!truth) return null;
  return {
    heights: { before: truth.heightError, after: rmsError(resultImage(result).data, 1, truth.heights, input.heightScale) },
    normals: { before: truth.normalError, after: meanAngle(resultNormals(result), truth.normals) },
  };
});
