/** A wasm instance of this thread: loaded once, given up after a trap. */
import { DevelopableError, messageOf } from './errors.js';
import { PROGRESS_INTERVAL, answerOf } from './progress.js';
import { compile, compileOwn } from './wasm-source.js';

/** @typedef {import('./progress.js').OnProgress} OnProgress */
/** @typedef {{ memory: WebAssembly.Memory }} Exports */

/**
 * What wasm-bindgen makes of each wasm file, as far as it is the same for all.
 * @typedef {{
 *   default: (input: { module_or_path: WebAssembly.Module }) => Promise<Exports>,
 *   initSync: (input: { module: WebAssembly.Module }) => Exports,
 *   reportPanics: () => void,
 *   watch: (listener?: (fraction: number) => void) => void,
 * }} Glue
 */

/** @template {Glue} G */
export class Instance {
  /** @type {G | undefined} */
  #glue;
  #name;
  #importGlue;
  #place;
  /** @type {Promise<void> | undefined} */
  #loading;
  #ready = false;
  /** @type {WebAssembly.Memory | undefined} */
  #memory;
  /** @type {DevelopableError | undefined} */
  #trap;

  /**
   * @param {import('./copies.js').WasmName} name
   * @param {() => Promise<G>} importGlue
   * @param {() => URL} place where the file is unless `init` is told otherwise
   */
  constructor(name, importGlue, place) {
    this.#name = name;
    this.#importGlue = importGlue;
    this.#place = place;
  }

  /** Takes the glue from a caller who has it already. @param {G} glue */
  use(glue) {
    this.#glue ??= glue;
  }

  /**
   * @param {import('./types.js').InitInput} [input]
   * @returns {Promise<void>}
   */
  init(input) {
    this.#loading ??= this.#load(input).catch((cause) => {
      this.#loading = undefined; // so that it can be tried again
      throw initError(cause);
    });
    return this.#loading;
  }

  /** Needs the glue. @param {ArrayBuffer | ArrayBufferView | WebAssembly.Module} input */
  initSync(input) {
    if (this.#ready) return;
    try {
      const bytes = /** @type {BufferSource | WebAssembly.Module} */ (input);
      const module = bytes instanceof WebAssembly.Module ? bytes : new WebAssembly.Module(bytes);
      const glue = /** @type {G} */ (this.#glue);
      this.#start(glue, glue.initSync({ module }));
    } catch (cause) {
      throw initError(cause);
    }
    this.#loading = Promise.resolve();
  }

  /**
   * Takes another build of the file, started by the caller, in its place.
   * @param {Omit<G, 'default' | 'initSync'>} glue
   * @param {Exports} exports
   */
  take(glue, exports) {
    this.#start(/** @type {G} */ (/** @type {unknown} */ (glue)), exports);
    // A later `init` loads nothing.
    this.#loading = Promise.resolve();
  }

  /** @param {import('./types.js').InitInput} [input] */
  async #load(input) {
    const compiled = input === undefined ? compileOwn(this.#name, this.#place) : compile(input);
    const [glue, module] = await Promise.all([this.#glue ?? this.#importGlue(), compiled]);
    if (this.#ready) return; // `initSync` was faster
    this.#start(glue, await glue.default({ module_or_path: module }));
  }

  /**
   * @param {G} glue
   * @param {Exports} exports
   */
  #start(glue, { memory }) {
    glue.reportPanics();
    this.#memory = memory;
    this.#glue = glue;
    this.#ready = true;
  }

  /**
   * Calls into the wasm; whatever comes out of it is a `DevelopableError`.
   *
   * Rust's own errors carry a code. Anything else is a crash (a panic, an exhausted stack, memory
   * that could not be had), after which nothing in the instance's memory can be relied on.
   *
   * @template T
   * @param {(wasm: G) => T} run
   * @returns {T}
   */
  call(run) {
    if (this.#trap) throw this.#trap;
    if (!this.#ready || !this.#glue) {
      const hint = this.#name === 'solver' ? 'init()' : `load('${this.#name}')`;
      throw new DevelopableError('NOT_INITIALIZED', `the wasm is not loaded yet: await ${hint} first`);
    }
    try {
      return run(this.#glue);
    } catch (error) {
      /** @type {{ code?: import('./errors.js').ErrorCode }} */
      const { code } = Object(error);
      if (error instanceof Error && typeof code === 'string') {
        throw new DevelopableError(code, error.message);
      }
      this.#trap = crash(error, this.#memory);
      throw this.#trap;
    }
  }

  /**
   * Calls as `call` does, and tells several times a second how far the call is. What `onProgress` throws, the call throws once
   * the wasm has ended.
   * @template T
   * @param {(wasm: G) => T} run
   * @param {OnProgress} [onProgress]
   * @param {readonly [number, number]} [span] where the call begins and ends, as fractions of the whole that is told
   * @returns {T}
   */
  watched(run, onProgress, [begin, end] = [0, 1]) {
    if (!onProgress) return this.call(run);
    let [told, last] = [performance.now(), begin];
    /** @type {{ error: unknown } | undefined} */
    let failure;
    /** @param {number} fraction */
    const tell = (fraction) => {
      const now = performance.now();
      const whole = begin + (end - begin) * fraction;
      if (failure || whole === last || (whole < 1 && now - told < PROGRESS_INTERVAL)) return;
      [told, last] = [now, whole];
      try {
        answerOf(onProgress, { fraction: whole });
      } catch (error) {
        failure = { error };
      }
    };
    this.call((wasm) => wasm.watch(tell));
    try {
      const result = this.call(run);
      tell(1);
      if (failure) throw failure.error;
      return result;
    } finally {
      if (this.alive) this.call((wasm) => wasm.watch());
    }
  }

  /** Whether calls are still possible: false after a trap. */
  get alive() {
    return this.#trap === undefined;
  }
}

/**
 * Where Rust cannot have the memory that it must have, it ends as in a crash; then there is none to be had.
 * @param {unknown} cause
 * @param {WebAssembly.Memory} [memory]
 */
function crash(cause, memory) {
  if (memory && cause instanceof WebAssembly.RuntimeError && isExhausted(memory)) {
    const used = (memory.buffer.byteLength / 2 ** 30).toFixed(1);
    return new DevelopableError(
      'OUT_OF_MEMORY',
      `there is no more memory than the ${used} GiB that the wasm has, and it cannot be used in this thread any more; ` +
        'use a coarser spacing or a smaller input',
      { cause },
    );
  }
  return new DevelopableError(
    'TRAP',
    `the wasm crashed and cannot be used in this thread any more (${messageOf(cause)}); ` +
      'please report this with the input that caused it',
    { cause },
  );
}

/** Whether the memory of a crashed instance could not have grown by a fourth. @param {WebAssembly.Memory} memory */
function isExhausted(memory) {
  try {
    memory.grow(Math.ceil(memory.buffer.byteLength / 65536 / 4));
    return false;
  } catch {
    return true;
  }
}

/** @param {unknown} cause */
function initError(cause) {
  return new DevelopableError('INIT', `the wasm could not be loaded: ${messageOf(cause)}`, { cause });
}
