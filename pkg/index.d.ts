/** The promise API: the solver runs in a module worker (in Node, a worker thread). */
import type {
  Example, ExampleName, ExampleOptions, Heightfield, HeightImage, InitInput, Progress,
  ReadOptions, ReadResult, SolverOptions, Surface,
} from './types.js';
export * from './types.js';

export interface WorkerOptions {
  /** Where the worker's script is; default: `worker.js` beside this module. */
  workerUrl?: string | URL;
  /** Where the solver's wasm is; default: beside the worker. */
  wasm?: InitInput;
  /** Where the wasm is that reads and writes files, loaded when it is needed; default: beside the worker. */
  filesWasm?: InitInput;
}

export interface FitOptions extends SolverOptions {
  /** Stops the work itself, not only the waiting: within about 50 ms. */
  signal?: AbortSignal;
  /** What an abort does: reject with the signal's reason (default), or resolve with the best surface so far. */
  onAbort?: 'reject' | 'keep';
  /** Called in the caller's thread, several times a second. */
  onProgress?: (progress: Progress) => void;
  /**
   * Hand the input's buffers over to the worker instead of copying them (the caller loses them).
   * Arrays that are only a part of their buffer are copied all the same.
   */
  transfer?: boolean;
}

/**
 * Starts the shared worker and loads the wasm; optional, idempotent, called by the functions below.
 * Options count where no shared worker runs yet; after a failure they can be given anew.
 */
export function init(options?: WorkerOptions | InitInput): Promise<void>;
export function fit(input: HeightImage | Heightfield, options?: FitOptions): Promise<Surface>;
export function read(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadOptions): Promise<ReadResult>;
export function writeNpy(input: HeightImage | Heightfield): Promise<Uint8Array<ArrayBuffer>>;
export function writePng(input: HeightImage): Promise<Uint8Array<ArrayBuffer>>;
export function writeObj(input: Heightfield): Promise<Uint8Array<ArrayBuffer>>;
export function example(name: ExampleName, options?: ExampleOptions): Promise<Example>;
/** Stops the shared worker, calls under way reject with code `DISPOSED`; a later call starts a new one. */
export function dispose(): void;

/**
 * A worker of one's own, with the same functions as methods.
 *
 * Several solves on one worker take turns on its one thread, about 25 ms each; to run them at the
 * same time, give each a worker of its own.
 */
export class DevelopableWorker {
  constructor(options?: WorkerOptions);
  init(): Promise<void>;
  fit(input: HeightImage | Heightfield, options?: FitOptions): Promise<Surface>;
  read(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadOptions): Promise<ReadResult>;
  writeNpy(input: HeightImage | Heightfield): Promise<Uint8Array<ArrayBuffer>>;
  writePng(input: HeightImage): Promise<Uint8Array<ArrayBuffer>>;
  writeObj(input: Heightfield): Promise<Uint8Array<ArrayBuffer>>;
  example(name: ExampleName, options?: ExampleOptions): Promise<Example>;
  /** Whether the worker runs. It starts with the first call, and anew with the first one after it crashed. */
  readonly connected: boolean;
  readonly disposed: boolean;
  /** Stops the worker; calls under way reject with code `DISPOSED`. Harmless when repeated. */
  dispose(): void;
  [Symbol.dispose](): void;
}
