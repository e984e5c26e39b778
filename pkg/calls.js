/**
 * The calls that the worker answers: what each sends there, and which wasm files it takes. The client sends by this table, the
 * service loads by it, and the promise API forwards by it; what a call does is in `direct.js`. A new call is one row here, or in
 * `plain-calls.js`.
 */
import { asDepthOptions } from './depth-input.js';
import { copyOfFile } from './file-bytes.js';
import { isBasic, isImage, isImagePhoto } from './formats.js';
import { asBytes, asField, asHeights, asImage, asPixels, detached } from './input.js';
import { asFiles, asMesh, asMeshOrLattice, asPicture, isMesh, wholeOf } from './mesh-input.js';
import { optionsOf } from './options.js';
import { asEdges, asFoundPage, edgesAndOptions, pageOptions, plainEdges } from './page-input.js';
import { asSurface, ofPlainCalls } from './plain-calls.js';
import { fileOf as photoFileOf, photoOf } from './photo-source.js';
import { asBook, placedOptions, printOptions } from './sheet-input.js';
import { transfer } from './wire.js';

/**
 * @typedef {import('./direct.js').PartName} PartName
 * @typedef {PartName | 'solver'} Part a wasm file
 * @typedef {any[]} Arguments of a call, as the caller or the client gives them
 *
 * @typedef {object} Call
 * @property {(...given: Arguments) => Arguments | Promise<Arguments>} send checked copies of a caller's arguments, for the worker
 * @property {readonly Part[] | ((...sent: Arguments) => readonly Part[])} parts wasm files that it takes
 */

/** @type {Record<import('./plain-calls.js').PlainCallName, Call>} */
const plainCalls = ofPlainCalls((_, part, check) => ({
  parts: (taken) => [part(taken)],
  send(input, given) {
    const [taken, options] = check(input, given);
    return [taken?.kind ? handedOver(taken) : taken, options];
  },
}));

/** @satisfies {Record<string, Call>} */
export const CALLS = {
  ...plainCalls,
  occlusions: {
    parts: ['solver'],
    send(input, given) {
      const options = optionsOf('occlusions', given);
      return [handedOver(asField(input)), options];
    },
  },
  read: {
    parts: (bytes, options) => [isImage(asBytes(bytes), options) ? 'images' : 'files'],
    async send(bytes, given) {
      const options = optionsOf('read', given);
      return [await fileOf(bytes), options];
    },
  },
  formatOf: { parts: ['files'], send: async (bytes) => [await fileOf(bytes)] },
  npzArrays: { parts: ['images'], send: async (bytes) => [await fileOf(bytes)] },
  writeImage: {
    parts: (_, { format }) => [isBasic(format) ? 'files' : 'images'],
    send(input, given) {
      const { format = 'npy' } = /** @type {import('./types.js').WriteImageOptions} */ (optionsOf('writeImage', given));
      return [handedOver(asPixels(input, format)), { format }];
    },
  },
  writeGlb: {
    parts: ['meshes'],
    async send(input, given) {
      const field = handedOver(asMeshOrLattice(input));
      const { texture, ...options } = optionsOf('writeGlb', given);
      return [field, { ...options, texture: texture === undefined || texture === null ? texture : await copyOfFile(texture) }];
    },
  },
  writePhoto: {
    parts: ['files'],
    send(photo, given) {
      const { transfer: handOver, ...options } = printOptions(photo, given);
      return [sentPhoto(photo, handOver), options];
    },
  },
  writeBook: {
    parts: ['files'],
    send: (pages, given) => [asBook(pages).map((page) => ({ ...page, picture: new Uint8Array(page.picture) })), optionsOf('writeBook', given)],
  },
  readMesh: {
    parts: ['meshes'],
    async send(bytes, given) {
      const { files, ...options } = /** @type {import('./types.js').ReadMeshOptions} */ (optionsOf('readMesh', given));
      const beside = new Map(asFiles(files));
      return [await fileOf(bytes), { ...options, files: beside }];
    },
  },
  readPhoto: {
    parts: (bytes) => forPictures([bytes]),
    async send(bytes) {
      const file = await photoFileOf(bytes);
      return [transfer(file, [file.buffer])];
    },
  },
  sampleMesh: {
    parts: (mesh) => ['meshes', ...(mesh.textures ? forPictures(mesh.textures) : [])],
    send(mesh, given) {
      const options = optionsOf('sampleMesh', given);
      return [asMesh(mesh), options];
    },
  },
  backProject: {
    parts: ['meshes'],
    send(input, intrinsics, given) {
      const known = asDepthOptions(given);
      const camera = optionsOf('camera', intrinsics);
      return [handedOver(asImage(input)), camera, known];
    },
  },
  analyze: {
    parts: (input) => [isMesh(input) ? 'fitmesh' : 'unroll'],
    send(input, given) {
      if (isMesh(input)) {
        const options = optionsOf('analyzeMesh', given);
        return [asSurface(input), options];
      }
      const { reference, ...options } = /** @type {import('./types.js').AnalyzeOptions} */ (optionsOf('analyze', given));
      const field = handedOver(asSurface(input));
      return [field, { ...options, reference: reference === undefined ? undefined : asField(reference) }];
    },
  },
  fitCylinder: { parts: ['solver'], send: (input) => [handedOver(asHeights(input))] },
  pattern: {
    parts: ({ textures }) => ['patterns', ...(textures ? forPictures(textures) : [])],
    send(input, given) {
      if (!isMesh(input)) {
        const options = optionsOf('pattern', given);
        return [handedOver(asSurface(input)), options];
      }
      const options = /** @type {import('./types.js').MeshPatternOptions} */ (optionsOf('patternMesh', given));
      const { shape, own: { uvs, textureOf, textures } } = wholeOf(input);
      return [options.printed ? { ...shape, uvs, textureOf, textures } : shape, options];
    },
  },
  dewarp: {
    parts: ['unroll'],
    send(input, photo, given) {
      const { transfer: handOver, ...options } = /** @type {import('./index.js').HandOver} */ (placedOptions('dewarp', input, given));
      return [handedOver(asField(input)), sentPhoto(photo, handOver), options];
    },
  },
  dewarpPage: {
    parts: (photo) => ['unroll', ...partsOfPhoto(photo)],
    async send(photo, second, third) {
      const [edges, given] = edgesAndOptions(second, third);
      const { transfer: handOver, ...options } = /** @type {import('./index.js').HandOver} */ (pageOptions(photo, given));
      const pages = edges === undefined ? undefined : plainEdges(asEdges(edges));
      return [sentPhoto(await photoOf(photo), handOver), pages, options];
    },
  },
  flattenPhoto: {
    parts: (photo) => ['unroll', ...partsOfPhoto(photo)],
    async send(photo, page, given) {
      const { transfer: handOver, ...options } = /** @type {import('./index.js').HandOver} */ (optionsOf('flattenPhoto', given));
      const found = asFoundPage(page);
      return [sentPhoto(await photoOf(photo), handOver), found, options];
    },
  },
  findPage: {
    parts: (photo) => ['unroll', ...partsOfPhoto(photo)],
    send: async (photo) => [sentPhoto(await photoOf(photo))],
  },
};

/**
 * The wasm files that it takes to read pictures, and to paint with them.
 * @param {readonly import('./types.js').Picture[]} pictures
 * @returns {PartName[]}
 */
export function forPictures(pictures) {
  const others = pictures.some((picture) => {
    const given = asPicture(picture);
    return given instanceof Uint8Array && isImagePhoto(given);
  });
  return ['files', ...(others ? [/** @type {const} */ ('images')] : [])];
}

/**
 * A copy of an input, or itself if that is wanted, whose buffers go to the worker.
 * @template {import('./input.js').Image | import('./input.js').Lattice} T
 * @param {T} input
 * @param {import('./index.js').HandOver} [options]
 */
export function handedOver(input, options) {
  const { field, buffers } = detached(/** @type {any} */ (input), options);
  return transfer(field, buffers);
}

/** What it takes to read a photo, if it is a file and no pixels. @param {unknown} photo @returns {readonly PartName[]} */
const partsOfPhoto = (photo) => (photo instanceof Uint8Array ? forPictures([photo]) : []);

/**
 * A photo on its way to the worker: itself, if it is to be handed over and that is possible, or a copy; of a file its bytes.
 * @param {import('./types.js').Photo | Uint8Array | ArrayBuffer} photo
 * @param {boolean} [handOver]
 */
function sentPhoto(photo, handOver = false) {
  const given = asPicture(photo);
  if (given instanceof Uint8Array) {
    const file = new Uint8Array(given);
    return transfer(file, [file.buffer]);
  }
  const { width, height, data } = given;
  const whole = data.buffer instanceof ArrayBuffer && data.byteLength === data.buffer.byteLength;
  const own = handOver && whole ? data : new Uint8Array(data);
  return transfer({ width, height, data: own }, [/** @type {ArrayBuffer} */ (own.buffer)]);
}

/** A copy of a file's bytes, whose buffer goes to the worker. @param {Uint8Array | ArrayBuffer | Blob} bytes */
async function fileOf(bytes) {
  const file = await copyOfFile(bytes);
  return transfer(file, [file.buffer]);
}
