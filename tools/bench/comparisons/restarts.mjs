/** A solve that goes on from the last one against one that starts from nothing. */
import { count, lambdaOf, range, ratio, seconds } from '../text.mjs';

/** @typedef {import('../bench.mjs').Bench} Bench */

/** @param {Bench} bench */
export async function restarts(bench) {
  const input = await bench.example('page', bench.quick ? 20_000 : 50_000);
  const rows = [];
  const gains = [];
  for (const lambda of [1e5, 1e6, 1e7]) {
    const options = { lambda: 1.5 * lambda };
    for (const where of /** @type {const} */ (['native', 'wasm'])) {
      const cold = await bench[where](input, options);
      const warm = await bench[where](input, options, { from: { lambda } });
      gains.push(cold.seconds / warm.seconds);
      rows.push([
        where, count(cold.vertices), lambdaOf(lambda), count(cold.finest), count(warm.finest),
        seconds(cold.seconds), seconds(warm.seconds), ratio(cold.seconds / warm.seconds),
      ]);
    }
  }
  return {
    summary: `Another λ from the last surface is ${range(gains)} times as fast as from nothing.`,
    title: 'Restarts',
    text: 'A solve at 1.5 λ to a gap of 1 %, from nothing and from where the same solver has '
      + 'arrived at λ, which is what moving a slider costs: the ADMM iterations on the finest '
      + 'lattice, the time from the call to the new surface, and how many times faster it is. A noisy page.',
    columns: ['where', 'vertices', 'from λ', 'iterations', 'restarted', 'time', 'restarted', 'ratio'],
    rows,
  };
}
