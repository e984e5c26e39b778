/** A running worker, and the calls that wait for it. */
import { DevelopableError, messageOf } from './errors.js';
import { builtin } from './platform.js';
import nodeEndpoint from './vendor/node-adapter.mjs';
import { wrap } from './wire.js';

/**
 * @typedef {import('./vendor/comlink.mjs').Remote<typeof import('./service.js').service>} Remote
 * @typedef {string | WebAssembly.Module | undefined} Source what a worker can be told about where a wasm file is
 * @typedef {{
 *   endpoint: import('./vendor/comlink.mjs').Endpoint,
 *   terminate: () => void,
 *   hold: (busy: boolean) => void,
 * }} Thread
 */

export class Connection {
  #thread;
  #remote;
  #ready;
  /** @type {Set<(error: DevelopableError) => void>} */
  #pending = new Set();
  /** @type {DevelopableError | undefined} why it ended */
  #end;

  /**
   * @param {string | URL | undefined} workerUrl
   * @param {Promise<Source[]>} wasm the solver's, the files', the images', the meshes', the unrolling's and the patterns'
   */
  constructor(workerUrl, wasm) {
    /** @param {string} reason */
    const died = (reason) => this.close(new DevelopableError('WORKER', reason));
    this.#thread = spawn(workerUrl, died);
    this.#remote = /** @type {Remote} */ (wrap(this.#thread.endpoint));
    this.#ready = this.#settled(wasm.then((sources) => this.#remote.init(sources)));
    this.#ready.catch((error) => this.close(error));
  }

  get open() {
    return this.#end === undefined;
  }

  /** Why it ended, if it has. */
  get end() {
    return this.#end;
  }

  /**
   * Calls the worker once it is ready. Ends with the connection: Comlink alone would wait for ever.
   * @template T
   * @param {(remote: Remote) => Promise<T>} run
   * @returns {Promise<T>}
   */
  async request(run) {
    if (this.#end) throw this.#end;
    return this.#settled(this.#ready.then(() => run(this.#remote)));
  }

  /**
   * Ends the worker, and with the given error all calls that wait for it.
   * @param {DevelopableError} error
   */
  close(error) {
    if (this.#end) return;
    this.#end = error;
    this.#thread.terminate();
    for (const reject of this.#pending) reject(error);
  }

  /**
   * @template T
   * @param {Promise<T>} promise
   * @returns {Promise<T>}
   */
  async #settled(promise) {
    /** @type {(error: DevelopableError) => void} */
    let reject = () => {};
    const ended = new Promise((_, fail) => (reject = fail));
    this.#pending.add(reject);
    this.#thread.hold(true);
    try {
      return /** @type {T} */ (await Promise.race([promise, ended]));
    } catch (error) {
      // After a crash the thread's wasm is of no use to anyone.
      if (error instanceof DevelopableError && error.code === 'TRAP') this.close(error);
      if (error instanceof Error && error.name === 'DataCloneError') {
        throw new DevelopableError('INPUT', `an argument cannot be sent to the worker: ${error.message}`);
      }
      throw error;
    } finally {
      this.#pending.delete(reject);
      this.#thread.hold(this.#pending.size > 0);
    }
  }
}

/**
 * @param {string | URL | undefined} url
 * @param {(reason: string) => void} died
 * @returns {Thread}
 */
function spawn(url, died) {
  const threads = typeof Worker === 'undefined' ? builtin('node:worker_threads') : undefined;
  return threads ? spawnThread(threads, url, died) : spawnWorker(url, died);
}

/**
 * @param {string | URL | undefined} url
 * @param {(reason: string) => void} died
 * @returns {Thread}
 */
function spawnWorker(url, died) {
  const worker = url
    ? new Worker(url, { type: 'module', name: 'developable' })
    : // Bundlers look for exactly this.
      new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  worker.addEventListener('error', (event) => {
    event.preventDefault?.();
    // A script that cannot be loaded gives an event without a message.
    died(`the worker failed: ${event.message || 'its script could not be loaded'}`);
  });
  worker.addEventListener('messageerror', () => died('the worker sent what cannot be received'));
  return { endpoint: worker, terminate: () => worker.terminate(), hold: () => {} };
}

/**
 * @param {typeof import('node:worker_threads')} threads
 * @param {string | URL | undefined} url
 * @param {(reason: string) => void} died
 * @returns {Thread}
 */
function spawnThread(threads, url, died) {
  // Kept apart from the `new URL` above, which bundlers for browsers resolve.
  const script = './worker.js';
  const worker = new threads.Worker(url ?? new URL(script, import.meta.url), { execArgv: [] });
  worker.on('error', (error) => died(`the worker failed: ${messageOf(error)}`));
  worker.on('messageerror', () => died('the worker sent what cannot be received'));
  worker.on('exit', (code) => died(`the worker ended with exit code ${code}`));
  worker.unref();
  return {
    endpoint: nodeEndpoint(/** @type {any} */ (worker)),
    terminate: () => void worker.terminate(),
    // An idle worker does not keep the process alive.
    hold: (busy) => (busy ? worker.ref() : worker.unref()),
  };
}
