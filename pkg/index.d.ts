/** The promise API: the solver runs in a module worker (in Node, a worker thread). */
import type {
  Example, ExampleName, ExampleOptions, Heightfield, HeightImage, InitInput, Progress,
  ReadOptions, ReadResult, SolverOptions, Surface,
} from './types.js';
export * from './types.js';

export interface WorkerOptions {
  /** Where the worker's script is; default: `worker.js` beside this module. */
  workerUrl?: string | URL;
  /** Where the wasm is; default: beside the worker. */
  wasm?: InitInput;
}

export interface FitOptions extends SolverOptions {
  /** Stops the work itself, not only the waiting. */
  signal?: AbortSignal;
  /** What an abort does: reject with the signal's reason (default), or resolve with the best surface so far. */
  onAbort?: 'reject' | 'keep';
  /** Called in the caller's thread, several times a second. */
  onProgress?: (progress: Progress) => void;
  /** Hand the input's buffers over to the worker instead of copying them (the caller loses them). */
  transfer?: boolean;
}

/** Starts the shared worker and loads the wasm; optional, idempotent, called by the functions below. */
export function init(options?: WorkerOptions | InitInput): Promise<void>;
export function fit(input: HeightImage | Heightfield, options?: FitOptions): Promise<Surface>;
export function read(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadOptions): Promise<ReadResult>;
export function writeNpy(input: HeightImage | Heightfield): Promise<Uint8Array>;
export function writePng(input: HeightImage): Promise<Uint8Array>;
export function writeObj(input: Heightfield): Promise<Uint8Array>;
export function example(name: ExampleName, options?: ExampleOptions): Promise<Example>;
/** Stops the shared worker; a later call starts a new one. */
export function dispose(): void;

/** A worker of one's own, with the same functions as methods. */
export class DevelopableWorker {
  constructor(options?: WorkerOptions);
  init(): Promise<void>;
  fit(input: HeightImage | Heightfield, options?: FitOptions): Promise<Surface>;
  read(bytes: Uint8Array | ArrayBuffer | Blob, options?: ReadOptions): Promise<ReadResult>;
  writeNpy(input: HeightImage | Heightfield): Promise<Uint8Array>;
  writePng(input: HeightImage): Promise<Uint8Array>;
  writeObj(input: Heightfield): Promise<Uint8Array>;
  example(name: ExampleName, options?: ExampleOptions): Promise<Example>;
  readonly disposed: boolean;
  dispose(): void;
  [Symbol.dispose](): void;
}
