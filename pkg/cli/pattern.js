/** `developable pattern`, of one plan or of several that are tried. */
import * as developable from '../index.js';
import { solver } from '../schema/fit.js';
import { drawingOptions, patternFiles, reportPattern } from './drawing.js';
import { checkPlaces, writeWhole } from './files.js';
import { flattened, spacing } from './flattened.js';
import { readForFit } from './inputs.js';
import { Problem, status } from './problem.js';
import { TABLE, optionsFrom } from './task.js';
import { during, percent, statusLine } from './terminal.js';
import { json } from './texts.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('./drawing.js').Plan} Plan
 */

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
export async function pattern(task, signal) {
  await checkPlaces(...task.written);
  if (task.explore) return tellPlans(task, (await explored(task, signal)).plans, signal);
  const { drawing, plan } = await drawnOnce(task, signal);
  await writeWhole(await patternFiles(task, drawing, plan), signal);
  reportPattern(task, drawing, plan);
}

/**
 * The pattern that is asked for, and how it came about where several were tried.
 * @param {Task} task
 * @param {AbortSignal} signal
 * @returns {Promise<{ drawing: import('../types.js').Drawing, plan?: Plan }>}
 */
async function drawnOnce(task, signal) {
  if (task.sheets === undefined) {
    const { surface, options } = await flattened(task, signal);
    const refold = task.report !== undefined;
    const draw = (/** @type {object} */ watched) => developable.pattern(surface, { ...options, ...drawingOptions(task), refold, ...watched });
    return { drawing: await during('cutting it into sheets', draw) };
  }
  return chosenOf(task, await explored(task, signal));
}

/**
 * The pattern of the first plan with few enough sheets.
 * @param {{ sheets?: number }} task
 * @param {import('../types.js').ExploredPatterns} found
 */
export function chosenOf(task, { plans, chosen }) {
  if (chosen?.drawing === undefined) {
    const fewest = Math.min(...plans.map(({ drawing }) => drawing?.sheets.length ?? Infinity));
    throw new Problem(
      status.input,
      fewest === Infinity
        ? `no plan lays it flat: ${plans.at(-1)?.problem}`
        : `no plan has as few sheets as ${task.sheets}: the fewest are ${fewest}; --max-strain allows more, --explore shows all`,
    );
  }
  const { lambda, smallest, distance } = chosen;
  return { drawing: chosen.drawing, plan: { lambda, smallest, distance } };
}

/**
 * @param {Task} task
 * @param {AbortSignal} signal
 */
async function explored(task, signal) {
  const input = await readForFit(task, signal);
  const { lambda, ...fitting } = { ...optionsFrom(solver, task), ...spacing(task) };
  const { smallest, ...pattern } = drawingOptions(task);
  return withPlans((onPlan) => developable.explorePattern(input, { solver: fitting, pattern, sheets: task.sheets, signal, onPlan }));
}

/**
 * Plans, shown as they are found.
 * @param {(onPlan?: (plan: import('../types.js').PatternPlan) => void) => Promise<import('../types.js').ExploredPatterns>} explore
 */
export async function withPlans(explore) {
  const line = statusLine();
  try {
    return await explore(line.shown ? (plan) => line.show(row(plan).join('  ')) : undefined);
  } finally {
    line.clear();
  }
}

const COLUMNS = ['lambda', 'smallest', 'sheets', 'folds', 'slits', 'cuts (mm)', 'strain', 'distance', 'time (s)'];

/** @param {import('../types.js').PatternPlan} plan */
function row({ lambda, smallest, distance, seconds, drawing }) {
  const figures = drawing === undefined ? ['cannot be laid flat', '', '', '', ''] : rowOf(drawing.summary);
  return [Number(lambda.toPrecision(3)).toExponential(), String(smallest), ...figures, String(Number(distance.toPrecision(3))), seconds.toFixed(1)];
}

/** @param {import('../types.js').Drawing['summary']} summary */
function rowOf({ sheets, folds, slits, cutLength, strain }) {
  return [String(sheets), String(folds), String(slits), cutLength.toFixed(0), percent(strain, 2)];
}

/**
 * All plans, as a table or as JSON.
 * @param {Task} task
 * @param {import('../types.js').PatternPlan[]} plans
 * @param {AbortSignal} signal
 */
export async function tellPlans({ output, extension }, plans, signal) {
  if (extension !== TABLE) {
    const figures = plans.map(({ drawing, ...plan }) => ({ ...plan, summary: drawing?.summary }));
    await writeWhole([{ path: output, bytes: json(figures) }], signal);
    return;
  }
  const rows = [COLUMNS, ...plans.map(row)];
  const widths = COLUMNS.map((_, i) => Math.max(...rows.map((cells) => (i === 2 && cells[3] === '' ? 0 : cells[i].length))));
  const lines = rows.map((cells) => cells.map((cell, i) => (cells[3] === '' && i === 2 ? cell : cell.padStart(widths[i]))).join('  '));
  await writeWhole([{ path: output, bytes: new TextEncoder().encode(`${lines.join('\n')}\n`) }], signal);
}
