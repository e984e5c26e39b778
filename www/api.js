/** How the package is loaded. */
import { compiledSolver } from './early.js';

/** @typedef {typeof import('../pkg/index.js')} Package */
/** @typedef {Package & { SolverWorker: new (options?: { threads?: number }) => InstanceType<Package['DevelopableWorker']> }} Api `SolverWorker`: a worker for solves */

/**
 * Loads the package. The import is dynamic, so that the page can report an error of a browser that cannot load it.
 * @returns {Promise<Api>}
 */
export async function connect() {
  if (typeof WebAssembly !== 'object') throw new Error('this browser has no WebAssembly');
  if (typeof Worker !== 'function') throw new Error('this browser has no web workers');
  /** @type {Package} */
  const api = await import(new URL('./pkg/index.js', import.meta.url).href);
  return { ...api, SolverWorker: class extends api.DevelopableWorker { constructor(options = {}) { super({ ...options, wasm: compiledSolver() }); } } };
}
