/** The promise API, over a worker of its own. Documented in `index.d.ts`. */
import { CALLS, handedOver } from './calls.js';
import { contextOf, put } from './canvas.js';
import { Connection } from './connection.js';
import { controlOf } from './control.js';
import { DevelopableError, messageOf } from './errors.js';
import { explored, exploredMesh } from './explore.js';
import { copyOfFile, isBlob } from './file-bytes.js';
import { asInput, asLattice, checkLengths } from './input.js';
import { asPicture, isMesh, wholeOf } from './mesh-input.js';
import { OpenSolver } from './open.js';
import { OPTIONS, optionsOf } from './options.js';
import { makeDisposable } from './platform.js';
import { progressPort } from './progress.js';
import { extentOf } from './sheet-input.js';
import { readOptions, signal as signalKind } from './schema/kinds.js';
import { orAborted, solve } from './solve.js';
import { isRecord, reading } from './values.js';
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

/** Maximum number of workers for calls that can be aborted; each has its own memory, and further calls wait. */
const MAX_ABORTABLE_WORKERS = 2;

/** Number of the last solver that was opened. */
let opened = 0;

/**
 * Has the methods of `CALLS` besides those below.
 * @implements {Omit<DevelopableWorkerApi, typeof Symbol.dispose | keyof typeof CALLS>}
 */
export class DevelopableWorker {
  #options;
  /** @type {Connection | undefined} */
  #connection;
  /** @type {Promise<import('./connection.js').Source[]> | undefined} */
  #wasm;
  /** A worker for calls that can be aborted, while none runs in it. @type {Connection | undefined} */
  #idle;
  /** Workers in which such calls run, and what is fulfilled when these have ended. @type {Map<Connection, Promise<unknown>>} */
  #abortables = new Map();
  #disposed = false;

  /** @param {WorkerOptions} [options] */
  constructor(options) {
    this.#options = optionsOf('worker', options);
  }

  async init() {
    const connection = this.#connect();
    try {
      await connection.request((remote) => remote.loadSolver());
    } catch (error) {
      // So that it can be tried again with another place.
      if (error instanceof DevelopableError && error.code === 'INIT') connection.close(error);
      throw error;
    }
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {FitOptions} [given]
   * @returns {Promise<any>} a surface, of the input's kind
   */
  async fit(input, given) {
    const { control, options: { transfer: handOver, ...options } } = controlOf('fit', given);
    if (!control.keep) control.signal?.throwIfAborted();
    const field = asInput(input);
    if (handOver) checkLengths(field);
    // What is copied is copied at once; what is handed over stays the caller's until nothing can be wrong with the options.
    const copy = handOver ? undefined : handedOver(field);
    const surface = this.#request(async (remote) => {
      if (handOver) await remote.check(options);
      const sent = copy ?? handedOver(field, { transfer: true });
      return solve(remote, (id, interval) => remote.start(id, sent, options, interval), control);
    });
    return orAborted(surface, control);
  }

  /**
   * @param {HeightImage | Heightfield} input
   * @param {import('./index.js').HandOver} [options]
   */
  async open(input, options) {
    const sent = handedOver(asInput(input), options);
    const connection = this.#connect();
    const id = (opened += 1);
    // Its answer is not awaited: where the page is busy by then, the first solve would wait for it. What is wrong is told by that.
    await connection.request(async (remote) => void remote.open(id, sent).catch(() => {}));
    return /** @type {import('./index.js').OpenSolver} */ (/** @type {unknown} */ (new OpenSolver(connection, id))); // for `using`
  }

  /**
   * @param {import('./types.js').Mesh} mesh
   * @param {import('./index.js').FitMeshOptions} [given]
   * @returns {Promise<import('./types.js').MeshSurface>}
   */
  async fitMesh(mesh, given) {
    const { control, options } = controlOf('fitMesh', given);
    if (!control.keep) control.signal?.throwIfAborted();
    const { shape, own } = wholeOf(mesh);
    const found = this.#request((remote) =>
      solve(remote, (id, interval) => remote.start(id, shape, options, interval), control));
    const surface = await orAborted(found, control);
    return /** @type {any} */ ({ ...own, ...surface });
  }

  /**
   * @template {Heightfield} F
   * @param {F} input
   * @param {import('./types.js').Picture | Blob} picture
   * @param {import('./types.js').PaintOptions} [given]
   * @returns {Promise<import('./types.js').Painted<F>>}
   */
  async paint(input, picture, given) {
    const own = reading('INPUT', 'the input', () => /** @type {typeof input} */ (isRecord(input) ? { ...input } : {}));
    const { extent, camera } = optionsOf('paint', given);
    const field = handedOver(asLattice(own));
    const found = asPicture(isBlob(picture) ? await copyOfFile(picture) : picture);
    const known = camera ?? field.camera ?? field.uvs;
    const place = { camera, extent: extent ?? (known ? undefined : extentOf(own)) };
    return { ...own, ...await this.#request((remote) => remote.paint(field, found, place)) };
  }

  /**
   * @param {import('./types.js').Canvas} canvas
   * @param {HeightImage | Heightfield} input
   * @param {import('./types.js').PictureOptions} [given]
   */
  async draw(canvas, input, given) {
    const context = contextOf(canvas);
    const { picture } = /** @type {DevelopableWorkerApi} */ (/** @type {unknown} */ (this));
    put(context, await picture.call(this, input, given));
  }

  /**
   * @param {any} input
   * @param {any} [given]
   */
  explorePattern(input, given) {
    const explore = isMesh(input) ? exploredMesh : explored;
    return explore(/** @type {any} */ (this), (values) => this.#request((remote) => remote.trials(values)), input, given);
  }

  get connected() {
    return this.#connection?.open === true;
  }

  get disposed() {
    return this.#disposed;
  }

  dispose() {
    this.#disposed = true;
    const error = new DevelopableError('DISPOSED', 'this worker has been disposed');
    for (const connection of [this.#connection, this.#idle, ...this.#abortables.keys()]) connection?.close(error);
  }

  static {
    for (const [name, { send }] of Object.entries(CALLS)) {
      /** @this {DevelopableWorker} @param {any[]} given */
      const method = async function (...given) {
        const caller = new Error();
        const { signal, onProgress, others } = withoutControl(/** @type {keyof typeof CALLS} */ (name), given);
        signal?.throwIfAborted();
        const sent = await /** @type {import('./calls.js').Call['send']} */ (send)(...others);
        const progress = onProgress && progressPort(onProgress);
        /** @param {Remote} remote */
        const ask = (remote) => remote.answer(/** @type {keyof typeof CALLS} */ (name), progress && transfer(progress.port, [progress.port]), ...sent);
        try {
          const result = await (signal ? this.#abortable(ask, signal, caller) : this.#request(ask, caller));
          await progress?.end();
          await onProgress?.({ fraction: 1 });
          return result;
        } finally {
          void progress?.end().catch(() => {});
        }
      };
      Object.defineProperty(method, 'name', { value: name });
      Object.defineProperty(this.prototype, name, { value: method, configurable: true, writable: true });
    }
  }

  /**
   * @template T
   * @param {(remote: Remote) => Promise<T>} run
   * @param {Error} [caller]
   * @returns {Promise<T>}
   */
  async #request(run, caller) {
    return this.#connect().request(run, caller);
  }

  /**
   * Has another worker answer, which an abort ends: what runs in wasm cannot be stopped otherwise, and other calls go on.
   * @template T
   * @param {(remote: Remote) => Promise<T>} run
   * @param {AbortSignal} signal
   * @param {Error} caller
   * @returns {Promise<T>}
   */
  async #abortable(run, signal, caller) {
    while (this.#abortables.size >= MAX_ABORTABLE_WORKERS && !signal.aborted) {
      await orAborted(Promise.race(this.#abortables.values()), { signal, keep: false });
    }
    signal.throwIfAborted();
    // These calls run on one thread each.
    const connection = this.#takeIdle() ?? this.#newConnection();
    const stop = () => connection.close(new DevelopableError('DISPOSED', 'the call was aborted'));
    signal.addEventListener('abort', stop, { once: true });
    const answer = connection.request(run, caller).finally(() => {
      signal.removeEventListener('abort', stop);
      this.#abortables.delete(connection);
      // One is kept for the next such call.
      if (this.#idle?.open) connection.close(new DevelopableError('DISPOSED', 'one idle worker is enough'));
      else this.#idle = connection;
    });
    this.#abortables.set(connection, Promise.allSettled([answer]));
    return answer.catch((error) => {
      signal.throwIfAborted();
      throw error;
    });
  }

  #takeIdle() {
    const idle = this.#idle;
    this.#idle = undefined;
    return idle?.open ? idle : undefined;
  }

  /** The worker that runs, or else a new one. */
  #connect() {
    if (this.#disposed || !this.#connection?.open) this.#connection = this.#newConnection(this.#options.threads);
    return this.#connection;
  }

  /** @param {number} [threads] that its solves are to run on */
  #newConnection(threads) {
    if (this.#disposed) throw new DevelopableError('DISPOSED', 'this worker has been disposed');
    const { wasm, filesWasm, imagesWasm, meshesWasm, fitmeshWasm, unrollWasm, patternsWasm } = this.#options;
    const sources = [wasm, filesWasm, imagesWasm, meshesWasm, fitmeshWasm, unrollWasm, patternsWasm];
    this.#wasm ??= Promise.all(sources.map(portable));
    this.#wasm.catch(() => (this.#wasm = undefined));
    return new Connection(this.#options.workerUrl, this.#wasm, threads);
  }
}
makeDisposable(DevelopableWorker);

/** Whether there is an option; what cannot be read is left to who takes it. @param {unknown} options @param {string} name */
function has(options, name) {
  try {
    return isRecord(options) && Object.hasOwn(/** @type {object} */ (options), name);
  } catch {
    return false;
  }
}

/**
 * Takes what is for the client alone out of the options, which are the last argument.
 * @param {keyof typeof CALLS} call
 * @param {any[]} given
 * @returns {{ signal?: AbortSignal, onProgress?: import('./progress.js').OnProgress, others: any[] }}
 */
function withoutControl(call, given) {
  const last = given.at(-1);
  const own = /** @type {Record<string, import('./schema/kinds.js').Options>} */ (OPTIONS)[call] ?? {};
  const kinds = { signal: { kind: signalKind }, ...(own.onProgress && { onProgress: own.onProgress }) };
  const taken = Object.keys(kinds).filter((name) => has(last, name));
  if (taken.length === 0) return { others: given };
  const options = reading('OPTION', 'the options', () => ({ .../** @type {Record<string, unknown>} */ (last) }));
  const control = Object.fromEntries(taken.map((name) => [name, options[name]]));
  for (const name of taken) delete options[name];
  return { ...readOptions(kinds, control), others: [...given.slice(0, -1), options] };
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
