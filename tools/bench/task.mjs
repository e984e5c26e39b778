/**
 * What is to be measured and what was, for the native program (`benches/src/task.rs`) and the wasm
 * alike.
 *
 * @typedef {object} Input an NPY file, so that both get the same bits
 * @property {string} file
 * @property {string} name
 * @property {'hex' | 'square'} lattice
 * @property {number} spacing
 * @property {number | null} noData
 * @property {boolean} normalize whether its coordinates are to be scaled to the unit square
 *
 * @typedef {object} Settings the package's `SolverOptions`, all of them given
 * @property {number} lambda
 * @property {'default' | 'paper'} schedule
 * @property {number} gap
 * @property {number} maxIterations
 * @property {boolean} normalize
 *
 * @typedef {'library' | 'cholesky' | 'conic'} Method
 *
 * @typedef {object} Task
 * @property {Method} method
 * @property {Input} input
 * @property {Settings} options
 * @property {Settings} [from] solve with these first, which is not measured, and go on from there
 *
 * @typedef {object} Measurement
 * @property {number} vertices
 * @property {number} seconds
 * @property {number} objective
 * @property {number | null} dualBound certified lower bound of the optimum, from who gives one
 * @property {number} iterations
 * @property {number} finest iterations on the input's own lattice
 * @property {number} bytes natively: most heap in use beyond the input; in wasm: its whole memory
 * @property {number} [copies] bytes of the arrays that go into the wasm and come out of it
 * @property {string} stop
 */

/** Solves that are measured at least, unless they take long. */
const RUNS = 3;
/** Seconds that all of them together take at least, and after which there are no more. */
const SHORT = 1;
const LONG = 6;

/**
 * The fastest of several solves.
 * @param {() => Measurement} solve
 */
export function fastest(solve) {
  let best = solve();
  for (let runs = 1, spent = best.seconds; spent < LONG && (runs < RUNS || spent < SHORT); runs++) {
    const next = solve();
    spent += next.seconds;
    if (next.seconds < best.seconds) best = next;
  }
  return best;
}

export const rule = `the fastest of ${RUNS} solves, or of as many as take a second together; `
  + `after ${LONG} seconds there are no more`;

/**
 * The package's options of a solve with the paper's energy, on the input's own vertices. The paper's schedule stops on its
 * residuals, not on a gap.
 * @param {Settings} settings
 */
export function optionsOf({ schedule, gap, ...settings }) {
  return { paper: true, bridge: false, ...settings, ...(schedule === 'paper' ? { schedule } : { gap }) };
}

/**
 * Certified relative gap.
 * @param {Measurement} measurement
 */
export function gap({ objective, dualBound }) {
  return dualBound === null ? NaN : Math.max(0, (objective - dualBound) / objective);
}
