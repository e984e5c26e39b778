/** From a surface to sheets, stage by stage, in wasm. */
import { count, percent, seconds } from '../text.mjs';

/** @typedef {import('../../../pkg/types.js').ExampleName} ExampleName */

/** Share of the square over the longer side that has data. */
const shares = { page: 0.606, house: 0.75, roof: 1, oloid: 0.398 };

/** @param {import('../bench.mjs').Bench} bench */
export async function flattening(bench) {
  const direct = await import('../../../pkg/direct.js');
  await Promise.all([direct.init(), direct.load('unroll', 'patterns')]);
  const wanted = bench.quick ? 40_000 : 225_000;
  const rows = [];
  for (const name of /** @type {(keyof typeof shares)[]} */ (Object.keys(shares))) {
    const size = Math.round(Math.sqrt((wanted * Math.sqrt(0.75)) / shares[name]));
    const surface = direct.fit(direct.example(name, { size, noise: 0.01 }).input);
    const vertices = surface.heights.reduce((sum, z) => sum + Number(Number.isFinite(z)), 0);
    /** @template T @param {() => T} work @returns {[T, number]} */
    const timed = (work) => {
      const start = performance.now();
      const result = work();
      return [result, (performance.now() - start) / 1000];
    };
    const [, unrolling] = timed(() => direct.unroll(surface));
    const [, patching] = timed(() => direct.patches(surface));
    const [{ summary }, cutting] = timed(() => direct.pattern(surface, { scale: 100 }));
    rows.push([
      name, count(vertices), seconds(unrolling), seconds(patching), seconds(cutting), count(summary.sheets),
      `${count(summary.slits)}, ${(summary.slitLength / 100).toFixed(2)}`, percent(summary.strain), percent(summary.mismatch),
    ]);
  }
  return {
    title: 'Surfaces made flat, stage by stage',
    text: 'The library\'s examples under normal noise of 1 % of their range, solved at medium λ, then in wasm in Node, one thread, each '
      + 'once and in one process: `unroll` as a whole, `patches`, and `pattern` with its sheets, its slits and their length in '
      + 'longer sides, the largest strain of a sheet and the most that both sides of a cut differ.',
    columns: ['surface', 'vertices', 'unroll', 'patches', 'pattern', 'sheets', 'slits', 'strain', 'mismatch'],
    rows,
  };
}
