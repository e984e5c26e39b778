/** The view of the surface's photo or the colours of its scan. */
import { gridOf } from '../surface/lattice.js';
import { canvasFromPixels } from '../surface/layer.js';
import { callWorker } from '../surface/worker-client.js';

/** @import {Input} from '../session.js' */
/** @import {ViewContent} from '../surface/layer.js' */

/** Minimum length of a layer's longer side, in pixels. */
const MIN_LAYER_PIXELS = 900;

/** Whether an input has a photo or colours. @param {Input} input */
export function hasColours({ photo, lattice }) {
  return (photo !== undefined && lattice?.uvs !== undefined) || lattice?.colors !== undefined;
}

/**
 * The view of the photo of heights, or of their colours.
 * @param {Input} input
 * @returns {Promise<ViewContent>}
 */
export async function photo({ lattice, ...input }) {
  if (!lattice) return {};
  const coarse = gridOf({ ...input, lattice });
  const finer = Math.max(1, Math.ceil(MIN_LAYER_PIXELS / Math.max(coarse.width, coarse.height)));
  const grid = { ...coarse, width: coarse.width * finer, height: coarse.height * finer, pixelSize: coarse.pixelSize / finer };
  const { rows, cols, spacing, origin, uvs, colors } = lattice;
  const image = input.photo?.image;
  const seen = image && uvs ? { image: { width: image.width, height: image.height, data: image.data }, uvs } : { colors };
  const layer = { image: canvasFromPixels(grid, await callWorker('photoPixels', { rows, cols, spacing, origin }, seen, grid)) };
  return { layers: [layer, layer] };
}
