/**
 * The synchronous API: runs where it is called. Meant for workers and Node; in a page it blocks.
 * @module developable/direct
 */
import type {
  CallProgress, HeightImage, Heightfield, ImageSurface, InitInput, LatticeSurface, Mesh, MeshSolverOptions, MeshSurface, Progress, SolverOptions, Surface,
} from './types.js';
export { parseCamera } from './camera-file.js';
export * from './direct-calls.js';
export * from './types.js';

/** Name of a part that is loaded when it is needed, each from a wasm file of its own. */
export type PartName = 'files' | 'images' | 'meshes' | 'fitmesh' | 'unroll' | 'patterns';

/**
 * Loads the solver's wasm once; later calls, with any argument, return the same promise. It may be repeated after a
 * failure.
 */
export function init(input?: InitInput): Promise<void>;

/**
 * Loads other parts once each: `load('files', 'meshes')`, or from another place, `load({ files: url })`.
 * - `files`: `read` and the `write…` functions for PNG, NPY, OBJ and MTL, photos in PNG and JPEG, `paint`, and `sampleMesh` of a
 *   mesh with textures;
 * - `images`: all other height images, and photos in WebP, GIF, BMP and TIFF;
 * - `meshes`: `readMesh`, `sampleMesh`, `backProject`, `writePly`, `writeStl`, `writeGlb`, and `paint` with a camera;
 * - `fitmesh`: `fitMesh`, `MeshSolver`, and of meshes `analyze` and `rulings`;
 * - `unroll`: `picture`, `draw` and `dewarp`, and of heights `analyze`, `patches`, `rulings` and `unroll`;
 * - `patterns`: `pattern`, `recognizeMesh`, `writeSvg`, `writePdf` and `writeDxf`, and of meshes `patches` and `unroll`.
 *
 * Where nothing can be awaited, `developable/sync` has `initSync` and `loadSync`.
 */
export function load(...parts: (PartName | Partial<Record<PartName, InitInput>>)[]): Promise<void>;

/** Options of writing a GLB file. */
export interface WriteGlbOptions {
  /**
   * PNG or JPEG file that the texture coordinates are about. It is embedded as it is, and replaces colours. Default: the texture
   * of the mesh or surface; `null` for none.
   */
  texture?: Uint8Array | ArrayBuffer | null;
}

/** Fit of a whole mesh that runs in steps. Dispose of it (or use `using`) to free its memory. */
export class MeshSolver {
  /** Prepares the fit of a mesh. */
  constructor(mesh: Mesh, options?: MeshSolverOptions);
  /** Runs for about `milliseconds`, at least one step; returns whether there is more to do. */
  advance(milliseconds: number): boolean;
  /**
   * Returns the progress of the fit, which solves several problems in turn: `objective`, `dualBound`, `gap` and `rho` are those of the
   * current one, iterations count over all of them, and `level` is the number of problems still to come at most.
   */
  progress(): Progress;
  /** Stops the fit; `surface()` then returns the best surface of the pass under way, with the stop reason `'cancelled'`. */
  cancel(): void;
  /**
   * Returns the mesh after the last finished pass, or as it was when the fit was cancelled, as a copy. Before the first pass has ended it
   * is the input.
   */
  surface(): MeshSurface;
  /** Whether the solver was disposed of, after which its methods throw. */
  readonly disposed: boolean;
  /** Frees the memory in the wasm. It may be repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/** Fit of heights that runs in steps. Dispose of it (or use `using`) to free its memory. */
export class Solver {
  /** Prepares the fit of an input. */
  constructor(input: HeightImage | Heightfield, options?: SolverOptions);
  /**
   * Restarts with other options on the same input, warm-started from the current surface, which takes less time if they differ
   * little. Options that are left out have their defaults. Another `spacing` is a cold start. If this throws, nothing has changed.
   */
  restart(options?: SolverOptions): void;
  /** Restarts with another input, warm-started from the current surface if the lattices have the same shape. */
  restartWith(input: HeightImage | Heightfield, options?: SolverOptions): void;
  /** Runs for about `milliseconds`, at least one step; returns whether there is more to do. */
  advance(milliseconds: number): boolean;
  /** Returns the figures of the last check. */
  progress(): Progress;
  /** Stops the fit; `surface()` then returns the best surface of the pass under way, with the stop reason `'cancelled'`. */
  cancel(): void;
  /** Returns the best surface so far, as a copy. It may be called at any time. */
  surface(): Surface;
  /** Whether the solver was disposed of, after which its methods throw. */
  readonly disposed: boolean;
  /** Frees the memory in the wasm. It may be repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}

/** Option of the calls that take longest. */
export interface Watched {
  /** Function that is called several times a second; it must not be async. If it throws, so does the call, when its work has ended. */
  onProgress?: (progress: CallProgress) => void;
}

/** Options of a fit that runs where it is called. */
export interface DirectFitOptions extends SolverOptions {
  /**
   * Function that is called several times a second; it must not be async. If it returns false the fit stops with the best
   * surface so far.
   */
  onProgress?: (progress: Progress) => boolean | void;
}

/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: HeightImage, options?: DirectFitOptions): ImageSurface;
/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: Heightfield, options?: DirectFitOptions): LatticeSurface;
/**
 * Fits a piecewise developable surface to heights: smooth pieces that could be laid flat as paper can, without stretching, which meet at
 * creases. `report.gap` is a proven bound: the objective is above its minimum by at most this share of itself.
 */
export function fit(input: HeightImage | Heightfield, options?: DirectFitOptions): Surface;
/**
 * Fits a piecewise developable surface to a whole mesh, by moving its vertices: no view is needed, and the mesh may be
 * closed, overhanging, open or in several parts. It must be a surface; otherwise the code is `TOPOLOGY` and the message
 * says where. `confidence` of the mesh weighs how closely each vertex is followed. `onProgress` may return false to
 * stop with the best surface so far.
 */
export function fitMesh(
  mesh: Mesh,
  options?: MeshSolverOptions & { onProgress?: (progress: Progress) => boolean | void },
): MeshSurface;
