/** How the package is loaded. */

/** @typedef {typeof import('../pkg/index.js')} Package */
/** @typedef {Package & { SolverWorker: new (options?: { threads?: number }) => InstanceType<Package['DevelopableWorker']> }} Api `SolverWorker`: a worker for solves */

/**
 * Loads the package. Its workers for solves share one compiled solver, which the first of them loads. The import is dynamic, so
 * that the page can report an error of a browser that cannot load it.
 * @returns {Promise<Api>}
 */
export async function connect() {
  if (typeof WebAssembly !== 'object') throw new Error('this browser has no WebAssembly');
  if (typeof Worker !== 'function') throw new Error('this browser has no web workers');
  /** @type {Package} */
  const api = await import(new URL('./pkg/index.js', import.meta.url).href);
  /** @type {Promise<WebAssembly.Module> | null} */
  let wasm = null;
  const compiledSolver = () => {
    const solver = new URL('./pkg/wasm/solver_bg.wasm', import.meta.url);
    // Streaming insists on the media type, which not every server sends.
    wasm ??= WebAssembly.compileStreaming(fetch(solver)).catch(async () => WebAssembly.compile(await (await fetch(solver)).arrayBuffer()));
    // Whoever awaits it reports the error, and the next worker tries again.
    wasm.catch(() => (wasm = null));
    return wasm;
  };
  return { ...api, SolverWorker: class extends api.DevelopableWorker { constructor(options = {}) { super({ ...options, wasm: compiledSolver() }); } } };
}
