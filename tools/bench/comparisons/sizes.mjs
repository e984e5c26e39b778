/** How the cost grows with the number of vertices. */
import { count, micros, range, ratio, seconds } from '../text.mjs';

/**
 * @typedef {import('../bench.mjs').Bench} Bench
 * @typedef {import('../task.mjs').Measurement} Measurement
 */

/** @param {Bench} bench */
export async function sizes(bench) {
  const vertices = bench.quick
    ? [20_000, 50_000, 100_000]
    : [20_000, 50_000, 100_000, 250_000, 500_000, 1_000_000];
  const rows = [];
  const each = [];
  /** @type {{ native: Measurement, wasm: Measurement } | undefined} */
  let first;
  for (const size of vertices) {
    const input = await bench.example('page', size);
    const native = await bench.native(input);
    const wasm = await bench.wasm(input);
    first ??= { native, wasm };
    each.push(1e6 * wasm.seconds / wasm.vertices);
    rows.push([
      count(native.vertices), count(native.finest),
      ...cost(native, first.native), ...cost(wasm, first.wasm),
      ratio(wasm.seconds / native.seconds),
    ]);
  }
  return {
    summary: `A vertex costs ${range(each)} µs in wasm, from ${count(vertices[0])} vertices to ${count(vertices.at(-1) ?? 0)}.`,
    title: 'One size and the next',
    text: 'A noisy page on finer and finer lattices, at λ = 1e6, to a gap of 1 %: the ADMM '
      + 'iterations on the finest of them, the time, microseconds for each vertex, and their ratio '
      + 'to those in the first row, which would be 1 if the cost were linear.',
    columns: ['vertices', 'iterations', 'native', 'µs each', 'ratio', 'wasm', 'µs each', 'ratio', 'wasm : native'],
    rows,
  };
}

/**
 * @param {Measurement} run
 * @param {Measurement} first
 */
function cost(run, first) {
  const each = run.seconds / run.vertices;
  return [seconds(run.seconds), micros(each), ratio(each / (first.seconds / first.vertices))];
}
