/** What it takes to look at a mesh. */
import { gridMesh } from '../../util/grid-mesh.mjs';
import { count, micros, ratio, seconds } from '../text.mjs';

/** @typedef {import('../bench.mjs').Bench} Bench */

/** Looks that the fastest is taken of. */
const RUNS = 3;

/** @param {Bench} bench */
export async function meshes(bench) {
  const { load, sampleMesh } = await import('../../../pkg/direct.js');
  await load('meshes');
  const rows = [];
  let first;
  for (const cells of bench.quick ? [100, 300] : [220, 710]) {
    // A tilted square of so many cells along each side.
    const mesh = gridMesh(cells + 1, cells + 1, (col, row) => [col / cells, row / cells, (col + 2 * row) / (4 * cells)]);
    const triangles = mesh.triangles.length / 3;
    const times = Array.from({ length: RUNS }, () => {
      const start = performance.now();
      const { heights } = sampleMesh(mesh, { resolution: 430 });
      return { time: (performance.now() - start) / 1000, vertices: heights.length };
    });
    const { time, vertices } = times.reduce((best, next) => (next.time < best.time ? next : best));
    console.log(`  wasm, sampling ${count(triangles)} triangles: ${seconds(time)}`);
    const each = time / triangles;
    first ??= each;
    rows.push([count(triangles), count(vertices), seconds(time), micros(each), ratio(each / first)]);
  }
  return {
    title: 'Looking at a mesh',
    text: 'From a mesh to heights on a lattice of 430 vertices across, in wasm, with the way of the mesh '
      + `into the wasm: the fastest of ${RUNS} looks, microseconds for each triangle, and their ratio to those `
      + 'in the first row.',
    columns: ['triangles', 'vertices', 'time', 'µs each', 'ratio'],
    rows,
  };
}
