/** `developable fit` and `developable design`. */
import { dirname, relative, sep } from 'node:path';
import * as developable from '../index.js';
import { solver } from '../schema/fit.js';
import { readCamera } from './camera.js';
import { IMAGE_FORMATS, MESH_FILES } from './commands.js';
import { checkPlaces, readBytes, writeWhole } from './files.js';
import { withFileName } from './explain.js';
import { readForFit } from './inputs.js';
import { Problem, status } from './problem.js';
import { optionsFrom } from './task.js';
import { during, fitInWords, percent, progressLine, say, succeed } from './terminal.js';
import { reportFile } from './texts.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('../types.js').Surface} Surface
 */

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function fit(task, signal) {
  await checkPlaces(...task.written);
  const texture = task.texture === undefined ? undefined : await readBytes(task.texture);
  const { photo, camera } = texture === undefined ? {} : await seenBy(task, texture);
  const input = await readForFit({ ...task, photo }, signal);
  const bare = await solve(task, input, { signal, transfer: true });
  const surface = texture === undefined
    ? bare
    : await withFileName(String(task.texture), () => developable.paint(bare, texture, camera && { camera }));
  const files = [{ path: task.output, bytes: await during(`making ${task.output}`, () => encode(task, surface)) }];
  if (task.mtl !== undefined) {
    files.push({ path: task.mtl, bytes: await developable.writeMtl(from(task.mtl, String(task.texture))) });
  }
  await writeWhole([...files, ...reportFile(task, surface.report)], signal);
  succeed(task.output, fitInWords(surface.report));
}

/**
 * What depths and meshes have to know of the picture before they are read: cameras' numbers may be about it, and it may lie
 * otherwise.
 * @param {Task} task
 * @param {Uint8Array} texture
 */
async function seenBy({ texture: path, camera: depths, photoCamera, mtl }, texture) {
  const seen = depths !== undefined || photoCamera !== undefined;
  if (!seen && mtl === undefined) return {};
  const { width, height, orientation } = await withFileName(String(path), () => developable.readPhoto(texture));
  // Texture coordinates are those of the upright photo, and what reads an .obj may show the pixels as they are stored.
  if (mtl !== undefined && orientation !== undefined) {
    throw new Problem(
      status.input,
      `${path} is stored on its side or upside down, with a note (Exif orientation ${orientation}) that programs which open `
        + 'an .obj follow or not: save the photo upright first, or choose an output .glb, which holds it upright',
    );
  }
  if (!seen) return {};
  const camera = photoCamera === undefined ? undefined : await readCamera(photoCamera, [{ width, height }]);
  return { photo: { width, height, orientation, camera }, camera };
}

/**
 * How one file names another.
 * @param {string} file
 * @param {string} other
 */
function from(file, other) {
  return relative(dirname(file), other).replaceAll(sep, '/');
}

/**
 * Solves, with news on a terminal.
 * @param {Task} task
 * @param {import('./inputs.js').Input} input
 * @param {{ signal: AbortSignal, transfer?: boolean }} control
 * @returns {Promise<Surface>}
 */
export async function solve(task, input, control) {
  const options = { ...optionsFrom(solver, task), ...(task.lattice === 'square' && { spacing: task.spacing }) };
  const line = progressLine();
  line.begin();
  const surface = await developable
    .fit(input, { ...options, ...control, onProgress: line.shown ? line.show : undefined })
    .finally(() => line.clear());
  tell(surface);
  return surface;
}

/** @param {number} x */
const rounded = (x) => Number(x.toPrecision(2));

/**
 * Says what the fit took for noise, and what it did not reach.
 * @param {Surface} surface
 */
function tell({ report, pixelDistance }) {
  const { residualExceedsNoise, residualRatio, reason, tolerance, offsetRows, offsetColumns, sigma = 0, correlationLength = 0 } = report.lambdaChoice ?? {};
  const lines = [offsetRows && 'rows', offsetColumns && 'columns'].filter(Boolean).join(' and ');
  if (lines) say(`${lines} of this input have offsets of their own, which were taken out; --bridge none leaves them`);
  if (tolerance !== undefined && reason === 'tolerance') {
    if (rounded(pixelDistance ?? 0) > rounded(tolerance)) {
      say(`the surface is ${rounded(pixelDistance ?? 0)} from the pixels (root mean square): --tolerance holds at the vertices of the lattice, and for no outliers; a smaller --spacing comes nearer to the pixels`);
    }
  } else if (tolerance !== undefined) {
    const known = reason === 'noNoise' ? 'this input has no noise' : 'shape and noise cannot be told apart in this input';
    say(`${known}, so the surface keeps to its heights, but for ${rounded(pixelDistance ?? tolerance)} (root mean square); --tolerance or --lambda asks for a simpler one`);
  } else if (correlationLength > 0) {
    const distance = pixelDistance === undefined ? '' : `, ${rounded(pixelDistance)} from the heights (root mean square)`;
    say(`the surface is without noise of ${rounded(sigma)}, alike over distances of ${rounded(correlationLength)}${distance}: if that is a shape, --tolerance 0.2% keeps it`);
  }
  if (residualExceedsNoise) {
    const times = `(at least ${residualRatio?.toFixed(1)} times)`;
    say(`warning: the surface is farther from the heights than their noise explains ${times}: a part of the shape is lost; a larger --lambda than ${rounded(report.lambda)} keeps more of it`);
  }
  const certainty = report.gap === undefined ? 'without a known gap' : `with a gap of ${percent(report.gap)}`;
  if (report.stopReason === 'maxIterations') {
    say(`warning: stopped after ${report.iterations} iterations ${certainty}; --max-iterations allows more`);
  } else if (report.stopReason === 'diverged') {
    say(`warning: the iterations diverged; the best surface before is ${certainty}`);
  }
}

/**
 * @param {Task} task
 * @param {Surface} surface
 */
function encode({ extension, output, mtl }, surface) {
  if (extension in MESH_FILES) return writeMesh(extension, surface, mtl === undefined ? undefined : { materials: from(output, mtl) });
  const { rows, cols, spacing, heights: data } = surface;
  // On the lattice, the rows of the file are those of the lattice, as in the input.
  return developable.writeImage(surface.image ? surface : { width: cols, height: rows, data, pixelSize: spacing }, { format: IMAGE_FORMATS[extension] });
}

/**
 * @param {string} extension
 * @param {import('../types.js').Mesh | Surface} surface
 * @param {import('../types.js').WriteObjOptions} [options]
 */
export function writeMesh(extension, surface, options) {
  const write = /** @type {typeof developable.writeObj} */ (developable[MESH_FILES[/** @type {keyof typeof MESH_FILES} */ (extension)]]);
  return write(surface, options);
}
