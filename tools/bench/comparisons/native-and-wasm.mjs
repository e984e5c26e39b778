/** Native code against wasm. */
import { count, lambdaOf, range, ratio, seconds } from '../text.mjs';

/** @typedef {import('../bench.mjs').Bench} Bench */

/** @type {{ name: import('../../../pkg/types.js').ExampleName, lambda: number, gap: number }[]} */
const cases = [
  { name: 'page', lambda: 1e6, gap: 0.01 },
  { name: 'page', lambda: 1e6, gap: 0.001 },
  { name: 'page', lambda: 1e5, gap: 0.01 },
  { name: 'oloid', lambda: 1e6, gap: 0.001 },
  { name: 'roof', lambda: 1e6, gap: 0.001 },
];

/** @param {Bench} bench */
export async function nativeAndWasm(bench) {
  const rows = [];
  const ratios = [];
  for (const { name, lambda, gap } of cases) {
    const input = await bench.example(name, bench.quick ? 20_000 : 100_000);
    const native = await bench.native(input, { lambda, gap });
    const wasm = await bench.wasm(input, { lambda, gap });
    ratios.push(wasm.seconds / native.seconds);
    rows.push([
      name, count(native.vertices), lambdaOf(lambda), `${100 * gap} %`,
      count(native.iterations), count(wasm.iterations),
      seconds(native.seconds), seconds(wasm.seconds), ratio(wasm.seconds / native.seconds),
    ]);
  }
  return {
    summary: `Wasm takes ${range(ratios)} times as long as native code.`,
    title: 'Native code and wasm',
    text: 'The same heights and options, natively and in wasm in Node through the package\'s '
      + 'synchronous API, one thread each: the time from making the solver to the surface, as the '
      + 'report has it, and the iterations on all levels.',
    columns: ['input', 'vertices', 'λ', 'gap', 'iterations', 'in wasm', 'native', 'wasm', 'ratio'],
    rows,
  };
}
