/**
 * Patterns of one input at several λ and sizes of patches, to choose from. What is tried, and in which order, Rust's `Trials`
 * says; the loop is here, since solves and patterns run in two wasm files, and plans are told and broken off between them.
 */
import { DevelopableError } from './errors.js';
import { optionsOf } from './options.js';

/**
 * @typedef {import('./types.js').PatternPlan} PatternPlan
 * @typedef {import('./types.js').ExploredPatterns} ExploredPatterns
 * @typedef {import('./types.js').Mesh} Mesh
 * @typedef {Pick<import('./index.js').DevelopableWorker, 'open' | 'analyze' | 'pattern' | 'fitMesh'>} Worker
 * @typedef {typeof import('./service.js').service['trials']} Trials
 */

/**
 * A surface, how far it is from the input, and the seconds that took.
 * @template S
 * @typedef {{ surface: S, distance: number, seconds: number }} Solved
 */

/**
 * @param {Worker} worker
 * @param {Trials} trials
 * @param {import('./types.js').HeightImage | import('./types.js').Heightfield} input
 * @param {import('./index.js').ExplorePatternOptions} [given]
 */
export async function explored(worker, trials, input, given) {
  const { lambdas, smallest, solver = {}, pattern = {}, ...choice } = optionsOf('explorePattern', given);
  const { signal } = choice;
  const { spacing } = solver;
  signal?.throwIfAborted();
  const open = await worker.open(input);
  const fitAt = async (/** @type {number} */ lambda) => {
    const begun = performance.now();
    // The nuclear norm makes few large sheets.
    const surface = await open.fit({ paper: true, ...solver, lambda, signal });
    const { deviation } = await worker.analyze(surface, { reference: input, ...(spacing !== undefined && { spacing }) });
    return { surface, distance: deviation?.rms ?? NaN, seconds: (performance.now() - begun) / 1000 };
  };
  try {
    return await tryPlans(await trials({ lambdas, smallest }), choice, fitAt, (surface, smallest) => worker.pattern(surface, { faces: 0, ...pattern, smallest }));
  } finally {
    open.dispose();
  }
}

/**
 * @param {Worker} worker
 * @param {Trials} trials
 * @param {Mesh} mesh
 * @param {import('./index.js').ExplorePatternMeshOptions} [given]
 */
export async function exploredMesh(worker, trials, mesh, given) {
  const { lambdas, smallest, solver = {}, pattern = {}, ...choice } = optionsOf('explorePatternMesh', given);
  const { signal } = choice;
  signal?.throwIfAborted();
  const own = lambdas === undefined ? await worker.fitMesh(mesh, { ...solver, signal }) : undefined;
  const all = await trials({ lambdas, smallest, meshLambda: own?.report.lambda });
  const fitAt = async (/** @type {number} */ lambda) => {
    const surface = lambda === own?.report.lambda ? own : await worker.fitMesh(mesh, { ...solver, lambda, signal });
    return { surface, distance: displacement(mesh, surface), seconds: surface.report.seconds.total };
  };
  return tryPlans(all, choice, fitAt, (surface, smallest) => worker.pattern(surface, { faces: 0, ...pattern, smallest }));
}

/**
 * How far vertices are from where they were: root of the mean square.
 * @param {Mesh} mesh
 * @param {Mesh} surface
 */
function displacement({ positions: from }, { positions: to }) {
  const squares = to.reduce((sum, x, k) => sum + (x - from[k]) ** 2, 0);
  return Math.sqrt((3 * squares) / to.length);
}

/**
 * The plans, or those up to the first one with few enough sheets.
 * @template S
 * @param {Awaited<ReturnType<Trials>>} trials
 * @param {Pick<import('./index.js').ExplorePatternOptions, 'sheets' | 'signal' | 'onPlan'>} choice
 * @param {(lambda: number) => Promise<Solved<S>>} fitAt
 * @param {(surface: S, smallest: number) => Promise<import('./types.js').Drawing>} patternOf
 * @returns {Promise<ExploredPatterns>}
 */
async function tryPlans({ lambdas, smallest }, { sheets = Infinity, signal, onPlan }, fitAt, patternOf) {
  /** @type {PatternPlan[]} */
  const plans = [];
  for (const lambda of lambdas) {
    const { surface, distance, seconds: fitting } = await fitAt(lambda);
    for (const share of smallest) {
      signal?.throwIfAborted();
      const started = performance.now();
      const found = await patternOrProblem(patternOf(surface, share));
      const seconds = fitting + (performance.now() - started) / 1000;
      const plan = { lambda, smallest: share, distance, seconds, ...found };
      plans.push(plan);
      await onPlan?.(plan);
      if (sheets < Infinity && plan.drawing !== undefined && plan.drawing.sheets.length <= sheets) return { plans, chosen: plan };
    }
  }
  return { plans };
}

/**
 * A pattern, or why there is none.
 * @param {Promise<import('./types.js').Drawing>} pattern
 */
async function patternOrProblem(pattern) {
  try {
    return { drawing: await pattern };
  } catch (error) {
    if (error instanceof DevelopableError && error.code === 'NOT_FLAT') return { problem: error.message };
    throw error;
  }
}
