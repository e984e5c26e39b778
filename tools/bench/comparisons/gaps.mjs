/** Time to a certified gap, at the paper's three λ. */
import { count, lambdaOf, range, ratio, seconds } from '../text.mjs';

/**
 * @typedef {import('../bench.mjs').Bench} Bench
 * @typedef {import('../task.mjs').Input} Input
 */

/** @param {Bench} bench */
export async function gaps(bench) {
  const input = await bench.example('roof', bench.quick ? 20_000 : 250_000);
  const rows = [];
  /** @type {number[][]} */
  const [times, ratios] = [[], []];
  for (const lambda of [1e5, 1e6, 1e7]) {
    const { cells, time, slower } = await row(bench, input, lambda);
    const [vertices, ...others] = cells;
    rows.push([input.name, vertices, lambdaOf(lambda), ...others]);
    times.push(time);
    ratios.push(...slower);
  }
  return {
    summary: `${rows[0][1]} vertices are certified to 1 % in ${range(times)} s of wasm, which takes ${range(ratios)} times as long as native code.`,
    title: 'Time to a certified gap',
    text: 'A large input at the paper\'s three λ, until the certificate says 1 % and 0.1 %. '
      + 'Ratios: of the second time to the first, and of wasm to native.',
    columns: ['input', 'vertices', 'λ', 'native 1 %', '0.1 %', 'ratio', 'wasm 1 %', '0.1 %', 'ratio',
      'wasm : native, 1 %', '0.1 %'],
    rows,
  };
}

/**
 * @param {Bench} bench
 * @param {Input} input
 * @param {number} lambda
 */
async function row(bench, input, lambda) {
  const native = await bench.native(input, { lambda });
  const nativeFine = await bench.native(input, { lambda, gap: 0.001 });
  const wasm = await bench.wasm(input, { lambda });
  const wasmFine = await bench.wasm(input, { lambda, gap: 0.001 });
  const slower = [wasm.seconds / native.seconds, wasmFine.seconds / nativeFine.seconds];
  const cells = [
    count(native.vertices),
    seconds(native.seconds), seconds(nativeFine.seconds), ratio(nativeFine.seconds / native.seconds),
    seconds(wasm.seconds), seconds(wasmFine.seconds), ratio(wasmFine.seconds / wasm.seconds),
    ...slower.map(ratio),
  ];
  return { cells, time: wasm.seconds, slower };
}
