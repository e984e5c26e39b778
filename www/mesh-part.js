/** A connected part of a mesh: the one that a place of its picture shows. */

/** @import {Mesh} from './api.js' */

/**
 * @param {Mesh} mesh with texture coordinates
 * @param {readonly [u: number, v: number]} place from the left and from the bottom of the picture, as shares
 * @returns {Mesh | null} none where there is but one part
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
  let [nearest, least] = [-1, Infinity];
  for (const i of triangles) {
    const off = (uvs[2 * i] - u) ** 2 + (uvs[2 * i + 1] - v) ** 2;
    if (off < least) [nearest, least] = [i, off];
  }
  if (nearest < 0) return null;
  const wanted = root(nearest);
  const kept = [...Array(triangles.length / 3).keys()].filter((t) => root(triangles[3 * t]) === wanted);
  if (3 * kept.length === triangles.length) return null;
  // Vertices of the part alone, for what else there is would count as seen.
  const numbers = new Int32Array(count).fill(-1);
  /** @type {number[]} */
  const vertices = [];
  const corners = kept.flatMap((t) => [3 * t, 3 * t + 1, 3 * t + 2].map((at) => {
    const i = triangles[at];
    if (numbers[i] < 0) numbers[i] = vertices.push(i) - 1;
    return numbers[i];
  }));
  /** @param {ArrayLike<number>} values @param {number} width */
  const of = (values, width) => vertices.flatMap((i) => Array.from({ length: width }, (_, k) => values[width * i + k]));
  return {
    ...mesh,
    positions: Float64Array.from(of(positions, 3)),
    triangles: Uint32Array.from(corners),
    uvs: Float32Array.from(of(uvs, 2)),
    ...(colors && { colors: Float32Array.from(of(colors, 3)) }),
    ...(textureOf && { textureOf: Int32Array.from(kept, (t) => textureOf[t]) }),
  };
}
