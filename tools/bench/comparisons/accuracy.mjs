/** What high accuracy costs. */
import { gap } from '../task.mjs';
import { count, percent, ratio, seconds } from '../text.mjs';

/** @typedef {import('../bench.mjs').Bench} Bench */

/** Iterations after which it is given up. */
const maxIterations = 20_000;

/** @param {Bench} bench */
export async function accuracy(bench) {
  const input = await bench.example('roof', bench.quick ? 5_000 : 50_000);
  const goals = [0.01, 1e-3, 1e-4, 1e-5, 1e-6];
  const rows = [];
  let first;
  for (const goal of goals) {
    const run = await bench.native(input, { gap: goal, maxIterations });
    first ??= run;
    rows.push([
      goal.toExponential(), count(run.vertices), seconds(run.seconds), ratio(run.seconds / first.seconds),
      count(run.finest), run.stop === 'gap' ? 'yes' : `no, ${percent(gap(run))}`,
    ]);
  }
  return {
    summary: `A gap of ${rows.at(-1)?.[0]} takes ${rows.at(-1)?.[3]} the time of ${rows[0][0]}.`,
    title: 'High accuracy',
    text: 'Native time to smaller and smaller certified gaps, at λ = 1e6, and its ratio to the '
      + `first. Given up after ${count(maxIterations)} iterations.`,
    columns: ['gap', 'vertices', 'time', 'ratio', 'iterations', 'reached'],
    rows,
  };
}
