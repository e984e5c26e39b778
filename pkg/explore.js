/**
 * Patterns of one input at several λ and sizes of patches, to choose from. The loop is here and not in Rust's `explore`, which
 * goes by the same numbers in the same order: solves and patterns run in two wasm files, and plans are told and broken off
 * between them.
 */
import { DevelopableError } from './errors.js';
import { optionsOf } from './options.js';

/**
 * @typedef {import('./types.js').PatternPlan} PatternPlan
 * @typedef {import('./types.js').ExploredPatterns} ExploredPatterns
 * @typedef {Pick<import('./index.js').DevelopableWorker, 'open' | 'analyze' | 'pattern'>} Worker
 */

/** What is tried unless something else is said: half-decades of λ, and shares of all vertices. */
const LAMBDAS = [1e7, 3e6, 1e6, 3e5, 1e5, 3e4];
const SMALLEST = [0.005, 0.02, 0.08];

/**
 * From the surface that is nearest to the input to the plainest one, and with smaller patches before larger ones. So the
 * first plan with few enough sheets is the finest.
 * @param {Worker} worker
 * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
 * @param {import('./index.js').ExplorePatternOptions} [given]
 * @returns {Promise<ExploredPatterns>}
 */
export async function explored(worker, input, given) {
  const { lambdas = LAMBDAS, smallest = SMALLEST, sheets = Infinity, solver = {}, pattern = {}, signal, onPlan } = optionsOf('explorePattern', given);
  const { spacing } = solver;
  signal?.throwIfAborted();
  /** @type {PatternPlan[]} */
  const plans = [];
  const open = await worker.open(input);
  try {
    for (const lambda of [...lambdas].sort((a, b) => b - a)) {
      const begun = performance.now();
      const surface = await open.fit({ ...solver, lambda, signal });
      const { deviation } = await worker.analyze(surface, { reference: input, ...(spacing !== undefined && { spacing }) });
      const fitting = performance.now() - begun;
      for (const share of [...smallest].sort((a, b) => a - b)) {
        signal?.throwIfAborted();
        const started = performance.now();
        const found = await drawn(worker.pattern(surface, { ...pattern, smallest: share }));
        const seconds = (fitting + performance.now() - started) / 1000;
        const plan = { lambda, smallest: share, distance: deviation?.rms ?? NaN, seconds, ...found };
        plans.push(plan);
        onPlan?.(plan);
        if (sheets < Infinity && plan.drawing !== undefined && plan.drawing.sheets.length <= sheets) return { plans, chosen: plan };
      }
    }
  } finally {
    open.dispose();
  }
  return { plans };
}

/**
 * A pattern, or why there is none.
 * @param {Promise<import('./types.js').Drawing>} pattern
 */
async function drawn(pattern) {
  try {
    return { drawing: await pattern };
  } catch (error) {
    if (error instanceof DevelopableError && error.code === 'NOT_FLAT') return { problem: error.message };
    throw error;
  }
}
