/** `developable analyze`, `developable patches` and `developable rulings`: what a surface is like. */
import * as developable from '../index.js';
import { patchesMesh, rulings as tracing } from '../schema/shape.js';
import { checkPlaces, writeWhole } from './files.js';
import { solve } from './fit.js';
import { flattened, spacing } from './flattened.js';
import { readForFit, readInput } from './inputs.js';
import { optionsFrom } from './task.js';
import { succeed } from './terminal.js';
import { json, linesObj, reportFile } from './texts.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('../types.js').Surface} Surface
 * @typedef {{ path: string, bytes: Uint8Array }} File
 */

/**
 * The figures of the input, and of the surface fitted to it.
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function analyze(task, signal) {
  await checkPlaces(...task.written);
  const input = await (task.asIs ? readInput(task) : readForFit(task, signal));
  const { threshold } = task;
  const before = await developable.analyze(input, { threshold, ...spacing(task) });
  /** @type {Record<string, unknown>} */
  const figures = { input: before.summary };
  if (!task.asIs) {
    const surface = await solve(task, input, { signal });
    const after = await developable.analyze(surface, { threshold, reference: input, ...spacing(task) });
    Object.assign(figures, { output: after.summary, deviation: after.deviation });
  }
  await tell(task, figures, undefined, `figures of ${task.input}`, signal);
}

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function patches(task, signal) {
  await checkPlaces(...task.written);
  const { surface, options } = await flattened(task, signal);
  const { labels, ...map } = await developable.patches(surface, { ...options, ...optionsFrom(patchesMesh, task) });
  await tell(task, map, await drawn(), `${map.patches.length} patches, ${map.creases.length} creases`, signal);

  async function drawn() {
    const { rows, cols, spacing } = map;
    if (task.extension === '.json') return undefined;
    if (task.extension === '.npy') return developable.writeImage({ rows, cols, spacing, heights: labels });
    const coloured = { .../** @type {Surface} */ (surface), texture: undefined, uvs: undefined, colors: coloursOf(labels) };
    switch (task.extension) {
      case '.ply': return developable.writePly(coloured);
      case '.glb': return developable.writeGlb(coloured);
      default: return developable.writeObj(coloured);
    }
  }
}

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function rulings(task, signal) {
  await checkPlaces(...task.written);
  const { surface, options } = await flattened(task, signal);
  const { directions, confidence, ...field } = await developable.rulings(surface, { ...options, ...optionsFrom(tracing, task) });
  const frame = 'frame' in surface ? surface.frame : undefined;
  await tell(task, field, task.extension === '.obj' ? linesObj(field.lines, frame) : undefined, `${field.lines.length} rulings`, signal);
}

/**
 * Writes a report, and what was drawn of it.
 * @param {Task} task
 * @param {object} report
 * @param {Uint8Array | undefined} drawn
 * @param {string} figures in a few words
 * @param {AbortSignal} signal
 */
async function tell(task, report, drawn, figures, signal) {
  const { output } = task;
  await writeWhole([{ path: output, bytes: drawn ?? json(report) }, ...reportFile(task, report)], signal);
  if (output !== '-') succeed(output, figures);
}

/**
 * A colour for each patch, far from those before it: hues turn by the golden ratio.
 * @param {Int32Array} labels
 */
function coloursOf(labels) {
  const golden = (Math.sqrt(5) - 1) / 2;
  return Float32Array.from({ length: 3 * labels.length }, (_, i) => {
    const label = labels[Math.floor(i / 3)];
    return label < 0 ? 0.5 : 0.55 + 0.4 * Math.cos(2 * Math.PI * (label * golden + (i % 3) / 3));
  });
}
