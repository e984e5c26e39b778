/** Memory for each vertex. */
import { count, digits, range } from '../text.mjs';

/** @typedef {import('../bench.mjs').Bench} Bench */

/** @param {Bench} bench */
export async function memory(bench) {
  const size = bench.quick ? 100_000 : 1_000_000;
  const rows = [];
  const together = [];
  for (const lattice of /** @type {const} */ (['hex', 'square'])) {
    const input = await bench.example('roof', size, lattice);
    const native = await bench.native(input);
    const { bytes, copies = NaN, vertices } = await bench.wasm(input);
    together.push((bytes + copies) / vertices);
    rows.push([
      lattice === 'hex' ? 'heights on the lattice' : 'height image',
      count(vertices), `${digits(bytes / 1e6)} MB`,
      ...[bytes, copies, bytes + copies, native.bytes].map((each) => digits(each / vertices)),
    ]);
  }
  return {
    summary: `A solve needs ${range(together)} bytes for each vertex, the caller's arrays included.`,
    title: 'Memory',
    text: 'The wasm\'s memory after one solve in a fresh process (it never shrinks, so this is its '
      + 'peak; what the package\'s caller hands over is copied into it), the caller\'s own arrays, '
      + 'input and result, and both together. For comparison the most heap that the native solver '
      + 'has in use beyond its input. A noisy roof, which fills its bounding box.',
    columns: ['input', 'vertices', 'wasm memory', 'bytes per vertex', "caller's arrays", 'together', 'native'],
    rows,
  };
}
