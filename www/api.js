/** The package's types, and how it is loaded. No other module knows that it lies in `pkg/`. */

/** @typedef {typeof import('../pkg/index.js')} Package */
/** @typedef {Package & { SolverWorker: new (options?: { threads?: number }) => InstanceType<Package['DevelopableWorker']> }} Api `SolverWorker`: a worker for solves */
/** @typedef {import('../pkg/types.js').DepthOptions} DepthOptions */
/** @typedef {import('../pkg/types.js').Energy} Energy */
/** @typedef {import('../pkg/types.js').ExampleName} ExampleName */
/** @typedef {import('../pkg/types.js').ExampleOptions} ExampleOptions */
/** @typedef {import('../pkg/types.js').Heightfield} Heightfield */
/** @typedef {import('../pkg/index.js').OpenSolver} OpenSolver */
/** @typedef {import('../pkg/types.js').Progress} Progress */
/** @typedef {import('../pkg/types.js').PageReport} PageReport */
/** @typedef {import('../pkg/types.js').PhotoCamera} PhotoCamera */
/** @typedef {import('../pkg/types.js').Report} Report */
/** @typedef {import('../pkg/types.js').Ruling} Ruling */
/** @typedef {import('../pkg/types.js').StopReason} StopReason */
/** @typedef {import('../pkg/types.js').Surface} Surface */
/** @typedef {import('../pkg/types.js').Verdict} Verdict */
/** @typedef {import('../pkg/types.js').Mesh} Mesh */
/** @typedef {import('../pkg/types.js').SampledMesh} SampledMesh */
/** @typedef {import('../pkg/types.js').SampleMeshOptions} SampleMeshOptions */

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
