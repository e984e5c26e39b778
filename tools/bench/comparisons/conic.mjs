/** The library against a general conic solver. */
import { count, digits, percent, range, ratio, seconds } from '../text.mjs';

/**
 * @typedef {import('../bench.mjs').Bench} Bench
 * @typedef {import('../task.mjs').Measurement} Measurement
 */

/** @param {Bench} bench */
export async function conic(bench) {
  const sizes = bench.quick ? [900] : [900, 3_600, 10_000];
  const rows = [];
  /** @type {number[][]} */
  const [times, bytes] = [[], []];
  for (const size of sizes) {
    const input = await bench.example('page', size);
    const ours = await bench.native(input, { gap: 1e-3 });
    const bound = (await bench.native(input, { gap: 1e-6 })).dualBound ?? NaN;
    /** @type {[string, Measurement][]} */
    const runs = [
      ['developable, 1e-3', ours],
      ['Clarabel, 1e-3', await bench.native(input, { gap: 1e-3 }, { method: 'conic' })],
      ['Clarabel, 1e-8', await bench.native(input, { gap: 1e-8 }, { method: 'conic' })],
    ];
    times.push(runs[1][1].seconds / ours.seconds);
    bytes.push(runs[1][1].bytes / ours.bytes);
    for (const [name, run] of runs) {
      rows.push([
        name, count(run.vertices), count(run.iterations),
        seconds(run.seconds), ratio(run.seconds / ours.seconds),
        digits(run.bytes / run.vertices), ratio(run.bytes / ours.bytes),
        percent((run.objective - bound) / run.objective),
      ]);
    }
  }
  return {
    summary: `Clarabel, a general conic solver, takes ${range(times)} times as long and ${range(bytes)} times the memory.`,
    title: 'A general conic solver',
    text: 'Clarabel solves the same energy as a second-order cone program, once with all its '
      + 'tolerances at 1e-3 and once at its own 1e-8; this library runs to a gap of 1e-3. Native code, '
      + 'one thread. The assembly of Clarabel\'s matrices is not counted. Memory is the most heap in '
      + 'use beyond the input. The last column is what was reached: how far the result lies above a '
      + 'bound of the optimum that is certified to 1e-6. A noisy page, λ = 1e6.',
    columns: ['solver, tolerance', 'vertices', 'iterations', 'time', 'ratio', 'bytes per vertex', 'ratio', 'above optimum'],
    rows,
  };
}
