/** The connected part of a mesh that a place of its texture belongs to. */

/** @import {Mesh} from './api.js' */

/**
 * The connected part that contains the vertex whose texture coordinates are nearest to a place. Parts are found by union-find.
 * @param {Mesh} mesh with texture coordinates
 * @param {readonly [u: number, v: number]} place texture coordinates, from the lower left corner
 * @returns {Mesh | null} null if the mesh is connected
 */
export function partAt(mesh, [u, v]) {
  const { positions, triangles, uvs, colors, textureOf } = mesh;
  if (!uvs) return null;
  const count = positions.length / 3;
  const roots = Uint32Array.from({ length: count }, (_, i) => i);
  /** @param {number} i */
  const root = (i) => {
    while (roots[i] !== i) i = roots[i] = roots[roots[i]];
    return i;
  };
  for (let t = 0; t < triangles.length; t += 3) {
    roots[root(triangles[t + 1])] = root(triangles[t]);
    roots[root(triangles[t + 2])] = root(triangles[t]);
  }
  let [nearest, minDistance] = [-1, Infinity];
  for (const i of triangles) {
    const distance = (uvs[2 * i] - u) ** 2 + (uvs[2 * i + 1] - v) ** 2;
    if (distance < minDistance) [nearest, minDistance] = [i, distance];
  }
  if (nearest < 0) return null;
  const partRoot = root(nearest);
  const partTriangles = [...Array(triangles.length / 3).keys()].filter((t) => root(triangles[3 * t]) === partRoot);
  if (3 * partTriangles.length === triangles.length) return null;
  // Vertices of the other parts are removed, since vertices without triangles would be sampled as points.
  const numbers = new Int32Array(count).fill(-1);
  /** @type {number[]} */
  const vertices = [];
  const corners = partTriangles.flatMap((t) => [3 * t, 3 * t + 1, 3 * t + 2].map((at) => {
    const i = triangles[at];
    if (numbers[i] < 0) numbers[i] = vertices.push(i) - 1;
    return numbers[i];
  }));
  /** @param {ArrayLike<number>} values @param {number} width */
  const valuesOf = (values, width) => vertices.flatMap((i) => Array.from({ length: width }, (_, k) => values[width * i + k]));
  return {
    ...mesh,
    positions: Float64Array.from(valuesOf(positions, 3)),
    triangles: Uint32Array.from(corners),
    uvs: Float32Array.from(valuesOf(uvs, 2)),
    ...(colors && { colors: Float32Array.from(valuesOf(colors, 3)) }),
    ...(textureOf && { textureOf: Int32Array.from(partTriangles, (t) => textureOf[t]) }),
  };
}
