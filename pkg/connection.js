/** A running worker, and the calls that wait for it. */
import { wasmCopy, workerCopy } from './copies.js';
import { DevelopableError, messageOf } from './errors.js';
import { Team } from './team.js';
import { spawn, spawnCode } from './thread.js';
import { expose, transfer, wrap } from './wire.js';

/**
 * @typedef {import('./vendor/comlink.mjs').Remote<typeof import('./service.js').service>} Remote
 * @typedef {string | WebAssembly.Module | undefined} Source what a worker can be told about where a wasm file is
 * @typedef {import('./thread.js').Thread} Thread
 */

export class Connection {
  /** @type {Thread | undefined} */
  #thread;
  /** @type {Remote | undefined} */
  #remote;
  #ready;
  #threads;
  /** @type {Team | undefined} */
  #team;
  /** @type {Set<(error: DevelopableError) => void>} */
  #pending = new Set();
  /** @type {DevelopableError | undefined} why it ended */
  #end;

  /**
   * @param {string | URL | undefined} workerUrl
   * @param {Promise<Source[]>} wasm the solver's, the files', the images', the meshes', of fits to meshes, the unrolling's and the patterns'
   * @param {number} [threads] that solves are to run on
   */
  constructor(workerUrl, wasm, threads) {
    this.#threads = threads;
    this.#ready = this.#settled(this.#start(workerUrl, wasm));
    this.#ready.catch((error) => this.close(error));
  }

  /**
   * Starts the script beside this module, or else the copy that a bundle without that script has.
   * @param {string | URL | undefined} workerUrl
   * @param {Promise<Source[]>} wasm
   */
  async #start(workerUrl, wasm) {
    const failure = await this.#use(() => spawn(workerUrl), wasm);
    if (failure === undefined) return;
    const code = workerUrl === undefined ? await workerCopy() : undefined;
    if (this.#end) return;
    const failed = code ? await this.#use(() => spawnCode(code), wasm, portOfCopies()) : failure;
    if (failed !== undefined) throw new DevelopableError('WORKER', notStarted(failed, code !== undefined));
  }

  /**
   * @param {() => Thread} begin
   * @param {Promise<Source[]>} wasm
   * @param {MessagePort} [copies] where a script without files beside it asks for them
   * @returns {Promise<string | undefined>} why it ended before it could answer, if it did
   */
  async #use(begin, wasm, copies) {
    let thread;
    try {
      thread = begin();
    } catch (error) {
      return messageOf(error);
    }
    this.#thread = thread;
    thread.hold(this.#pending.size > 0);
    const remote = /** @type {Remote} */ (wrap(thread.endpoint));
    const init = wasm.then((sources) => this.#init(thread, remote, sources, begin, copies));
    const failure = await Promise.race([init, thread.ended]);
    if (failure !== undefined) {
      this.#team?.dismiss();
      return failure;
    }
    this.#remote = remote;
    thread.ended.then((reason) => this.close(new DevelopableError('WORKER', `the worker failed: ${reason}`)));
  }

  /**
   * Loads the worker's solver, with helpers where several threads were asked for.
   * @param {Thread} thread of the worker
   * @param {Remote} remote
   * @param {Source[]} sources
   * @param {() => Thread} begin
   * @param {MessagePort} [copies]
   */
  async #init(thread, remote, sources, begin, copies) {
    // The connection may have been closed, or begun with another script, while the sources were fetched.
    if (this.#end || this.#thread !== thread) return;
    const team = this.#threads === undefined ? undefined : new Team(this.#threads);
    this.#team = team;
    // Helpers load the same script, which is in the cache once the worker answers.
    if (team) await remote.setThreadLimit(team.limit);
    await team?.start(begin);
    if (this.#end) team?.dismiss();
    const starts = await remote.init(sources, copies && transfer(copies, [copies]), team?.size);
    if (!team) return;
    if (starts) await team.join(starts);
    else if (team.size > 0) team.dismiss('build');
    await remote.setThreadLimit(team.limit);
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
   * @param {Error} [caller] whose stack tells who asked
   * @returns {Promise<T>}
   */
  async request(run, caller = new Error()) {
    if (this.#end) throw this.#end;
    const work = async () => {
      await this.#ready;
      try {
        return await run(/** @type {Remote} */ (this.#remote));
      } catch (error) {
        throw calledBy(error, caller);
      }
    };
    return this.#settled(work());
  }

  /**
   * Ends the worker, and with the given error all calls that wait for it.
   * @param {DevelopableError} error
   */
  close(error) {
    if (this.#end) return;
    this.#end = error;
    this.#thread?.terminate();
    this.#team?.dismiss();
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
    this.#thread?.hold(true);
    try {
      return /** @type {T} */ (await Promise.race([promise, ended]));
    } catch (error) {
      // After a crash the thread's wasm is of no use to anyone, and memory comes back only with a thread's end.
      if (error instanceof DevelopableError && ['TRAP', 'OUT_OF_MEMORY'].includes(error.code)) this.close(error);
      if (error instanceof Error && error.name === 'DataCloneError') {
        throw new DevelopableError('INPUT', `an argument cannot be sent to the worker: ${error.message}`);
      }
      throw error;
    } finally {
      this.#pending.delete(reject);
      this.#thread?.hold(this.#pending.size > 0);
    }
  }
}

/**
 * An error of another thread, whose stack goes on with that of the call here.
 * @param {unknown} error
 * @param {Error} caller
 */
function calledBy(error, caller) {
  if (error instanceof DevelopableError) error.stack += `\n${caller.stack?.replace(/^Error\n/, '')}`;
  return error;
}

/** Where a worker gets copies of the wasm from. */
function portOfCopies() {
  const { port1, port2 } = new MessageChannel();
  expose(async (/** @type {import('./copies.js').WasmName} */ name) => {
    const bytes = await wasmCopy(name);
    return bytes && transfer(bytes, [bytes.buffer]);
  }, port1);
  // In Node it would keep the process alive.
  /** @type {{ unref?: () => void }} */ (port1).unref?.();
  return port2;
}

/**
 * @param {string} reason
 * @param {boolean} copied
 */
function notStarted(reason, copied) {
  const remedy = copied
    ? "allow workers from blob: (in a content security policy: worker-src 'self' blob:), or put"
    : 'put';
  return `the worker could not be started: ${reason}; ${remedy} the package's folder on your site and say where: `
    + "init({ workerUrl: '/developable/worker.js' })";
}
