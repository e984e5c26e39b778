/** The synchronous API: runs where it is called. Documented in `direct.d.ts`. */
import { asOptions } from './control.js';
import { DevelopableError } from './errors.js';
import { isImage } from './formats.js';
import { asBytes, asField, asImage, asInput, asLattice, carriedOf } from './input.js';
import { files, images, meshes, patterns, sheets, solver } from './instances.js';
import { asFiles, asMesh } from './mesh-input.js';
import { inColour, paintOf, readPhoto } from './paint.js';
import { makeDisposable } from './platform.js';
import { asPhoto, dewarpOptions } from './sheet-input.js';

export { DevelopableError } from './errors.js';
export { readPhoto };

/** @type {typeof import('./direct.js').init} */
export const init = (input) => solver.init(input);
/** @type {typeof import('./direct.js').initSync} */
export const initSync = (input) => solver.initSync(input);
/** @type {typeof import('./direct.js').initFiles} */
export const initFiles = (input) => files.init(input);
/** @type {typeof import('./direct.js').initFilesSync} */
export const initFilesSync = (input) => files.initSync(input);
/** @type {typeof import('./direct.js').initImages} */
export const initImages = (input) => images.init(input);
/** @type {typeof import('./direct.js').initImagesSync} */
export const initImagesSync = (input) => images.initSync(input);
/** @type {typeof import('./direct.js').initMeshes} */
export const initMeshes = (input) => meshes.init(input);
/** @type {typeof import('./direct.js').initMeshesSync} */
export const initMeshesSync = (input) => meshes.initSync(input);

/** @type {typeof import('./direct.js').initUnroll} */
export const initUnroll = (input) => sheets.init(input);
/** @type {typeof import('./direct.js').initUnrollSync} */
export const initUnrollSync = (input) => sheets.initSync(input);

/** @type {typeof import('./direct.js').initPatterns} */
export const initPatterns = (input) => patterns.init(input);
/** @type {typeof import('./direct.js').initPatternsSync} */
export const initPatternsSync = (input) => patterns.initSync(input);

/**
 * @typedef {import('./direct.js').Solver} SolverApi
 * @typedef {import('./wasm/solver.js').Solver} Handle
 */

/**
 * Milliseconds of work to ask the wasm for at once. Little, because iterations suddenly cost
 * several times as much when the solver goes on to a finer lattice.
 */
const SLICE = 4;

/** Milliseconds between two calls of `fit`'s `onProgress`. */
const PROGRESS_INTERVAL = 60;

/** @implements {Omit<SolverApi, typeof Symbol.dispose>} */
export class Solver {
  /** @type {Handle | undefined} */
  #handle;
  /** Conjugate-gradient iterations to ask for in one call, from how long the last ones took. */
  #work = 1;
  /** What the surface has from the input. */
  #carried;

  /**
   * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
   * @param {import('./types.js').SolverOptions} [options]
   */
  constructor(input, options) {
    const field = asInput(input);
    this.#carried = carriedOf(field);
    this.#handle = solver.call(({ Solver: { onImage, onLattice } }) =>
      field.kind === 'image' ? onImage(field, options) : onLattice(field, options),
    );
  }

  /** @param {import('./types.js').SolverOptions} [options] */
  restart(options) {
    const handle = this.#live();
    solver.call(() => handle.restart(options));
    this.#work = 1;
  }

  /**
   * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
   * @param {import('./types.js').SolverOptions} [options]
   */
  restartWith(input, options) {
    const handle = this.#live();
    const field = asInput(input);
    solver.call(() =>
      field.kind === 'image' ? handle.restartWithImage(field, options) : handle.restartWithLattice(field, options),
    );
    this.#carried = carriedOf(field);
    this.#work = 1;
  }

  /** @param {number} milliseconds */
  advance(milliseconds) {
    const handle = this.#live();
    const end = performance.now() + milliseconds;
    for (;;) {
      const start = performance.now();
      if (!solver.call(() => handle.advance(this.#work))) return false;
      const now = performance.now();
      // Clocks are coarse, so at most twice as much as before.
      const each = (now - start) / this.#work;
      this.#work = Math.max(1, Math.floor(Math.min(2 * this.#work, SLICE / each)));
      // Rather half a slice too early than half of one too late.
      if (now + (each * this.#work) / 2 >= end) return true;
    }
  }

  progress() {
    const handle = this.#live();
    return solver.call(() => handle.progress());
  }

  cancel() {
    const handle = this.#live();
    solver.call(() => handle.cancel());
  }

  surface() {
    const handle = this.#live();
    return { ...solver.call(() => handle.surface()), ...this.#carried };
  }

  get disposed() {
    return this.#handle === undefined;
  }

  dispose() {
    const handle = this.#handle;
    this.#handle = undefined;
    // After a trap there is nothing left that could be freed in an orderly way.
    if (solver.alive) handle?.free();
  }

  #live() {
    if (this.#handle === undefined) {
      throw new DevelopableError('DISPOSED', 'this solver has been disposed');
    }
    return this.#handle;
  }
}
makeDisposable(Solver);

/** @type {typeof import('./direct.js').fit} */
export function fit(input, given) {
  const { onProgress, ...options } = asOptions(given);
  const solve = new Solver(input, options);
  try {
    while (solve.advance(PROGRESS_INTERVAL)) {
      if (onProgress?.(solve.progress()) === false) solve.cancel();
    }
    onProgress?.(solve.progress());
    return solve.surface();
  } finally {
    solve.dispose();
  }
}

/** @type {typeof import('./direct.js').occlusions} */
export function occlusions(input, options) {
  const field = asField(input);
  return solver.call((wasm) =>
    field.kind === 'image' ? wasm.occlusionsOfImage(field, options) : wasm.occlusionsOfLattice(field, options),
  );
}

/** @type {typeof import('./direct.js').read} */
export function read(bytes, options) {
  const file = asBytes(bytes);
  return isImage(file, options)
    ? images.call((wasm) => wasm.readImage(file, options))
    : files.call((wasm) => wasm.read(file, options));
}

/** @type {typeof import('./direct.js').npzArrays} */
export function npzArrays(bytes) {
  const file = asBytes(bytes);
  return images.call((wasm) => wasm.npzArrays(file));
}

/** @type {typeof import('./direct.js').writeNpy} */
export function writeNpy(input) {
  const field = asField(input);
  return bytesOf((wasm) => (field.kind === 'image' ? wasm.writeImageNpy(field) : wasm.writeLatticeNpy(field)));
}

/** @type {typeof import('./direct.js').writePng} */
export function writePng(input) {
  const image = asImage(input);
  return bytesOf((wasm) => wasm.writePng(image));
}

/** @type {typeof import('./direct.js').writeTiff} */
export function writeTiff(input) {
  const image = asImage(input);
  return unshared(images.call((wasm) => wasm.writeTiff(image)));
}

/** @type {typeof import('./direct.js').writeExr} */
export function writeExr(input) {
  const image = asImage(input);
  return unshared(images.call((wasm) => wasm.writeExr(image)));
}

/** @type {typeof import('./direct.js').writeObj} */
export function writeObj(input, options) {
  const lattice = asLattice(input);
  return bytesOf((wasm) => wasm.writeObj(lattice, options));
}

/** @type {typeof import('./direct.js').writeMtl} */
export function writeMtl(picture) {
  return bytesOf((wasm) => wasm.writeMtl(String(picture)));
}

/** @type {typeof import('./direct.js').writePly} */
export function writePly(input) {
  const lattice = asLattice(input);
  return unshared(meshes.call((wasm) => wasm.writePly(lattice)));
}

/** @type {typeof import('./direct.js').writeStl} */
export function writeStl(input) {
  const lattice = asLattice(input);
  return unshared(meshes.call((wasm) => wasm.writeStl(lattice)));
}

/** @type {typeof import('./direct.js').writeGlb} */
export function writeGlb(input, given) {
  const lattice = asLattice(input);
  const { texture = lattice.texture, ...rest } = asOptions(given);
  const options = { ...rest, texture: texture === null || texture === undefined ? undefined : asBytes(texture) };
  return unshared(meshes.call((wasm) => wasm.writeGlb(lattice, options)));
}

/** @type {typeof import('./direct.js').readMesh} */
export function readMesh(bytes, given) {
  const file = asBytes(bytes);
  const { files: beside, ...options } = asOptions(given);
  const pairs = asFiles(beside);
  return meshes.call((wasm) => wasm.readMesh(file, pairs, options));
}

/** @type {typeof import('./direct.js').sampleMesh} */
export function sampleMesh(mesh, options) {
  const { textures, ...given } = asMesh(mesh);
  const { textureOf, ...seen } = meshes.call((wasm) => wasm.sampleMesh(given, options));
  return inColour(seen, textureOf, textures);
}

/** @type {typeof import('./direct.js').paint} */
export function paint(input, picture, options) {
  return { ...input, ...paintOf(input, picture, options) };
}

/** @type {typeof import('./direct.js').backProject} */
export function backProject(input, camera) {
  const image = asImage(input);
  return meshes.call((wasm) => wasm.backProject(image, camera));
}

/** @type {typeof import('./direct.js').analyze} */
export function analyze(input, given) {
  const field = asField(input);
  const { reference, ...options } = asOptions(given);
  const other = reference === undefined ? undefined : asField(reference);
  return sheets.call((wasm) => wasm.analyze(field, other, options));
}

/** @type {typeof import('./direct.js').patches} */
export function patches(input, options) {
  const field = asField(input);
  return sheets.call((wasm) => wasm.patches(field, options));
}

/** @type {typeof import('./direct.js').rulings} */
export function rulings(input, options) {
  const field = asField(input);
  return sheets.call((wasm) => wasm.rulings(field, options));
}

/** @type {typeof import('./direct.js').unroll} */
export function unroll(input, options) {
  const field = asField(input);
  return sheets.call((wasm) => wasm.unroll(field, options));
}

/** @type {typeof import('./direct.js').pattern} */
export function pattern(input, options) {
  const field = asField(input);
  return patterns.call((wasm) => wasm.pattern(field, options));
}

/** @type {typeof import('./direct.js').writeSvg} */
export function writeSvg(drawing) {
  return unshared(patterns.call((wasm) => wasm.writeSvg(drawing)));
}

/** @type {typeof import('./direct.js').writePdf} */
export function writePdf(drawing, options) {
  return unshared(patterns.call((wasm) => wasm.writePdf(drawing, options)));
}

/** @type {typeof import('./direct.js').writeDxf} */
export function writeDxf(drawing) {
  return unshared(patterns.call((wasm) => wasm.writeDxf(drawing)));
}

/** @type {typeof import('./direct.js').dewarp} */
export function dewarp(input, photo, given) {
  const options = dewarpOptions(input, given);
  const [field, pixels] = [asField(input), asPhoto(photo)];
  return sheets.call((wasm) => wasm.dewarp(field, pixels, options));
}

/** @type {typeof import('./direct.js').writePhoto} */
export function writePhoto(photo) {
  const { width, height, data } = asPhoto(photo);
  return bytesOf((wasm) => wasm.writePhoto(width, height, data));
}

/** @type {typeof import('./direct.js').example} */
export function example(name, options) {
  return solver.call((wasm) => wasm.example(name, options));
}

/** @param {(wasm: typeof import('./wasm/files.js')) => Uint8Array} write */
function bytesOf(write) {
  return unshared(files.call(write));
}

/**
 * A file, in memory that is not shared: only the type needs to be told.
 * @param {Uint8Array} file
 */
function unshared(file) {
  return /** @type {Uint8Array<ArrayBuffer>} */ (file);
}
