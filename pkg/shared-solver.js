/**
 * The solver's build for several threads, in a memory that helpers share: further workers, which run pieces of the
 * solver's jobs. See `wasm/solver/src/team.rs`.
 */
import { solver } from './instances.js';
import { reportCrash } from './helper-start.js';
import * as glue from './threads/threads.js';
import { compile } from './wasm-source.js';

/** @import {HelperStart} from './helper-start.js' */

/** Pages of 64 KiB that the memory begins with: more than the module's own data take. */
const INITIAL_MEMORY_PAGES = 64;

/** Minimum number of pages that the memory must be able to grow to (1 GiB): with less, one thread solves larger inputs. */
const MIN_MAX_MEMORY_PAGES = 16384;

/** Pages that the memory can grow to where that can be had: all that 32 bits address. */
const MAX_MEMORY_PAGES = 65536;

/** Milliseconds for which the solver lets others have its core while it waits for helpers. */
const PAUSE_MS = 0.05;

/**
 * Starts this worker's solver in a memory of its own that can be shared.
 * @param {number} helpers
 * @returns {Promise<HelperStart[]>} what each helper needs to start
 */
export async function startSharedSolver(helpers) {
  const module = await compile(new URL('./threads/threads_bg.wasm', import.meta.url));
  const memory = sharedMemory(MAX_MEMORY_PAGES);
  const exports = glue.initSync({ module, memory });
  const words = new Int32Array(memory.buffer);
  /** @type {Uint32Array} */
  const [jobs, crashes] = glue.leadTeam(
    (/** @type {number} */ count) => Atomics.notify(words, jobs / 4, count),
    () => Atomics.wait(words, crashes / 4, 0, PAUSE_MS),
  );
  const starts = Array.from({ length: helpers }, () => ({ module, memory, stack: glue.helperStack(), jobs, crashes }));
  // What fails before leaves the solver for one thread in place.
  solver.take(glue, exports);
  return starts;
}

/**
 * A shared memory that can grow to a number of pages, or to a half, a fourth and so on where so much cannot be reserved.
 * @param {number} maximum
 * @returns {WebAssembly.Memory}
 */
function sharedMemory(maximum) {
  try {
    return new WebAssembly.Memory({ initial: INITIAL_MEMORY_PAGES, maximum, shared: true });
  } catch (error) {
    if (maximum / 2 < MIN_MAX_MEMORY_PAGES) throw error;
    return sharedMemory(maximum / 2);
  }
}

/**
 * Makes this worker a helper, for the rest of its life.
 * @param {HelperStart} start
 */
export function becomeHelper(start) {
  const { module, memory, stack, jobs } = start;
  const { exports } = new WebAssembly.Instance(module, helperImports(module, memory));
  const { __stack_pointer, join_team, help } = /** @type {HelperExports} */ (/** @type {unknown} */ (exports));
  const words = new Int32Array(memory.buffer);
  __stack_pointer.value = stack;
  join_team();
  // The answer leaves first.
  setTimeout(() => {
    try {
      for (;;) Atomics.wait(words, jobs / 4, help(stack));
    } catch (error) {
      reportCrash(start);
      throw error;
    }
  });
}

/** @typedef {{ __stack_pointer: WebAssembly.Global<'i32'>, join_team: () => void, help: (stack: number) => number }} HelperExports */

/**
 * The module's imports for a helper, which calls no JavaScript: a call is a panic's.
 * @param {WebAssembly.Module} module
 * @param {WebAssembly.Memory} memory
 */
function helperImports(module, memory) {
  /** @type {WebAssembly.Imports} */
  const imports = {};
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = kind === 'memory' ? memory : refuse;
  }
  return imports;
}

function refuse() {
  throw new Error('a helper of the solver has panicked');
}

/** A module that adds 1 to the first word of a shared memory, `m.m`, by its function `f`. */
const PROBE = Uint8Array.of(
  0, 97, 115, 109, 1, 0, 0, 0, // magic number and version
  1, 4, 1, 96, 0, 0, // a type: no parameters, no results
  2, 9, 1, 1, 109, 1, 109, 2, 3, 1, 1, // the memory: shared, one page
  3, 2, 1, 0, // a function
  7, 5, 1, 1, 102, 0, 0, // which is exported
  10, 13, 1, 11, 0, 65, 0, 65, 1, 254, 30, 2, 0, 26, 11, // i32.const 0, i32.const 1, i32.atomic.rmw.add, drop
);

/**
 * Adds 1 to the first word of a memory of one page, in wasm.
 * @param {WebAssembly.Memory} memory
 */
export function countIn(memory) {
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(PROBE), { m: { m: memory } });
  /** @type {() => void} */ (exports.f)();
}
