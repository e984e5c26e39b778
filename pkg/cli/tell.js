/** `developable analyze`, `developable patches` and `developable rulings`: what a surface is like. */
import * as developable from '../index.js';
import { checkPlaces, writeWhole } from './files.js';
import { solve } from './fit.js';
import { readForFit, readInput } from './inputs.js';
import { flattened, json, linesObj, spacing } from './sheets.js';
import { print } from './terminal.js';

/**
 * @typedef {import('../types.js').PatchMap} PatchMap
 * @typedef {import('../types.js').Surface} Surface
 * @typedef {{ path: string, bytes: Uint8Array }} File
 */

/**
 * The figures of the input, and of the surface fitted to it.
 * @param {import('./arguments.js').AnalyzeTask} task
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
  await tell(task, json(figures), undefined, signal);
}

/**
 * @param {import('./arguments.js').PatchesTask} task
 * @param {AbortSignal} signal
 */
export async function patches(task, signal) {
  await checkPlaces(...task.written);
  const { surface, options } = await flattened(task, signal);
  const { labels, ...map } = await developable.patches(surface, { ...options, ...task.patching });
  await tell(task, json(map), await drawn(), signal);

  async function drawn() {
    const { rows, cols, spacing } = map;
    if (task.extension === '.json') return undefined;
    if (task.extension === '.npy') return developable.writeNpy({ rows, cols, spacing, heights: labels });
    const coloured = { .../** @type {Surface} */ (surface), texture: undefined, uvs: undefined, colors: coloursOf(labels) };
    switch (task.extension) {
      case '.ply': return developable.writePly(coloured);
      case '.glb': return developable.writeGlb(coloured);
      default: return developable.writeObj(coloured);
    }
  }
}

/**
 * @param {import('./arguments.js').RulingsTask} task
 * @param {AbortSignal} signal
 */
export async function rulings(task, signal) {
  await checkPlaces(...task.written);
  const { surface, options } = await flattened(task, signal);
  const { directions, confidence, ...field } = await developable.rulings(surface, { ...options, ...task.tracing });
  const frame = 'frame' in surface ? surface.frame : undefined;
  await tell(task, json(field), task.extension === '.obj' ? linesObj(field.lines, frame) : undefined, signal);
}

/**
 * Writes a report, to standard output if nowhere else, and what was drawn of it.
 * @param {import('./arguments.js').SheetTask} task
 * @param {Uint8Array} report
 * @param {Uint8Array | undefined} drawn
 * @param {AbortSignal} signal
 */
async function tell({ output, report: path }, report, drawn, signal) {
  /** @type {File[]} */
  const files = [];
  if (output !== '') files.push({ path: output, bytes: drawn ?? report });
  if (path !== undefined) files.push({ path, bytes: report });
  await writeWhole(files, signal);
  if (output === '') await print(new TextDecoder().decode(report));
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
