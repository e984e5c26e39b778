/**
 * The way of a surface from its bent to its flat form: each sheet turns and moves as a whole, and its vertices go straight from
 * where they are bent to where they are flat. An edge that slopes by an angle is shorter meanwhile, by the cosine of half the
 * angle at most.
 */
import { borderLines } from './assembly-mesh.js';
import { divergingColour } from './colours.js';

/**
 * @typedef {object} Unfolding a mesh that changes between two forms
 * @property {Uint32Array} triangles
 * @property {Float32Array} flat x, y, z of the vertices in the flat form
 * @property {Float32Array} bent x, y, z of the vertices in the bent form, from the middle of their sheet and turned as in the flat form
 * @property {Uint32Array} sheets index of the sheet of each vertex
 * @property {readonly SheetMove[]} moves by which each sheet comes to its flat place
 * @property {Float32Array} colors of the vertices, 0 to 1
 * @property {Float32Array} strains of the vertices
 * @property {readonly Uint32Array[]} borders vertices along each of its border lines
 */
/** @typedef {{ from: number[], to: number[], angle: number }} SheetMove middles of the bent and the flat form, and the angle by which the bent one is turned about z */

/**
 * Prepares the unfolding of a mesh, coloured by strain.
 * @param {object} unrolling
 * @param {Float64Array} unrolling.positions x, y, z of each vertex
 * @param {Float64Array} unrolling.places x, y on the sheet
 * @param {Uint32Array} unrolling.triangles
 * @param {Float64Array} unrolling.stretches singular values of each triangle's map to the sheet
 * @param {Uint32Array} [unrolling.sheets] index of the sheet of each vertex; by default there is one
 * @param {number} most strain at the end of the colour scale
 * @param {readonly [number, number]} offset added to x and y of the positions
 * @returns {Unfolding}
 */
export function computeUnfolding({ positions, places, triangles, stretches, sheets = new Uint32Array(places.length / 2) }, most, [left, bottom]) {
  const n = places.length / 2;
  const count = sheets.reduce((last, sheet) => Math.max(last, sheet), 0) + 1;
  const world = positions.map((value, i) => value + [left, bottom, 0][i % 3]);
  const shift = mean(world, 3).map((value, k) => value - (k < 2 ? mean(places, 2)[k] : 0));
  const flat = Float32Array.from({ length: 3 * n }, (_, i) => (i % 3 < 2 ? places[2 * Math.floor(i / 3) + (i % 3)] : 0) + shift[i % 3]);
  const bent = new Float32Array(3 * n);
  const moves = Array.from({ length: count }, (_, sheet) => {
    const own = [...sheets.keys()].filter((vertex) => sheets[vertex] === sheet);
    const [from, to] = [world, flat].map((form) => mean(own.flatMap((vertex) => [form[3 * vertex], form[3 * vertex + 1], form[3 * vertex + 2]]), 3));
    // The angle that brings both forms closest to each other, seen from above.
    let [along, across] = [0, 0];
    for (const vertex of own) {
      const [x, y, u, v] = [flat[3 * vertex] - to[0], flat[3 * vertex + 1] - to[1], world[3 * vertex] - from[0], world[3 * vertex + 1] - from[1]];
      along += x * u + y * v;
      across += x * v - y * u;
    }
    const angle = Math.atan2(across, along);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    for (const vertex of own) {
      const [x, y, z] = [0, 1, 2].map((k) => world[3 * vertex + k] - from[k]);
      bent.set([c * x + s * y, c * y - s * x, z], 3 * vertex);
    }
    return { from, to, angle };
  });
  const strains = vertexStrains(triangles, stretches, n);
  const colors = Float32Array.from([...strains].flatMap((strain) => divergingColour(strain / most).map((value) => value / 255)));
  return { triangles, flat, bent, sheets, moves, strains, colors, borders: borderLines(triangles) };
}

/** The positions of the vertices on the way. @param {Unfolding} unfolding @param {number} share from bent, 0, to flat, 1 */
export function unfoldedPositions({ flat, bent, sheets, moves }, share) {
  const positions = new Float32Array(flat.length);
  const turns = moves.map(({ angle }) => [Math.cos((1 - share) * angle), Math.sin((1 - share) * angle)]);
  sheets.forEach((sheet, vertex) => {
    const [{ from, to }, [c, s], i] = [moves[sheet], turns[sheet], 3 * vertex];
    const [x, y, z] = [0, 1, 2].map((k) => bent[i + k] + share * (flat[i + k] - to[k] - bent[i + k]));
    [c * x - s * y, s * x + c * y, z].forEach((value, k) => (positions[i + k] = value + from[k] + share * (to[k] - from[k])));
  });
  return positions;
}

/** The mean of points. @param {ArrayLike<number>} values @param {number} size number of coordinates */
function mean(values, size) {
  const sums = new Array(size).fill(0);
  for (let i = 0; i < values.length; i++) sums[i % size] += values[i];
  return sums.map((sum) => (sum * size) / values.length);
}

/**
 * The strain of each vertex: the mean over its triangles.
 * @param {Uint32Array} triangles
 * @param {Float64Array} stretches
 * @param {number} n
 */
function vertexStrains(triangles, stretches, n) {
  const [sums, counts] = [new Float64Array(n), new Float64Array(n)];
  triangles.forEach((vertex, i) => {
    sums[vertex] += triangleStrain(stretches, Math.floor(i / 3));
    counts[vertex]++;
  });
  return Float32Array.from(sums, (sum, i) => sum / (counts[i] || 1));
}

/**
 * The principal strain of larger magnitude of a triangle; positive where it is stretched.
 * @param {Float64Array} stretches singular values, two for each triangle
 * @param {number} t index of the triangle
 */
export function triangleStrain(stretches, t) {
  const [large, small] = [stretches[2 * t] - 1, stretches[2 * t + 1] - 1];
  return Math.abs(large) >= Math.abs(small) ? large : small;
}
