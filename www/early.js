/** Fetches the solver beside the page's own modules, not after them, where the address asks for a solve. */

const asked = new URLSearchParams(location.hash.slice(1));
/** Whether the address leads to a surface, not to the doors or a page, and whether its heights are solved. */
export const isScene = location.hash.length > 1 && !asked.has('photo');
export const isSolved = isScene && !asked.has('whole');

/** @type {Promise<WebAssembly.Module> | null} */
let solver = null;

/** The compiled solver, which all workers for solves share. */
export function compiledSolver() {
  const url = new URL('./pkg/wasm/solver_bg.wasm', import.meta.url);
  // Streaming insists on the media type, which not every server sends.
  const compile = () => WebAssembly.compileStreaming(fetch(url)).catch(async () => WebAssembly.compile(await (await fetch(url)).arrayBuffer()));
  solver ??= compile();
  // Whoever awaits it reports the error, and the next worker tries again.
  solver.catch(() => (solver = null));
  return solver;
}

// The page itself says what a browser lacks.
if (isSolved && typeof WebAssembly === 'object') void compiledSolver();
