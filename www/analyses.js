/** Analyses of a result: curvatures, patches, rulings, unrolling and patterns, in parallel to the next run. */
import { downsample } from './surface/downsampling.js';
import { MAX_SHEET_CURVATURE_RADIANS } from './surface/gaussian-curvature.js';
import { callWorker } from './surface/worker-client.js';
import { Tasks } from './worker-task.js';
import { heightsOf } from './session.js';

/** @import {Analysis, Surface} from '../pkg/types.js' */

/** Longer side of the lattice that is cut into sheets, in pixels: a pixel is half a millimetre for a piece of 20 cm. */
const PATTERN_SIDE_PIXELS = 450;
/** Largest ratio of a lattice's longer side to `PATTERN_SIDE_PIXELS` for which the lattice is not reduced. */
const MAX_UNREDUCED_RATIO = 1.2;

export class Analyses extends Tasks {
  /** Curvatures of the input and of the result, on the same lattice. @param {Result} result @returns {Promise<{ before: Analysis, after: Analysis }>} */
  async curvatures({ input, surface }) {
    const { spacing } = surface;
    const [before, after] = await Promise.all([
      this.answer(input, `curvatures ${spacing}`, (worker) =>
        worker.analyze(heightsOf(input), input.lattice ? {} : { spacing })),
      this.curvature(surface),
    ]);
    return { before, after };
  }

  /** @param {Surface} surface */
  curvature(surface) {
    return this.answer(surface, 'curvatures', (worker) => worker.analyze(surface));
  }

  /** @param {Result} result */
  patches({ surface }) {
    return this.answer(surface, 'patches', (worker) => worker.patches(surface));
  }

  /** The number of smooth patches, infinite if the surface is creased all over, and the number of creases between them. @param {Result} result */
  async patchCount(result) {
    const [map, { gaussian }] = await Promise.all([this.patches(result), this.curvature(result.surface)]);
    return { count: await smoothPatchCount(map, { gaussian }), creases: map.creases.length };
  }

  /** @param {Result} result */
  rulings({ surface }) {
    return this.answer(surface, 'rulings', (worker) => worker.rulings(surface));
  }

  /** A picture of the unrolled sheet, and its figures. The mesh of the sheet is not kept, because it is large. @param {Result} result @param {Tell} tell */
  unroll({ surface }, tell) {
    return this.answer(surface, 'sheet', async (worker) => {
      const { triangles, places, stretches, report, verdict } = await worker.unroll(surface, { onProgress: ({ fraction }) => tell({ fraction, task: 'unrolling' }) });
      const { transfer } = await import('../pkg/wire.js');
      const picture = await callWorker('sheetStrainImage', transfer(triangles, [triangles, places, stretches].map(({ buffer }) => buffer)), places, stretches);
      return { picture, report, verdict };
    });
  }

  /** A pattern of the surface; a large surface is reduced to a coarser lattice first. @param {Result} result @param {PatternOptions} options @param {Tell} tell */
  pattern(result, options, tell) {
    const { surface } = result;
    const { width, height } = result.image;
    const source = Math.max(width, height) < MAX_UNREDUCED_RATIO * PATTERN_SIDE_PIXELS ? surface : downsample(result.image, PATTERN_SIDE_PIXELS);
    return this.answer(surface, `pattern ${JSON.stringify(options)}`, (worker) => worker.pattern(source, { ...options, onProgress: ({ fraction }) => tell({ fraction, task: 'cutting' }) }));
  }
}

/**
 * The number of smooth patches; infinite if the surface is creased all over, so that no patch is smooth.
 * @param {import('../pkg/types.js').PatchMap} map
 * @param {{ gaussian: ArrayLike<number> }} curvature
 */
export async function smoothPatchCount({ rows, cols, labels, spacing, patches }, { gaussian }) {
  const roundness = await callWorker('totalGaussianCurvature', { rows, cols, labels, spacing }, { gaussian });
  return roundness < MAX_SHEET_CURVATURE_RADIANS ? patches.length : Infinity;
}
