/** Meshes as inputs: checked as far as JS has to, in arrays of the types that Rust reads. */
import { DevelopableError } from './errors.js';
import { asBytes, numbers, optionalFloats, typed } from './input.js';
import { asPhoto } from './sheet-input.js';

/**
 * @param {import('./types.js').Mesh} mesh
 * @returns {import('./types.js').Mesh & { textures?: (Uint8Array | import('./sheet-input.js').Pixels)[] }}
 */
export function asMesh(mesh) {
  const { positions, triangles, colors, uvs, textureOf, textures } = Object(mesh);
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
    textureOf: textureOf === undefined ? undefined : numbersOf(textureOf),
    textures: textures === undefined ? undefined : [...textures].map(asPicture),
  };
}

/**
 * The bytes of a picture's file, or its pixels.
 * @param {import('./types.js').Picture} picture
 */
export function asPicture(picture) {
  return ArrayBuffer.isView(picture) || picture instanceof ArrayBuffer ? asBytes(picture) : asPhoto(picture);
}

/**
 * What lies beside a mesh's file, as pairs of a name and bytes.
 * @param {import('./types.js').ReadMeshOptions['files']} files
 * @returns {[string, Uint8Array][]}
 */
export function asFiles(files) {
  const entries = files instanceof Map ? [...files] : Object.entries(files ?? {});
  return entries.map(([name, bytes]) => [String(name), asBytes(bytes)]);
}

/** @param {unknown} numbers of textures */
function numbersOf(numbers) {
  return numbers instanceof Int32Array ? numbers : Int32Array.from(typed(Float64Array, 'textureOf', numbers));
}

/** @param {unknown} triangles */
function indices(triangles) {
  if (triangles instanceof Uint32Array) return triangles;
  const values = numbers('triangles', triangles);
  const odd = values.findIndex((value) => !(Number.isInteger(value) && value >= 0 && value < 2 ** 32));
  if (odd < 0) return Uint32Array.from(values);
  throw new DevelopableError('INPUT', `triangles[${odd}] must be the number of a vertex, but is ${values[odd]}`);
}
