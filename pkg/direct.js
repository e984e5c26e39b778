/** The synchronous API: runs where it is called. Documented in `direct.d.ts`. */
import { asDepthOptions } from './depth-input.js';
import { isBasic, isImage } from './formats.js';
import { asBytes, asField, asHeights, asImage, asInput, asPixels, carriedOf } from './input.js';
import { files, images, meshFits, meshes, partOf, patterns, solver, surfaces } from './instances.js';
import { asFiles, asMesh, asMeshOrLattice, asPicture, isMesh, wholeOf } from './mesh-input.js';
import { optionsOf } from './options.js';
import { asEdges, asFoundPage, edgesAndOptions, pageOptions } from './page-input.js';
import { inColour, jpegsOf, paintOf, readPhoto } from './paint.js';
import { asSurface, ofPlainCalls } from './plain-calls.js';
import { makeDisposable } from './platform.js';
import { PROGRESS_INTERVAL, answerOf } from './progress.js';
import { Steps } from './steps.js';
import { asBook, asPhoto, placeOf, placedOptions, printOptions } from './sheet-input.js';
import { isRecord, reading, record, show } from './values.js';

export { parseCamera } from './camera-file.js';
export { DevelopableError } from './errors.js';
export { describePage } from './page-words.js';
export { readPhoto };

/** @typedef {import('./progress.js').OnProgress} OnProgress */

/** @type {typeof import('./direct.js').init} */
export const init = (input) => solver.init(input);

/** @type {typeof import('./direct.js').load} */
export async function load(...parts) {
  const places = reading('OPTION', 'the parts to load', () =>
    parts.flatMap((part) => Object.entries(isRecord(part) ? part : { [typeof part === 'string' ? part : show(part)]: undefined })));
  const wanted = places.map(([name, place]) => ({ part: partOf(name), place }));
  await Promise.all(wanted.map(({ part, place }) => part.init(place)));
}

export const {
  example, formatOf, npzArrays, writeObj, writeMtl, writePly, writeStl, patches, rulings, unroll, picture, recognizeMesh, writeSvg, writePdf, writeDxf,
} = /** @type {Pick<typeof import('./direct.js'), import('./plain-calls.js').PlainCallName>} */ (ofPlainCalls((name, part, check) => {
  const call = (/** @type {any} */ input, /** @type {object | undefined} */ given) => {
    const [taken, { onProgress, ...options } = {}] = check(input, given);
    const file = part(taken);
    return (file === 'solver' ? /** @type {import('./instance.js').Instance<any>} */ (solver) : partOf(file)).watched((wasm) => wasm[name](taken, options), onProgress);
  };
  return Object.defineProperty(call, 'name', { value: name });
}));

/** @typedef {import('./direct.js').Solver} SolverApi */

/**
 * @extends {Steps<import('./wasm/solver.js').Solver>}
 * @implements {Omit<SolverApi, typeof Symbol.dispose>}
 */
export class Solver extends Steps {
  /** What the surface has from the input. */
  #carried;

  /**
   * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
   * @param {import('./types.js').SolverOptions} [given]
   */
  constructor(input, given) {
    const field = asInput(input);
    const options = optionsOf('solver', given);
    super(solver, solver.call((wasm) => new wasm.Solver(field, options)));
    this.#carried = carriedOf(field);
  }

  /** @param {import('./types.js').SolverOptions} [given] */
  restart(given) {
    const handle = this.live();
    const options = optionsOf('solver', given);
    solver.call(() => handle.restart(options));
    this.restarted();
  }

  /**
   * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
   * @param {import('./types.js').SolverOptions} [given]
   */
  restartWith(input, given) {
    const handle = this.live();
    const field = asInput(input);
    const options = optionsOf('solver', given);
    solver.call(() => handle.restartWith(field, options));
    this.#carried = carriedOf(field);
    this.restarted();
  }

  surface() {
    const handle = this.live();
    return { ...solver.call(() => handle.surface()), ...this.#carried };
  }
}
makeDisposable(Solver);

/**
 * @extends {Steps<import('./wasm/fitmesh.js').MeshSolver>}
 * @implements {Omit<import('./direct.js').MeshSolver, typeof Symbol.dispose>}
 */
export class MeshSolver extends Steps {
  /** What the surface has from the input. */
  #own;

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./types.js').MeshSolverOptions} [given]
   */
  constructor(mesh, given) {
    const { shape, own } = wholeOf(mesh);
    const options = optionsOf('meshSolver', given);
    super(meshFits, meshFits.call((wasm) => wasm.MeshSolver.onMesh(shape, options)));
    this.#own = own;
  }

  surface() {
    const handle = this.live();
    return { ...this.#own, ...meshFits.call(() => handle.surface()) };
  }
}
makeDisposable(MeshSolver);

/** @type {typeof import('./direct.js').fit} */
export const fit = (input, options) => /** @type {any} */ (solved(input, options));

/**
 * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
 * @param {import('./direct.js').DirectFitOptions} [given]
 */
function solved(input, given) {
  const { onProgress, ...options } = optionsOf('directFit', given);
  return run(new Solver(input, options), onProgress);
}

/** @type {typeof import('./direct.js').fitMesh} */
export function fitMesh(mesh, given) {
  const { onProgress, ...options } = optionsOf('directFitMesh', given);
  return run(/** @type {import('./direct.js').MeshSolver} */ (/** @type {unknown} */ (new MeshSolver(mesh, options))), onProgress);
}

/**
 * @template S
 * @param {{ advance(ms: number): boolean, progress(): import('./types.js').Progress, cancel(): void, surface(): S, dispose(): void }} solve
 * @param {(progress: import('./types.js').Progress) => boolean | void} [onProgress]
 */
function run(solve, onProgress) {
  try {
    while (solve.advance(PROGRESS_INTERVAL)) {
      if (answerOf(onProgress, solve.progress()) === false) solve.cancel();
    }
    answerOf(onProgress, solve.progress());
    return solve.surface();
  } finally {
    solve.dispose();
  }
}

/** @type {typeof import('./direct.js').occlusions} */
export function occlusions(input, given) {
  const field = asField(input);
  const { threshold: occlusionThreshold, ...rest } = optionsOf('occlusions', given);
  const options = { ...rest, occlusionThreshold };
  return solver.call((wasm) => wasm.occlusions(field, options));
}

/** @type {typeof import('./direct.js').read} */
export function read(bytes, given) {
  const file = asBytes(bytes);
  const options = optionsOf('read', given);
  return isImage(file, options)
    ? images.call((wasm) => wasm.readImage(file, options))
    : files.call((wasm) => wasm.read(file, options));
}

/** @type {typeof import('./direct.js').writeImage} */
export function writeImage(input, given) {
  const { format = 'npy' } = optionsOf('writeImage', given);
  const image = asPixels(input, format);
  const part = isBasic(format) ? files : images;
  return unshared(part.call((wasm) => wasm.writeImage(image, format)));
}

/** @type {typeof import('./direct.js').writeGlb} */
export function writeGlb(input, given) {
  const lattice = asMeshOrLattice(input);
  const [picture] = lattice.textures ?? [];
  const own = picture instanceof Uint8Array ? picture : undefined;
  const { texture = lattice.texture ?? own, ...rest } = optionsOf('writeGlb', given);
  const options = { ...rest, texture: texture === null || texture === undefined ? undefined : asBytes(texture) };
  return unshared(meshes.call((wasm) => wasm.writeGlb(lattice, options)));
}

/** @type {typeof import('./direct.js').readMesh} */
export function readMesh(bytes, given) {
  const file = asBytes(bytes);
  const { files: beside, ...options } = optionsOf('readMesh', given);
  const pairs = asFiles(beside);
  return meshes.call((wasm) => wasm.readMesh(file, pairs, options));
}

/** @type {typeof import('./direct.js').sampleMesh} */
export function sampleMesh(mesh, given) {
  const { textures, camera, unit, ...bare } = asMesh(mesh);
  const options = optionsOf('sampleMesh', given);
  const { textureOf, ...seen } = meshes.call((wasm) => wasm.sampleMesh(bare, options));
  return inColour({ ...seen, ...(camera && { camera }), ...(unit && { unit }) }, textureOf, textures);
}

/** @type {typeof import('./direct.js').paint} */
export function paint(input, picture, options) {
  // A long text would become as many properties.
  const own = reading('INPUT', 'the input', () => /** @type {typeof input} */ (isRecord(input) ? { ...input } : {}));
  return { ...own, ...paintOf(own, picture, options) };
}

/** @type {typeof import('./direct.js').backProject} */
export function backProject(input, intrinsics, known) {
  const image = asImage(input);
  const { unit, ...camera } = /** @type {import('./types.js').Intrinsics} */ (optionsOf('camera', intrinsics));
  const options = asDepthOptions(known);
  const { mesh, camera: seen } = meshes.call((wasm) => wasm.backProject(image, camera, options));
  // A photo of another size has other numbers, and so has one that is turned.
  const { width, height } = image;
  const own = options.turn ? { ...camera, ...seen } : { width, height, ...camera };
  return { ...mesh, camera: own, ...(unit && { unit }) };
}

/** @param {any} input @param {any} [given] @returns {any} */
export function analyze(input, given) {
  const field = asSurface(input);
  if (isMesh(input)) {
    const options = optionsOf('analyzeMesh', given);
    return meshFits.call((wasm) => wasm.analyze(field, options));
  }
  const { reference, ...options } = /** @type {import('./types.js').AnalyzeOptions} */ (optionsOf('analyze', given));
  const other = reference === undefined ? undefined : asField(reference);
  return surfaces.call((wasm) => wasm.analyze(field, other, options));
}

/** @type {typeof import('./direct.js').draw} */
export function draw(canvas, input, given) {
  const options = placedOptions('picture', input, given);
  const field = asField(input);
  surfaces.call((wasm) => wasm.draw(canvas, field, options));
}

/** @type {typeof import('./direct.js').fitCylinder} */
export function fitCylinder(input) {
  const field = asHeights(input);
  return { ...solver.call((wasm) => wasm.fitCylinder(field)), ...carriedOf(field) };
}

/** @type {typeof import('./direct.js').pattern} */
export function pattern(/** @type {any} */ input, /** @type {any} */ given) {
  if (!isMesh(input)) {
    const { onProgress, ...options } = /** @type {import('./types.js').PatternOptions & { onProgress?: OnProgress }} */ (optionsOf('pattern', given));
    const field = asSurface(input);
    return patterns.watched((wasm) => wasm.pattern(field, options), onProgress);
  }
  const { shape, own: { uvs, textureOf, textures } } = wholeOf(input);
  const { onProgress, ...options } = /** @type {import('./types.js').MeshPatternOptions & { onProgress?: OnProgress }} */ (optionsOf('patternMesh', given));
  const files = options.printed ? jpegsOf(textures) : undefined;
  const drawing = patterns.watched((wasm) => wasm.patternMesh(files ? { ...shape, uvs, textureOf } : shape, options), onProgress);
  return { ...drawing, ...(files && { textures: files }) };
}

/**
 * Here there is nobody to hand anything over to.
 * @template T
 * @typedef {NonNullable<T> & { transfer?: boolean }} Handed
 */

/** @type {typeof import('./direct.js').dewarp} */
export function dewarp(input, photo, given) {
  const { transfer, ...options } = /** @type {Handed<typeof given>} */ (placedOptions('dewarp', input, given));
  const [field, pixels] = [asField(input), asPhoto(photo)];
  const placed = { ...options, ...placeOf(field, options) };
  const { unit } = carriedOf(field);
  return { ...surfaces.call((wasm) => wasm.dewarp(field, pixels, placed)), ...(unit && { unit }) };
}

/**
 * The pixels of a photo, which may be a file.
 * @param {unknown} photo
 * @returns {import('./sheet-input.js').Pixels & { film35?: number }}
 */
function photoPixels(photo) {
  const given = asPicture(photo);
  const { film35 } = record('INPUT', 'the photo', photo, ['film35']);
  if (!(given instanceof Uint8Array)) return { ...given, ...(typeof film35 === 'number' && { film35 }) };
  const { data, ...read } = readPhoto(given);
  return { ...read, data: new Uint8Array(data.buffer, data.byteOffset, data.byteLength) };
}

/** Fraction of the work on a photo that is done when its page is found. */
const FOUND_FRACTION = 0.8;

/** @param {any} photo @param {any} [second] @param {any} [third] @returns {any} */
export function dewarpPage(photo, second, third) {
  const [edges, given] = edgesAndOptions(second, third);
  const pages = edges === undefined ? undefined : asEdges(edges);
  const { film35, ...pixels } = photoPixels(photo);
  const { transfer, ...options } = /** @type {Handed<ReturnType<typeof pageOptions>> & { onProgress?: OnProgress }} */ (pageOptions({ film35 }, given));
  const { onProgress, dots, map, grid, light, ink, ...known } = options;
  const page = surfaces.watched((wasm) => wasm.pageSurface(pixels, pages, known), onProgress, [0, FOUND_FRACTION]);
  const flatten = optionsOf('flattenPhoto', { dots, map, grid, light, ink });
  const image = surfaces.watched((wasm) => wasm.flattenPhoto(pixels, page, flatten), onProgress, [FOUND_FRACTION, 1]);
  return { ...page, ...image };
}

/** @type {typeof import('./direct.js').flattenPhoto} */
export function flattenPhoto(photo, page, given) {
  const { transfer, ...options } = /** @type {Handed<typeof given>} */ (optionsOf('flattenPhoto', given));
  const { size, unit, warp } = asFoundPage(page);
  const pixels = photoPixels(photo);
  const image = surfaces.call((wasm) => wasm.flattenPhoto(pixels, { size, unit, warp }, options));
  return { ...image, size, unit };
}

/** @type {typeof import('./direct.js').findPage} */
export function findPage(photo) {
  const pixels = photoPixels(photo);
  return surfaces.call((wasm) => wasm.findPage(pixels));
}

/** @type {typeof import('./direct.js').writePhoto} */
export function writePhoto(photo, given) {
  const { width, height, data } = asPhoto(photo);
  const { transfer, ...options } = printOptions(photo, given);
  return unshared(files.call((wasm) => wasm.writePhoto(width, height, data, options)));
}

/** @type {typeof import('./direct.js').writeBook} */
export function writeBook(pages, given) {
  const book = asBook(pages).map(({ words, ...page }) => (
    { ...page, texts: words.map(({ text }) => text), boxes: Float64Array.from(words.flatMap(({ box }) => box)) }));
  const options = optionsOf('writeBook', given);
  return unshared(files.call((wasm) => wasm.writeBook(book, options)));
}

/**
 * A file, in memory that is not shared: only the type needs to be told.
 * @param {Uint8Array} file
 */
function unshared(file) {
  return /** @type {Uint8Array<ArrayBuffer>} */ (file);
}
