/** The promise API, over a worker of its own. Documented in `index.d.ts`. */
import { Connection } from './connection.js';
import { DevelopableError, messageOf } from './errors.js';
import { asBytes, asField, asImage, asLattice, detached } from './input.js';
import { makeDisposable } from './platform.js';
import { compile, locate } from './wasm-source.js';
import { transfer } from './wire.js';

/**
 * @typedef {import('./index.js').DevelopableWorker} DevelopableWorkerApi
 * @typedef {import('./index.js').WorkerOptions} WorkerOptions
 * @typedef {import('./index.js').FitOptions} FitOptions
 * @typedef {import('./types.js').HeightImage} HeightImage
 * @typedef {import('./types.js').Heightfield} Heightfield
 * @typedef {import('./connection.js').Remote} Remote
 */

/** Milliseconds between two calls of `onProgress`, at least. */
const PROGRESS_INTERVAL = 60;

/** @implements {Omit<DevelopableWorkerApi, typeof Symbol.dispose>} */
export class DevelopableWorker {
  #options;
  /** @type {Connection | undefined} */
  #connection;
  /** @type {Promise<import('./connection.js').Source[]> | undefined} */
  #wasm;
  #disposed = false;

  /** @param {WorkerOptions} [options] */
  constructor(options = {}) {
    this.#options = options;
  }

  init() {
    return this.#request(async () => {});
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {FitOptions} [options]
   */
  async fit(input, { signal, onAbort = 'reject', onProgress, transfer: handOver = false, ...options } = {}) {
    if (onAbort !== 'reject' && onAbort !== 'keep') {
      throw new DevelopableError('OPTION', "option `onAbort` must be 'reject' or 'keep'");
    }
    const keep = onAbort === 'keep';
    if (!keep) signal?.throwIfAborted();
    const { field, buffers } = detached(asField(input), handOver);
    const sent = transfer(field, buffers);
    const surface = this.#request((remote) => solve(remote, sent, options, { signal, keep, onProgress }));
    return signal && !keep ? orAborted(surface, signal) : surface;
  }

  /**
   * @param {Uint8Array | ArrayBuffer | Blob} bytes
   * @param {import('./types.js').ReadOptions} [options]
   */
  async read(bytes, options) {
    const isBlob = typeof Blob === 'function' && bytes instanceof Blob;
    const file = isBlob ? new Uint8Array(await bytes.arrayBuffer()) : new Uint8Array(asBytes(bytes));
    return this.#request((remote) => remote.read(transfer(file, [file.buffer]), options));
  }

  /** @param {HeightImage | Heightfield} input */
  async writeNpy(input) {
    const { field, buffers } = detached(asField(input), false);
    return this.#request((remote) => remote.writeNpy(transfer(field, buffers)));
  }

  /** @param {HeightImage} input */
  async writePng(input) {
    const { field, buffers } = detached(asImage(input), false);
    return this.#request((remote) => remote.writePng(transfer(field, buffers)));
  }

  /** @param {Heightfield} input */
  async writeObj(input) {
    const { field, buffers } = detached(asLattice(input), false);
    return this.#request((remote) => remote.writeObj(transfer(field, buffers)));
  }

  /**
   * @param {import('./types.js').ExampleName} name
   * @param {import('./types.js').ExampleOptions} [options]
   */
  example(name, options) {
    return this.#request((remote) => remote.example(name, options));
  }

  get connected() {
    return this.#connection?.open === true;
  }

  get disposed() {
    return this.#disposed;
  }

  dispose() {
    this.#disposed = true;
    this.#connection?.close(new DevelopableError('DISPOSED', 'this worker has been disposed'));
  }

  /**
   * @template T
   * @param {(remote: Remote) => Promise<T>} run
   * @returns {Promise<T>}
   */
  async #request(run) {
    if (this.#disposed) throw new DevelopableError('DISPOSED', 'this worker has been disposed');
    if (!this.#connection?.open) {
      const { wasm, filesWasm } = this.#options;
      this.#wasm ??= Promise.all([portable(wasm), portable(filesWasm)]);
      this.#connection = new Connection(this.#options.workerUrl, this.#wasm);
      this.#wasm.catch(() => (this.#wasm = undefined));
    }
    return this.#connection.request(run);
  }
}
makeDisposable(DevelopableWorker);

/** Number of the last solve: numbers are chosen here, so that a solve can be stopped at any time. */
let solves = 0;

/**
 * @param {Remote} remote
 * @param {import('./input.js').Image | import('./input.js').Lattice} field
 * @param {import('./types.js').SolverOptions} options
 * @param {{ signal?: AbortSignal, keep: boolean, onProgress: FitOptions['onProgress'] }} control
 */
async function solve(remote, field, options, { signal, keep, onProgress }) {
  if (!keep) signal?.throwIfAborted();
  solves += 1;
  const id = solves;
  /** @param {boolean} keep */
  const stop = (keep) => void remote.stop(id, keep).catch(() => {});
  const onAbort = () => stop(keep);
  signal?.addEventListener('abort', onAbort);
  try {
    const started = remote.start(id, field, options, onProgress ? PROGRESS_INTERVAL : Infinity);
    if (signal?.aborted) stop(keep);
    await started;
    for (;;) {
      // Asked for piece by piece, so that a busy page is not flooded with old news.
      const { progress, surface } = await remote.next(id);
      onProgress?.(progress);
      if (surface) return surface;
    }
  } catch (error) {
    stop(false); // it may be `onProgress` that threw
    throw error;
  } finally {
    signal?.removeEventListener('abort', onAbort);
  }
}

/**
 * @template T
 * @param {Promise<T>} promise
 * @param {AbortSignal} signal
 * @returns {Promise<T>}
 */
function orAborted(promise, signal) {
  return new Promise((resolve, reject) => {
    const abort = () => reject(signal.reason);
    signal.addEventListener('abort', abort);
    promise.then(resolve, reject).finally(() => signal.removeEventListener('abort', abort));
  });
}

/**
 * What a worker can be told about where the wasm is, again and again.
 * @param {import('./types.js').InitInput | undefined} wasm
 * @returns {Promise<import('./connection.js').Source>}
 */
async function portable(wasm) {
  if (wasm === undefined) return undefined;
  try {
    // A relative address would count from the worker's script there.
    return typeof wasm === 'string' || wasm instanceof URL ? locate(wasm).href : await compile(wasm);
  } catch (cause) {
    throw new DevelopableError('INIT', `the wasm could not be loaded: ${messageOf(cause)}`, { cause });
  }
}
