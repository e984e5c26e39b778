/** Colours at the vertices of a lattice, from the pictures that their texture coordinates are about. */
import { DevelopableError } from './errors.js';
import { isImagePhoto } from './formats.js';
import { asLattice } from './input.js';
import { files, images, meshes } from './instances.js';
import { asPicture } from './mesh-input.js';
import { optionsOf } from './options.js';
import { extentOf, placeOf } from './sheet-input.js';

/**
 * @typedef {import('./types.js').SampledMesh} SampledMesh
 * @typedef {Uint8Array | import('./sheet-input.js').Pixels} Given a picture as `asPicture` gives it
 * @typedef {{ width: number, height: number, data: Uint8Array | Uint8ClampedArray, orientation?: number }} Decoded
 */

/** @type {typeof import('./direct.js').readPhoto} */
export function readPhoto(bytes) {
  const file = /** @type {Uint8Array} */ (asPicture(bytes));
  return isImagePhoto(file) ? images.call((wasm) => wasm.readImagePhoto(file)) : files.call((wasm) => wasm.readPhoto(file));
}

/**
 * What `paint` adds to a field: of what a camera has seen, the picture is where that camera, or the photo's own, sees the
 * points of this surface, and not where it saw the noisy ones.
 * @param {import('./types.js').Heightfield} input
 * @param {import('./types.js').Picture} picture
 * @param {import('./types.js').PaintOptions} [given]
 */
export function paintOf(input, picture, given) {
  const options = optionsOf('paint', given);
  const lattice = asLattice(input);
  const { colors, heights = new Float64Array() } = lattice;
  const found = asPicture(picture);
  /** @type {Decoded} */
  const pixels = found instanceof Uint8Array ? readPhoto(found) : found;
  const start = colors ?? blank(heights);
  const uvs = uvsOf(input, lattice, pixels, options);
  return { uvs, colors: painted(start, uvs, pixels), texture: uprightFile(found, pixels) };
}

/**
 * @param {import('./types.js').Heightfield} input
 * @param {import('./input.js').Lattice} lattice
 * @param {{ width: number, height: number }} picture
 * @param {import('./types.js').PaintOptions} options
 * @returns {Float32Array}
 */
function uvsOf(input, lattice, { width, height }, options) {
  const { camera, frame, uvs } = placeOf(lattice, options);
  if (camera) return meshes.call((wasm) => wasm.cameraUvs(lattice, camera, frame, width, height));
  return uvs ?? files.call((wasm) => wasm.planeUvs(lattice, options.extent ?? extentOf(input)));
}

/**
 * What is seen of a mesh, in the colours of its textures.
 * @param {SampledMesh} seen
 * @param {Int32Array} textureOf the texture at each vertex
 * @param {Given[]} [textures]
 * @returns {SampledMesh}
 */
export function inColour(seen, textureOf, textures = []) {
  const { uvs, heights } = seen;
  if (!uvs) return seen;
  const used = textures.map((picture, number) => ({ picture, number })).filter(({ number }) => textureOf.includes(number));
  if (used.length === 0) return seen;
  const colors = used.reduce(
    (colors, { picture, number }) => {
      try {
        return painted(colors, uvs, picture, textureOf, number);
      } catch (error) {
        // A picture of another kind, as TGA, is as good as none.
        if (error instanceof DevelopableError && error.code === 'UNSUPPORTED') return colors;
        throw error;
      }
    },
    seen.colors ?? blank(heights),
  );
  // One picture for all of it can go on as it is.
  const whole = used.length === 1 && textureOf.every((number, i) => number === used[0].number || Number.isNaN(heights[i]));
  const texture = whole ? fileOf(used[0].picture) : undefined;
  return { ...seen, colors, ...(texture && { texture }) };
}

/**
 * @param {Float32Array} colors
 * @param {Float32Array} uvs
 * @param {Given | Decoded} picture
 * @param {Int32Array} [textureOf]
 * @param {number} [number]
 */
function painted(colors, uvs, picture, textureOf, number = 0) {
  const { width, height, data } = pixelsOf(picture);
  const photo = { width, height, data: new Uint8Array(data.buffer, data.byteOffset, data.byteLength) };
  return files.call((wasm) => wasm.paint(colors, uvs, photo, textureOf, number));
}

/** White where there is something. @param {ArrayLike<number>} heights */
function blank(heights) {
  return Float32Array.from({ length: 3 * heights.length }, (_, i) => (Number.isNaN(heights[Math.floor(i / 3)]) ? NaN : 1));
}

/** Quality of a texture's JPEG file, from 1 to 100. */
const TEXTURE_JPEG_QUALITY = 92;

/**
 * Textures as JPEG files of three channels, to be printed.
 * @param {Given[]} [textures]
 * @returns {import('./types.js').TextureFile[]}
 */
export function jpegsOf(textures = []) {
  if (textures.length === 0) {
    throw new DevelopableError('INPUT', 'the mesh has no textures that could be printed: give `textures` and `uvs`, or leave out `printed`');
  }
  return textures.map((picture) => {
    const pixels = pixelsOf(picture);
    return { jpeg: jpegOf(pixels), width: pixels.width, height: pixels.height };
  });
}

/** @param {Given | Decoded} picture */
const pixelsOf = (picture) => (picture instanceof Uint8Array ? readPhoto(picture) : picture);

/** @param {Pick<Decoded, 'width' | 'height' | 'data'>} pixels */
function jpegOf({ width, height, data }) {
  const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
  return files.call((wasm) => wasm.writePhoto(width, height, bytes, { format: 'jpeg', quality: TEXTURE_JPEG_QUALITY }));
}

/**
 * The file for a mesh's texture. glTF has no regard for the Exif note which way up a photo is, so that one which lies on
 * its side is written anew.
 * @param {Given} picture
 * @param {Decoded} pixels
 */
function uprightFile(picture, pixels) {
  return pixels.orientation === undefined ? fileOf(picture) : jpegOf(pixels);
}

/** The file, if it is one that meshes can have as their texture. @param {Given} picture */
function fileOf(picture) {
  if (!(picture instanceof Uint8Array)) return undefined;
  return picture[0] === 0x89 || (picture[0] === 0xff && picture[1] === 0xd8) ? picture : undefined;
}
