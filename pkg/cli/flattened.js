/** The surface that a command lays flat: one that is fitted, a cylinder, or the input as it is. */
import * as developable from '../index.js';
import { solver } from '../schema/fit.js';
import { solve } from './fit.js';
import { readForFit, readInput } from './inputs.js';
import { optionsFrom } from './task.js';
import { reportFile } from './texts.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('./inputs.js').Input} Input
 */

/**
 * Returns the surface to be laid flat, and how it is resampled if it is no lattice yet.
 * @param {Task & { photo?: import('./inputs.js').Size }} task
 * @param {AbortSignal} signal
 * @param {(input: Input) => void} [check] whether it will do, before the work
 */
export async function flattened(task, signal, check = () => {}) {
  const input = await (task.asIs ? readInput(task) : readForFit(task, signal));
  check(input);
  if (task.asIs) return { surface: input, options: spacing(task) };
  const cylinder = await cylinderFor(task, input);
  return { surface: cylinder ?? await solve(task, input, { signal }), options: {} };
}

/**
 * Whether an option asks for another energy, λ or stop than the defaults do.
 * @param {[name: string, value: unknown]} option
 */
function asksForAnotherFit([name, value]) {
  /** @type {import('../schema/kinds.js').Options} */
  const options = solver;
  // `true` stands for the default number of pixels.
  const standard = name === 'bridge' ? DEFAULT_BRIDGE_PIXELS : options[name]?.default;
  return value !== undefined && value !== standard;
}

/** Default of `--bridge`, in pixels. */
const DEFAULT_BRIDGE_PIXELS = 4;

/**
 * The cylinder that is to be laid flat, if it is one.
 * @param {Task} task
 * @param {Input} input
 */
async function cylinderFor(task, input) {
  const shape = task.command === 'dewarp' ? task.shape ?? 'auto' : undefined;
  if (shape === undefined || shape === 'developable') return undefined;
  const field = /** @type {import('../types.js').Heightfield} */ (input);
  if (shape === 'cylinder') return developable.fitCylinder(field);
  // What is said about the energy is about a surface that is fitted by it.
  const said = Object.entries(optionsFrom(solver, task)).some(asksForAnotherFit);
  if (said || task.lattice !== 'mesh' || field.constraints !== undefined || field.occlusions !== undefined) return undefined;
  try {
    const found = await developable.fitCylinder(field);
    return found.report.verdict === 'cylinder' ? found : undefined;
  } catch (problem) {
    if (problem instanceof developable.DevelopableError && problem.code === 'UNSUPPORTED') return undefined; // too small
    throw problem;
  }
}

/** @param {Input | import('../types.js').FittedCylinder} surface */
export function cylinderOf(surface) {
  const { report } = /** @type {Partial<import('../types.js').FittedCylinder>} */ (surface);
  return report !== undefined && 'rulings' in report ? report : undefined;
}

/** @param {Task} task */
export function spacing(task) {
  return task.lattice === 'square' ? { spacing: task.spacing } : {};
}

/**
 * @param {Task} task
 * @param {{ report: import('../types.js').UnrollReport, verdict: import('../types.js').Verdict, loss?: number, overreach?: number }} result
 */
export function reported(task, { report, verdict, loss, overreach }) {
  return reportFile(task, { verdict, loss, overreach, ...report });
}
