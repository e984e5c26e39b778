/** The one wasm instance of this thread: loaded once, given up after a trap. */
import * as glue from './wasm/developable.js';
import { DevelopableError, messageOf } from './errors.js';
import { compile } from './wasm-source.js';

/** @typedef {typeof glue} Wasm */

/** @type {Promise<void> | undefined} */
let loading;
let ready = false;
/** @type {DevelopableError | undefined} */
let trap;

/** @type {typeof import('./direct.js').init} */
export function init(input) {
  loading ??= load(input).catch((cause) => {
    loading = undefined; // so that it can be tried again
    throw initError(cause);
  });
  return loading;
}

/** @type {typeof import('./direct.js').initSync} */
export function initSync(input) {
  if (ready) return;
  try {
    const bytes = /** @type {BufferSource | WebAssembly.Module} */ (input);
    glue.initSync({
      module: bytes instanceof WebAssembly.Module ? bytes : new WebAssembly.Module(bytes),
    });
    start();
  } catch (cause) {
    throw initError(cause);
  }
  loading = Promise.resolve();
}

/** @param {import('./types.js').InitInput} [input] */
async function load(input) {
  const module = await compile(input);
  if (ready) return; // `initSync` was faster
  await glue.default({ module_or_path: module });
  start();
}

function start() {
  glue.reportPanics();
  ready = true;
}

/** @param {unknown} cause */
function initError(cause) {
  return new DevelopableError('INIT', `the wasm could not be loaded: ${messageOf(cause)}`, { cause });
}

/**
 * Calls into the wasm; whatever comes out of it is a `DevelopableError`.
 *
 * Rust's own errors carry a code. Anything else is a crash (a panic, an exhausted stack, memory
 * that could not be had), after which nothing in the instance's memory can be relied on.
 *
 * @template T
 * @param {(wasm: Wasm) => T} run
 * @returns {T}
 */
export function call(run) {
  if (trap) throw trap;
  if (!ready) {
    throw new DevelopableError('NOT_INITIALIZED', 'the wasm is not loaded yet: await init() first');
  }
  try {
    return run(glue);
  } catch (error) {
    const { code } = /** @type {{ code?: import('./errors.js').ErrorCode }} */ (error);
    if (error instanceof Error && typeof code === 'string') {
      throw new DevelopableError(code, error.message);
    }
    trap = new DevelopableError(
      'TRAP',
      `the solver crashed and cannot be used in this thread any more (${messageOf(error)}); ` +
        'please report this with the input that caused it',
      { cause: error },
    );
    throw trap;
  }
}

/** Whether calls are still possible: false after a trap. */
export const alive = () => trap === undefined;
