/** What the worker offers its client: the direct API, with solves as jobs. Arrays are handed over. */
import * as direct from './direct.js';
import { DevelopableError } from './errors.js';
import { Job } from './job.js';
import { transfer } from './wire.js';

/** @type {Map<number, Job>} */
const jobs = new Map();

export const service = {
  init: direct.init,

  /**
   * Begins a solve under a number of the client's choice, by which it can be stopped at any time.
   * @param {number} id
   * @param {import('./input.js').Image | import('./input.js').Lattice} input
   * @param {import('./types.js').SolverOptions} options
   * @param {number} interval milliseconds between two pieces of news, at least
   */
  start(id, input, options, interval) {
    jobs.set(id, new Job(new direct.Solver(input, options), interval));
  },

  /**
   * Resolves when there is news of the solve: progress, or progress and the surface.
   * @param {number} id
   */
  async next(id) {
    const job = jobs.get(id);
    if (!job) throw new DevelopableError('DISPOSED', 'there is no such solve');
    const news = await job.next();
    const { surface } = news;
    if (!surface) return news;
    jobs.delete(id);
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

  /** @type {typeof direct.read} */
  read(bytes, options) {
    const result = direct.read(bytes, options);
    return transfer(result, buffersOf(result.data));
  },

  /** @type {typeof direct.writeNpy} */
  writeNpy: (input) => handOver(direct.writeNpy(input)),
  /** @type {typeof direct.writePng} */
  writePng: (input) => handOver(direct.writePng(input)),
  /** @type {typeof direct.writeObj} */
  writeObj: (input) => handOver(direct.writeObj(input)),

  /** @type {typeof direct.example} */
  example(name, options) {
    const result = direct.example(name, options);
    return transfer(result, buffersOf(result.input.data, result.truth));
  },
};

/** @param {Uint8Array<ArrayBuffer>} bytes */
const handOver = (bytes) => transfer(bytes, buffersOf(bytes));

/** @param {((Float64Array | Uint8Array) | undefined)[]} arrays */
function buffersOf(...arrays) {
  return arrays.flatMap((array) => (array?.buffer instanceof ArrayBuffer ? [array.buffer] : []));
}
