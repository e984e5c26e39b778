/** The photo that came with depths, or the colours of a scan, on the surface. */
import { gridOf } from '../surface/lattice.js';
import { canvasOf } from '../surface/layer.js';
import { work } from '../surface/work.js';

/** @import {Analyses} from '../analyses.js' */
/** @import {Input, Result} from '../session.js' */
/** @import {Shown} from './shown.js' */

/** Pixels along the longer side of what is drawn over a surface, at least. */
const MIN_LAYER_PIXELS = 900;

/** Whether an input has colours of its own. @param {Input} input */
export function hasColours({ photo, lattice }) {
  return (photo !== undefined && lattice?.uvs !== undefined) || lattice?.colors !== undefined;
}

/**
 * @param {Analyses} _
 * @param {Result} result
 * @returns {Promise<Shown>}
 */
export async function photo(_, { input }) {
  const { lattice } = input;
  if (!lattice) return { about: [] };
  const coarse = gridOf(input);
  const finer = Math.max(1, Math.ceil(MIN_LAYER_PIXELS / Math.max(coarse.width, coarse.height)));
  const grid = { ...coarse, width: coarse.width * finer, height: coarse.height * finer, pixelSize: coarse.pixelSize / finer };
  const { rows, cols, spacing, origin, uvs, colors } = lattice;
  const image = input.photo?.image;
  const seen = image && uvs ? { image: { width: image.width, height: image.height, data: image.data }, uvs } : { colors };
  const layer = { grid, image: canvasOf(grid, await work('photoPixels', { rows, cols, spacing, origin }, seen, grid)) };
  return { input: layer, result: layer, about: [] };
}
