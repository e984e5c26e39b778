/** The default schedule against the paper's. */
import { Problem } from '../../util/problem.mjs';
import { gap } from '../task.mjs';
import { count, percent, range, ratio, seconds } from '../text.mjs';

/**
 * @typedef {import('../bench.mjs').Bench} Bench
 * @typedef {import('../task.mjs').Input} Input
 * @typedef {import('../task.mjs').Measurement} Measurement
 */

/** Two programs for one schedule may differ by so much in their objectives, relatively. */
const agreement = 1e-3;

/** @param {Bench} bench */
export async function schedules(bench) {
  const inputs = bench.quick
    ? [await bench.example('page', 3_000)]
    : [
        await bench.example('page', 3_000),
        await bench.example('page', 10_000),
      ];
  const rows = [];
  const times = [];
  for (const input of inputs) {
    const { ofInput, cholesky } = await rowsOf(bench, input);
    rows.push(...ofInput);
    times.push(cholesky);
  }
  return {
    summary: `The authors' algorithm with sparse Cholesky takes ${range(times)} times as long to the same certified gap.`,
    title: "The default schedule and the paper's",
    text: "The paper's schedule stops on residuals. It runs in this library, which solves each "
      + 'z-step tightly by conjugate gradients (CG), and as its authors run it, with a sparse '
      + 'Cholesky factorisation in the z-step: faer\'s, made anew for each ρ, its symbolic part '
      + 'once, the assembly of its matrices not counted. The default schedule runs to a certified '
      + "gap of 1 %, and to the gap that the paper's has reached in the end, which the ratios are "
      + 'to. The objective is compared with that of the first of the two, and shows that both do '
      + 'the same. λ = 1e6.',
    columns: ['schedule', 'input', 'vertices', 'iterations', 'gap', 'objective', 'native', 'ratio', 'wasm', 'ratio'],
    rows,
  };
}

/**
 * @param {Bench} bench
 * @param {Input} input
 */
async function rowsOf(bench, input) {
  const paper = { schedule: /** @type {const} */ ('paper') };
  const reference = await bench.native(input, paper);
  const same = { gap: gap(reference) };
  const base = { native: await bench.native(input, same), wasm: await bench.wasm(input, same) };
  const cholesky = await bench.native(input, paper, { method: 'cholesky' });
  if (Math.abs(excess(cholesky)) > agreement) {
    throw new Problem(`The paper's schedule gives objectives that differ by ${excess(cholesky)}: one of the two programs is wrong.`);
  }
  const ofInput = [
    row('default, to 1 %', await bench.native(input), await bench.wasm(input)),
    row('default, to the same gap', base.native, base.wasm),
    row("paper's, CG", reference, await bench.wasm(input, paper)),
    row("paper's, Cholesky", cholesky),
  ];
  return { ofInput, cholesky: cholesky.seconds / base.native.seconds };

  /** @param {Measurement} run */
  function excess(run) {
    return run.objective / reference.objective - 1;
  }

  /**
   * @param {string} schedule
   * @param {Measurement} native
   * @param {Measurement} [wasm]
   */
  function row(schedule, native, wasm) {
    return [
      schedule, input.name, count(native.vertices), count(native.iterations), percent(gap(native)),
      native === reference ? '' : excess(native).toExponential(0),
      seconds(native.seconds), ratio(native.seconds / base.native.seconds),
      ...(wasm ? [seconds(wasm.seconds), ratio(wasm.seconds / base.wasm.seconds)] : ['', '']),
    ];
  }
}
