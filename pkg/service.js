/** What the worker offers its client: the direct API, with solves as jobs. Arrays are handed over. */
import * as direct from './direct.js';
import { CALLS, forPictures } from './calls.js';
import { takeCopiesFrom } from './copies.js';
import { DevelopableError } from './errors.js';
import { patterns, solver } from './instances.js';
import { Job } from './job.js';
import { WarmSolver } from './warm-solver.js';
import { paintOf } from './paint.js';
import { becomeHelper, countIn, startSharedSolver } from './shared-solver.js';
import { transfer, wrap } from './wire.js';

/** @type {Map<number, Job>} */
const jobs = new Map();

/** @type {Map<number, WarmSolver>} */
const openSolvers = new Map();

/** @typedef {import('./input.js').Image | import('./input.js').Lattice} Input */

/** @typedef {import('./types.js').InitInput | undefined} Place */

/** @typedef {import('./direct.js').PartName} PartName */

/** Where the wasm files are, each loaded when it is needed. @type {Partial<Record<import('./calls.js').Part, Place>>} */
let places = {};

/** Why solves do not run on more threads, where `init` was asked for some. @type {import('./team.js').ThreadLimit | undefined} */
let threadLimit;

export const service = {
  /**
   * @param {Place[]} sources of the solver's wasm, the files', the images', the meshes', of fits to meshes, the unrolling's and the patterns'
   * @param {MessagePort} [copies] where to get copies of them, where nothing lies beside this script
   * @param {number} [helpers] number of workers that are to help the solver
   * @returns {Promise<import('./helper-start.js').HelperStart[] | undefined>} what each helper needs to start; nothing where the solver takes none
   */
  async init([wasm, files, images, meshes, fitmesh, unroll, patterns], copies, helpers = 0) {
    if (copies) {
      /** @type {import('./vendor/comlink.mjs').Remote<typeof import('./copies.js').wasmCopy>} */
      const ask = wrap(copies);
      takeCopiesFrom((name) => ask(name));
    }
    places = { solver: wasm, files, images, meshes, fitmesh, unroll, patterns };
    return helpers > 0 ? startSharedSolver(helpers).catch(() => undefined) : undefined;
  },

  /** Loads the solver, for those who want to wait for it before their first call. */
  loadSolver: () => loaded(['solver']),

  countIn,
  becomeHelper,

  /** @param {import('./team.js').ThreadLimit} limit */
  setThreadLimit(limit) {
    threadLimit = limit;
  },

  /**
   * Rejects options that no solve would take: asked before the caller's arrays are handed over.
   * @param {import('./types.js').SolverOptions} options
   */
  async check(options) {
    await loaded(['solver']);
    solver.call(({ checkOptions }) => checkOptions(options));
  },

  /**
   * Begins a solve under a number of the client's choice, by which it can be stopped at any time.
   * @param {number} id
   * @param {Input | import('./types.js').Mesh} input
   * @param {import('./types.js').SolverOptions | import('./types.js').MeshSolverOptions} options
   * @param {number} interval milliseconds between two pieces of news, at least
   */
  start(id, input, options, interval) {
    const begin = async () => {
      const isWhole = 'positions' in input;
      await loaded([isWhole ? 'fitmesh' : 'solver']);
      return isWhole ? new direct.MeshSolver(input, options) : new direct.Solver(input, options);
    };
    jobs.set(id, new Job(begin, interval));
  },

  /**
   * Keeps a solver under a number of the client's choice.
   * @param {number} solver
   * @param {Input} input
   */
  open(solver, input) {
    openSolvers.set(solver, new WarmSolver(input, () => loaded(['solver'])));
  },

  /**
   * Begins a solve, as `start` does, with a solver that is kept.
   * @param {number} solver
   * @param {number} id
   * @param {import('./types.js').SolverOptions} options
   * @param {number} interval
   */
  startOpen(solver, id, options, interval) {
    jobs.set(id, openSolver(solver).start(options, interval));
  },

  /**
   * @param {number} solver
   * @param {Input} input
   */
  replace(solver, input) {
    openSolver(solver).replace(input);
  },

  /**
   * Gives a kept solver up; harmless when there is none.
   * @param {number} solver
   */
  close(solver) {
    openSolvers.get(solver)?.dispose();
    openSolvers.delete(solver);
  },

  /**
   * Resolves when there is news of the solve: progress, or progress and the surface.
   * @param {number} id
   */
  async next(id) {
    const job = jobs.get(id);
    if (!job) throw new DevelopableError('DISPOSED', 'there is no such solve');
    const news = await job.next().catch((error) => {
      jobs.delete(id);
      throw error;
    });
    const { surface } = news;
    if (!surface) return news;
    jobs.delete(id);
    if ('positions' in surface) return transfer(news, buffersOf(surface.positions));
    // The solver itself knows only the threads that it has.
    const { report } = surface;
    if (threadLimit && ['build', 'cores'].includes(report.threadLimit)) report.threadLimit = threadLimit;
    return transfer(news, buffersOf(surface.heights, surface.image?.data));
  },

  /**
   * Stops a solve; harmless when there is none.
   * @param {number} id
   * @param {boolean} keep whether the best surface so far is wanted
   */
  stop(id, keep) {
    const job = jobs.get(id);
    if (keep) {
      job?.finish();
    } else {
      job?.drop();
      jobs.delete(id);
    }
  },

  /**
   * Answers one of `CALLS`.
   * @param {keyof typeof CALLS} name
   * @param {MessagePort | undefined} progress where to tell how far the call is, whose last argument is its options
   * @param {any[]} sent
   */
  async answer(name, progress, ...sent) {
    if (progress) sent.push({ ...sent.pop(), onProgress: (/** @type {import('./types.js').CallProgress} */ { fraction }) => progress.postMessage(fraction) });
    const { parts } = /** @type {import('./calls.js').Call} */ (CALLS[name]);
    await loaded(typeof parts === 'function' ? parts(...sent) : parts);
    const result = /** @type {(...args: any[]) => any} */ (direct[name])(...sent);
    return typeof result === 'object' ? transfer(result, [...buffersIn(result)]) : result;
  },

  /**
   * The λ and sizes of patches of an exploration, in the order in which they are tried.
   * @param {{ lambdas?: readonly number[], smallest?: readonly number[], meshLambda?: number }} given
   * @returns {Promise<{ lambdas: number[], smallest: number[] }>}
   */
  async trials(given) {
    await loaded(['patterns']);
    return patterns.call((wasm) => wasm.trials(given));
  },

  /** @type {(input: Input, picture: import('./types.js').Picture, options?: import('./types.js').PaintOptions) => Promise<ReturnType<typeof paintOf>>} */
  async paint(input, picture, options) {
    const seen = /** @type {import('./types.js').Heightfield} */ (input).camera ?? options?.camera;
    await loaded([...forPictures([picture]), ...(seen ? [/** @type {const} */ ('meshes')] : [])]);
    const painted = paintOf(/** @type {import('./types.js').Heightfield} */ (input), picture, options);
    return transfer(painted, buffersOf(painted.uvs, painted.colors));
  },
};

/** @param {number} solver */
function openSolver(solver) {
  const found = openSolvers.get(solver);
  if (!found) throw new DevelopableError('DISPOSED', 'there is no such solver');
  return found;
}

/** Loads wasm files that are not loaded yet. @param {readonly import('./calls.js').Part[]} parts */
async function loaded(parts) {
  await Promise.all(parts.map((part) => (part === 'solver' ? direct.init(places.solver) : direct.load({ [part]: places[part] }))));
}

/**
 * The buffers of a result's arrays, which go to the client: of its own properties, and of the plain objects among them.
 * @param {unknown} value
 * @param {Set<ArrayBuffer>} [found]
 */
function buffersIn(value, found = new Set()) {
  if (ArrayBuffer.isView(value)) {
    if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
  } else if (Object.getPrototypeOf(Object(value)) === Object.prototype) {
    for (const part of Object.values(Object(value))) buffersIn(part, found);
  }
  return found;
}

/** @param {(ArrayBufferView | undefined)[]} arrays */
function buffersOf(...arrays) {
  return arrays.flatMap((array) => (array?.buffer instanceof ArrayBuffer ? [array.buffer] : []));
}
