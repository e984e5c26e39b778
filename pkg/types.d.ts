/** What the direct and the worker API share: inputs, options, results. */
export { DevelopableError, type ErrorCode } from './errors.js';

/** Any flat numeric array; values are converted to 64-bit floats. */
export type Numbers =
  | Float64Array | Float32Array
  | Int8Array | Int16Array | Int32Array
  | Uint8Array | Uint8ClampedArray | Uint16Array | Uint32Array
  | readonly number[];

/** Heights at the centres of square pixels, row by row, top row first. */
export interface HeightImage {
  width: number;
  height: number;
  /** `width * height` values. NaN is no data. */
  data: Numbers;
  /** One value for each pixel; 0 takes the pixel out. */
  mask?: Uint8Array;
  /** A value that means "no data" (besides NaN). */
  noData?: number;
  /** Side length of a pixel, in the unit of the result. Default 1. */
  pixelSize?: number;
  /** Height of one step of `data`, in the same unit. Default 1. */
  heightScale?: number;
}

/** Heights at the vertices of a hexagonal lattice: row 0 at the top, odd rows half a spacing to the left. */
export interface Heightfield {
  rows: number;
  cols: number;
  /** Distance between neighbours, in the unit of the heights. */
  spacing: number;
  /** `rows * cols` heights, row by row. NaN is no data. */
  heights: Numbers;
  /** Position `[x, y]` of vertex (0, 0), `y` up. Default `[0, 0]`. */
  origin?: readonly [number, number];
  /** One value for each vertex; 0 takes the vertex out. */
  mask?: Uint8Array;
  /** A value that means "no data" (besides NaN). */
  noData?: number;
}

export interface SolverOptions {
  /**
   * Weight of the fidelity term, for coordinates normalised to the unit square:
   * `'small'` 1e5 (heavy noise, few large patches), `'medium'` 1e6, `'big'` 1e7
   * (nearly developable input), or a number from 1e-12 to 1e15. Default `'medium'`.
   */
  lambda?: number | 'small' | 'medium' | 'big';
  /** `'default'` stops on the certified gap; `'paper'` follows Sec. 4.1 and stops on residuals. */
  schedule?: 'default' | 'paper';
  /** Certified relative duality gap to stop at, between 0 and 1 (exclusive). Default 0.01. */
  gap?: number;
  /** Most ADMM iterations. Default 20000. */
  maxIterations?: number;
  /** Scale x, y and z by one factor to the unit square before solving (and back after). Default true. */
  normalize?: boolean;
  /** Lattice spacing for an image input, in units of length. Default: its pixel size. */
  spacing?: number;
}

export type StopReason = 'gap' | 'residuals' | 'rounding' | 'maxIterations' | 'cancelled';

export interface Progress {
  /** How many finer lattices are still to come; 0 on the finest, whose figures alone are certified. */
  level: number;
  /** ADMM iterations so far. */
  iteration: number;
  /** Conjugate-gradient iterations so far, over all z-steps. */
  cgIterations: number;
  /** Objective of the best iterate so far; that of the input before the first check. */
  objective: number;
  /** Best certified lower bound of the optimum so far. */
  dualBound: number;
  /** `(objective - dualBound) / objective`. */
  gap: number;
  /** ADMM penalty. */
  rho: number;
  /** Seconds since the solver was made. */
  elapsed: number;
}

/** The work on one lattice of the coarse-to-fine sequence. */
export interface LevelReport {
  /** Lattice spacing in normalised coordinates. */
  spacing: number;
  /** Interior vertices. */
  interior: number;
  iterations: number;
  cgIterations: number;
}

export interface Report {
  /** Vertices where the Hessian is evaluated. */
  interior: number;
  /** Valid vertices touched by a stencil without being interior. */
  boundary: number;
  /** Valid vertices that no stencil touches: left out of the solve, restored afterwards. */
  omitted: number;
  /** ADMM iterations. */
  iterations: number;
  /** Conjugate-gradient iterations over all z-steps. */
  cgIterations: number;
  /** The lattices that were worked on, the coarsest first. */
  levels: LevelReport[];
  /** Value of the energy at the returned surface, in normalised coordinates. */
  objective: number;
  /** `lambda * sum (z - input)^2`. */
  fidelity: number;
  /** `sum of nuclear norms of the Hessians`. */
  nuclearNorm: number;
  /** Certified lower bound of the optimum. */
  dualBound: number;
  /** `(objective - dualBound) / objective`: how far from the optimum the result can be at most; 0 for `'rounding'`. */
  gap: number;
  /** Lambda that was used, as a number. */
  lambda: number;
  /** Last ADMM penalty. */
  rho: number;
  /** Factor from the input's units to normalised coordinates. */
  scale: number;
  stopReason: StopReason;
  seconds: { setup: number; zStep: number; hStep: number; certificate: number; total: number };
}

/** The solved surface. Every array is a copy that belongs to the caller. */
export interface Surface {
  rows: number;
  cols: number;
  spacing: number;
  origin: [number, number];
  /** Heights on the lattice, row by row; NaN where the input had no data. */
  heights: Float64Array;
  /** For an image input: the surface at the input's pixels, NaN where the input had no data. */
  image?: { width: number; height: number; pixelSize: number; data: Float64Array };
  report: Report;
}

export type ExampleName = 'cylinder' | 'cone' | 'roof' | 'oloid' | 'page';

export interface ExampleOptions {
  /** Pixels along the longer side. Default 200. */
  size?: number;
  /** Standard deviation of the noise, as a share of the example's height range. Default 0.02. */
  noise?: number;
  /** Seed of the noise: an integer from 0 to 2^32 - 1. Default 1. */
  seed?: number;
}

export interface Example {
  /** The noisy height image. */
  input: HeightImage & { data: Float64Array };
  /** The surface without noise, at the same pixels. */
  truth: Float64Array;
}

export interface ReadOptions {
  /** Taken from the bytes where it is not given. */
  format?: 'png' | 'npy';
}

/** A decoded file. For a PNG without a recorded scale `heightScale` is a suggestion (see README). */
export interface ReadResult {
  format: 'png' | 'npy';
  width: number;
  height: number;
  /**
   * Values as stored (grey levels, numbers), plus `offset / heightScale` where the file records an
   * offset, row by row; NaN where an alpha channel is 0 or the value is NaN.
   */
  data: Float64Array;
  pixelSize: number;
  heightScale: number;
  /** The type the file stores: `'u8'`, `'u16'`, `'f32'`, `'f64'`, ... */
  dataType: string;
}

/** Where the solver's wasm comes from; nothing means the file beside the package's own modules. */
export type InitInput =
  | string | URL | Response | ArrayBuffer | ArrayBufferView | WebAssembly.Module
  | Promise<Response | ArrayBuffer | ArrayBufferView | WebAssembly.Module>;
