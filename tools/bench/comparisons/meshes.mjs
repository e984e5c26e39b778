/** What it takes to look at a mesh. */
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
    const mesh = sheet(cells);
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

/**
 * A tilted square of so many cells along each side, of two triangles each.
 * @param {number} cells
 */
function sheet(cells) {
  const n = cells + 1;
  const positions = new Float64Array(3 * n * n);
  const triangles = new Uint32Array(6 * cells * cells);
  for (let row = 0, at = 0; row < n; row++) {
    for (let col = 0; col < n; col++) {
      const i = row * n + col;
      positions.set([col / cells, row / cells, (col + 2 * row) / (4 * cells)], 3 * i);
      if (row === cells || col === cells) continue;
      triangles.set([i, i + 1, i + n + 1, i, i + n + 1, i + n], at);
      at += 6;
    }
  }
  return { positions, triangles };
}
