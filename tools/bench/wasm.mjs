/**
 * One measurement in wasm: a task as JSON in, what it cost and what came out as JSON. The
 * counterpart of the native program in `benches/`.
 */
import { readFile } from 'node:fs/promises';
import { Solver, fit, init, load, read } from '../../pkg/direct.js';
import solverGlue from '../../pkg/wasm/solver.js';
import { fastest, optionsOf } from './task.mjs';

/**
 * @typedef {import('./task.mjs').Task} Task
 * @typedef {import('./task.mjs').Input} Input
 * @typedef {import('./task.mjs').Measurement} Measurement
 * @typedef {Parameters<typeof fit>[0]} Field
 */

/** @type {Task} */
const task = JSON.parse(process.argv[2] ?? '');
await init();
// The file is decoded in the other instance: the solver's memory holds the solve alone.
await load('files');
// The glue's own initialisation is done; again, it gives what it gave then.
const { memory } = await solverGlue();
const input = await readInput(task.input);
/** The solver's memory after the first solve. */
let bytes = 0;

console.log(JSON.stringify(fastest(solve)));

/** @param {Input} source */
async function readInput({ file, lattice, spacing, noData }) {
  const { width, height, data } = read(await readFile(file));
  const common = { noData: noData ?? undefined };
  return lattice === 'hex'
    ? { rows: height, cols: width, spacing, heights: data, ...common }
    : { width, height, pixelSize: spacing, data, ...common };
}

/**
 * @param {Field} field
 * @param {import('./task.mjs').Settings} settings
 */
function cold(field, settings) {
  const surface = fit(field, optionsOf(settings));
  return { surface, seconds: surface.report.seconds.total };
}

/**
 * A solve from where an earlier one has left the solver.
 * @param {Field} field
 * @param {import('./task.mjs').Settings} from
 * @param {import('./task.mjs').Settings} to
 */
function restart(field, from, to) {
  const solver = new Solver(field, optionsOf(from));
  try {
    while (solver.advance(50));
    const start = performance.now();
    solver.restart(optionsOf(to));
    while (solver.advance(50));
    const surface = solver.surface();
    return { surface, seconds: (performance.now() - start) / 1000 };
  } finally {
    solver.dispose();
  }
}

/** @returns {Measurement} */
function solve() {
  const { from, options } = task;
  const { surface, seconds } = from ? restart(input, from, options) : cold(input, options);
  // It never shrinks; a second solve would add what fragmentation costs.
  bytes ||= memory.buffer.byteLength;
  const { report } = surface;
  const given = 'heights' in input ? input.heights : input.data;
  return {
    vertices: report.interior + report.boundary + report.omitted,
    seconds,
    objective: report.objective,
    dualBound: report.dualBound,
    iterations: report.iterations,
    finest: report.levels.at(-1)?.iterations ?? 0,
    bytes,
    copies: given.byteLength + surface.heights.byteLength + (surface.image?.data.byteLength ?? 0),
    stop: report.stopReason,
  };
}
