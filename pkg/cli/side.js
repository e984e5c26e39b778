/** Whether a mesh is taken whole, or its heights as seen from one side, where no flag says so. */
import * as developable from '../index.js';
import { commands } from './commands.js';
import { readMesh, seenFrom } from './inputs.js';
import { Problem } from './problem.js';
import { taskOf } from './task.js';
import { during, percent, say } from './terminal.js';

/**
 * @typedef {import('./task.js').Task} Task
 * @typedef {import('./task.js').Values} Values
 */

/**
 * The task, for the whole mesh where it has no noise or one side hides much of it. What cannot be asked for of a whole mesh asks for a
 * side.
 * @param {Task} task of a mesh seen from one side
 * @param {Values} values
 * @returns {Promise<Task>}
 */
export async function sideOrWhole(task, values) {
  const whole = asWhole(task, values);
  if (whole === undefined) return task;
  const mesh = await readMesh(task);
  if (mesh.triangles.length === 0) return { ...task, mesh };
  if (task.command === 'pattern') {
    const recognized = await during(`looking at ${task.input}`, () => developable.recognizeMesh(mesh));
    if (recognized.kind !== 'noisy') return { ...whole, mesh, recognized };
  }
  const seen = await seenFrom(task, mesh);
  if (seen.noNoise) return { ...whole, mesh };
  if (seen.hidden === undefined) return { ...task, mesh, seen };
  say(`${task.input} is taken whole, since one side of it hides ${percent(seen.hidden, 2)} of its area (--view takes what is seen from one side)`);
  return { ...whole, mesh };
}

/** @param {Task} task @param {Values} values */
function asWhole({ command, inputs, mode }, values) {
  /** @type {import('./commands.js').CommandInfo} */
  const { flags } = commands[command];
  if (mode !== 'mesh' || !flags.includes('surface')) return undefined;
  try {
    return taskOf(command, inputs, { ...values, surface: true });
  } catch (problem) {
    if (problem instanceof Problem) return undefined;
    throw problem;
  }
}
