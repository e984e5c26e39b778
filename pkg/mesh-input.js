/** Meshes as inputs: checked as far as JS has to, in arrays of the types that Rust reads. */
import { DevelopableError } from './errors.js';
import { numbers, optionalFloats, typed } from './input.js';

/**
 * @param {import('./types.js').Mesh} mesh
 * @returns {import('./types.js').Mesh}
 */
export function asMesh(mesh) {
  const { positions, triangles, colors, uvs } = Object(mesh);
  if (positions === undefined) {
    throw new DevelopableError(
      'INPUT',
      'the mesh must be { positions, triangles }, with colors and uvs if there are any; without triangles it is a point cloud',
    );
  }
  return {
    positions: typed(Float64Array, 'positions', positions),
    triangles: indices(triangles ?? []),
    colors: optionalFloats('colors', colors),
    uvs: optionalFloats('uvs', uvs),
  };
}

/** @param {unknown} triangles */
function indices(triangles) {
  if (triangles instanceof Uint32Array) return triangles;
  const values = numbers('triangles', triangles);
  const odd = values.findIndex((value) => !(Number.isInteger(value) && value >= 0 && value < 2 ** 32));
  if (odd < 0) return Uint32Array.from(values);
  throw new DevelopableError('INPUT', `triangles[${odd}] must be the number of a vertex, but is ${values[odd]}`);
}
