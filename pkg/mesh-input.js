/** Meshes as inputs: checked as far as JS has to, in arrays of the types that Rust reads. */
import { DevelopableError } from './errors.js';
import { asBytes, asCamera, asLattice, numbers, optionalFloats, typed, unitOf } from './input.js';
import { asPhoto } from './sheet-input.js';
import { isRecord, reading, record, refuseMisspelled, show, typeOf } from './values.js';

const MESH = /** @type {const} */ (['positions', 'triangles', 'colors', 'uvs', 'textures', 'textureOf', 'missing', 'assumptions', 'camera', 'unit', 'confidence', 'report']);

/**
 * @param {import('./types.js').Mesh} mesh
 * @returns {import('./types.js').Mesh & { textures?: (Uint8Array | import('./sheet-input.js').Pixels)[] }}
 */
export function asMesh(mesh) {
  const { positions, triangles, colors, uvs, textureOf, textures, camera, unit, confidence } = record('INPUT', 'the mesh', mesh, MESH);
  refuseMisspelled('the mesh', mesh, MESH);
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
    textureOf: textureOf === undefined ? undefined : Int32Array.from(numbers('textureOf', textureOf)),
    camera: camera === undefined ? undefined : asCamera(camera),
    unit: unitOf(unit),
    confidence: optionalFloats('confidence', confidence),
    textures: textures === undefined
      ? undefined
      : reading('INPUT', 'textures', () => [.../** @type {Iterable<unknown>} */ (textures)].map(asPicture)),
  };
}

/**
 * A mesh for a fit: what the wasm needs of it, and what the result has of it besides its positions.
 * @param {import('./types.js').Mesh} mesh
 */
export function wholeOf(mesh) {
  const { positions, triangles, confidence, ...rest } = asMesh(mesh);
  const { colors, uvs, textureOf, textures, camera, unit } = rest;
  const copies = { triangles, colors, uvs, textureOf, confidence };
  const own = Object.entries(copies).flatMap(([name, array]) => (array === undefined ? [] : [[name, array.slice()]]));
  const carried = Object.entries({ textures, camera, unit }).filter(([, value]) => value !== undefined);
  return { shape: { positions, triangles, confidence, unit }, own: Object.fromEntries([...own, ...carried]) };
}

/** Whether an input is a mesh, and not heights. @param {unknown} input */
export function isMesh(input) {
  return reading('INPUT', 'the input', () => isRecord(input) && 'positions' in /** @type {object} */ (input));
}

/**
 * What can be written as a mesh: one, or heights on the lattice.
 * @param {unknown} input
 * @returns {any}
 */
export function asMeshOrLattice(input) {
  if (!isMesh(input)) return asLattice(/** @type {import('./types.js').Heightfield} */ (input));
  const { positions, triangles, colors, uvs, textures } = asMesh(/** @type {import('./types.js').Mesh} */ (input));
  return { positions, triangles, colors, uvs, textures };
}

/**
 * The bytes of a picture's file, or its pixels.
 * @param {unknown} picture
 */
export function asPicture(picture) {
  return reading('INPUT', 'the picture', () =>
    (typeOf(picture) !== undefined || picture instanceof DataView || picture instanceof ArrayBuffer
      ? asBytes(picture)
      : asPhoto(picture)));
}

/**
 * What lies beside a mesh's file, as pairs of a name and bytes.
 * @param {import('./types.js').ReadMeshOptions['files']} files
 * @returns {[string, Uint8Array][]}
 */
export function asFiles(files) {
  return reading('INPUT', 'files', () => {
    const entries = files instanceof Map ? [...files] : Object.entries(files ?? {});
    return entries.map(([name, bytes]) => [String(name), asBytes(bytes)]);
  });
}

/** @param {unknown} triangles */
function indices(triangles) {
  const values = numbers('triangles', triangles);
  if (values instanceof Uint32Array) return values;
  const odd = values.findIndex((value) => !(Number.isInteger(value) && value >= 0 && value < 2 ** 32));
  if (odd < 0) return Uint32Array.from(values);
  throw new DevelopableError('INPUT', `triangles[${odd}] must be the number of a vertex, but is ${show(values[odd])}`);
}
