/** `developable fit`. */
import * as developable from '../index.js';
import { checkPlace, readBytes, writeWhole } from './files.js';
import { Problem, status } from './problem.js';
import { announce, percent, progressLine } from './terminal.js';

/**
 * @typedef {import('./arguments.js').FitTask} FitTask
 * @typedef {import('../types.js').ReadResult} ReadResult
 * @typedef {import('../types.js').Surface} Surface
 */

/**
 * @param {FitTask} task
 * @param {AbortSignal} signal
 */
export async function fit(task, signal) {
  await checkPlace(task.output);
  if (task.report !== undefined) await checkPlace(task.report);
  const input = await readInput(task);
  const options = task.lattice === 'hex' ? task.options : { ...task.options, spacing: task.spacing };
  const line = progressLine();
  /** @type {Surface} */
  let surface;
  try {
    const onProgress = line.shown ? line.show : undefined;
    surface = await developable.fit(input, { ...options, signal, onProgress, transfer: true });
  } finally {
    line.clear();
  }
  const files = [{ path: task.output, bytes: await encode(task, surface) }];
  const { report } = surface;
  if (task.report !== undefined) {
    const text = `${JSON.stringify(report, undefined, 2)}\n`;
    files.push({ path: task.report, bytes: new TextEncoder().encode(text) });
  }
  await writeWhole(files, signal);
  announce(task.output, report);
  if (report.stopReason === 'maxIterations') {
    process.stderr.write(
      `developable: warning: stopped after ${report.iterations} iterations with a gap of ` +
        `${percent(report.gap)}; --max-iterations allows more\n`,
    );
  }
}

/** @param {FitTask} task */
async function readInput(task) {
  const file = await readImage(task.input);
  const mask = task.mask === undefined ? undefined : await readMask(task.mask, file);
  const heightScale = task.heightScale ?? file.heightScale;
  const noData = asStored(task.noData, file);
  return task.lattice === 'square'
    ? { ...file, heightScale, mask, noData }
    : {
        rows: file.height,
        cols: file.width,
        spacing: task.spacing ?? file.pixelSize,
        heights: heights(file.data, heightScale, noData ?? 0),
        mask,
      };
}

/**
 * @param {string} path
 * @returns {Promise<ReadResult>}
 */
async function readImage(path) {
  const bytes = await readBytes(path);
  try {
    return await developable.read(bytes);
  } catch (error) {
    if (error instanceof developable.DevelopableError && error.code !== 'TRAP') {
      throw new Problem(status.input, `${path}: ${error.message}`);
    }
    throw error;
  }
}

/**
 * @param {string} path
 * @param {ReadResult} input
 */
async function readMask(path, input) {
  const { width, height, data } = await readImage(path);
  if (width !== input.width || height !== input.height) {
    throw new Problem(
      status.input,
      `the mask has ${width} × ${height} pixels and the input ${input.width} × ${input.height}`,
    );
  }
  return Uint8Array.from(data, (value) => (value === 0 || Number.isNaN(value) ? 0 : 1));
}

/**
 * The value as the file could store it: -9999.9 is another number in 32 bits.
 * @param {number | undefined} noData
 * @param {ReadResult} file
 */
function asStored(noData, file) {
  return noData !== undefined && file.dataType === 'f32' ? Math.fround(noData) : noData;
}

/**
 * @param {Float64Array} values
 * @param {number} scale
 * @param {number} noData
 */
function heights(values, scale, noData) {
  return values.map((value) => (value === noData ? NaN : value * scale));
}

/**
 * @param {FitTask} task
 * @param {Surface} surface
 */
function encode({ extension }, surface) {
  if (extension === '.obj') return developable.writeObj(surface);
  const { rows, cols, spacing, heights: data } = surface;
  // On the lattice, the rows of the file are those of the lattice, as in the input.
  const image = surface.image ?? { width: cols, height: rows, data, pixelSize: spacing };
  return extension === '.png' ? developable.writePng(image) : developable.writeNpy(image);
}
