/**
 * The state of the page, without its elements: one input, its settings, at most one run, and the last result.
 *
 * Two rules hold. The newest request wins: a second run, or another input, aborts the run before it. Once an input has
 * been solved, every change of a setting solves it again, so that the result always belongs to the settings shown.
 * Until a result is ready, and while a slider is dragged, `preview.js` shows approximate results.
 */
import { Events } from './events.js';
import { isPreviewed, PreviewSolver } from './preview.js';
import { gridOf } from './surface/lattice.js';
import { callWorker, startWorker } from './surface/worker-client.js';
import { WORKER_IDLE_MS } from './worker-task.js';

/** @import {Preview} from './preview.js' */
/** @import {Heightfield, SampledMesh, Surface} from '../pkg/types.js' */
/** @import {OpenSolver} from '../pkg/index.js' */

/**
 * @typedef {object} Input
 * @property {string} name its title, and the first part of the names of saved files
 * @property {number} width pixels
 * @property {number} height pixels
 * @property {Float64Array} data heights in steps of `heightScale`, row by row; NaN is no data
 * @property {number} pixelSize
 * @property {number} heightScale
 * @property {string} [unit] unit of lengths, if known
 * @property {import('../pkg/types.js').Georeference} [georeference] of the pixels
 * @property {Heightfield & Partial<SampledMesh> & { heights: Float64Array }} [lattice] solved instead of the pixels, which then only display it
 * @property {{ file: File, names: readonly string[], name: string }} [array] the array that is open, for a file with several
 * @property {{ mesh: Mesh, options: SampleMeshOptions }} [sampling] for heights that were sampled from a mesh
 * @property {Float64Array} [truth] the surface without noise, if known
 * @property {string} [kind] kind of file, in words; an example has none
 * @property {string} [file] name of the file of heights
 * @property {{ size: number, noise: number }} [example] options of the package's example
 * @property {string} [dataType] number type of the file, such as `u16`
 * @property {readonly import('../pkg/types.js').Assumption[]} [assumptions] what the reader of the file has assumed
 * @property {'likely' | 'certain'} [depths] whether the values are depths from a camera
 * @property {'mm' | 'm'} [depthUnit] unit of the values, if they are depths from a camera
 * @property {import('./import-interpretation.js').StoredHeights} [stored] contents of the file, and how they are interpreted
 * @property {{ name: string, image: ImageData }} [photo] photo that was opened together with it
 * @property {Input} [depthSource] depths from which the mesh was built
 */

/**
 * @typedef {object} Settings
 * @property {number | 'auto'} lambda
 * @property {number} gap duality gap at which the solve stops
 * @property {number} coarsening lattice spacing in pixels
 * @property {Energy} energy
 * @property {number} [occlusionThreshold] without it, the surface is torn nowhere
 */

/** @typedef {{ width: number, height: number, pixelSize: number, data: Float64Array }} Image */
/** @typedef {{ before: number, after: number }} Accuracy errors of the heights of input and result, root mean square */
/** @typedef {{ input: Input, settings: Settings, surface: Surface, image: Image, accuracy: Accuracy | null }} Result `image`: heights at the input's pixels; `accuracy`: errors, where the truth is known */
/** @typedef {'starting' | 'idle' | 'running' | 'failed'} Phase */

/**
 * @typedef {object} SessionEvents
 * @property {Input} input another input was opened, or the present one was interpreted in another way
 * @property {Settings} settings the settings have changed
 * @property {Settings} start a run has begun
 * @property {Progress} progress
 * @property {Preview} preview approximate result on a coarser lattice
 * @property {Result} result
 * @property {null} cleared the last result was discarded because another input was opened
 * @property {Phase} phase
 * @property {Task | null} opening an input is being opened, by this task; null when that has ended
 * @property {null} unsolved a run has ended without a result
 * @property {{ doing: string, error: unknown }} failure
 */

/** Minimum number of pixels of a large input, whose solver holds so much memory that it is disposed of when idle. */
const MIN_LARGE_INPUT_PIXELS = 500 ** 2;
/** Time that a cancelled run of a large input has to return its best surface, in milliseconds. */
const CANCEL_TIMEOUT_MS = 150;
/** @extends {Events<SessionEvents>} */
export class Session extends Events {
  /** @type {Readonly<Settings>} */
  defaults = { lambda: 'auto', gap: 0.01, coarsening: 1, energy: 'huber', occlusionThreshold: undefined };
  /** @type {Settings} */
  settings = { ...this.defaults };
  /** @type {Input | null} */
  input = null;
  /** @type {Result | null} */
  result = null;
  /** @type {Phase} */
  phase = 'starting';

  /** The present run; `finest`: it has reached the finest lattice. @type {{ abort: AbortController, input: Input, settings: Settings, finest: boolean } | null} */
  #job = null;
  /** Whether a change is being previewed and its run has not begun yet. */
  #runPending = false;
  #previews;
  /** The solver of an input, in a worker of its own; it starts warm from its last result. @type {{ input: Input, solver: Promise<OpenSolver> } | null} */
  #openSolver = null;
  /** @type {InstanceType<Api['DevelopableWorker']> | null} */
  #worker = null;
  /** Timer that disposes of an idle worker. */
  #idleTimer = 0;
  /** Cancels the file that is being opened. @type {AbortController | null} */
  #opening = null;
  /** Whether the present input has been solved, or is being solved: changes of settings then start a run. */
  #runRequested = false;
  /** Whether changes of settings start a run now. */
  #autoRun = true;

  /** @param {Api} api */
  constructor(api) {
    super();
    this.api = api;
    this.#previews = new PreviewSolver(api, {
      onPreview: (preview) => {
        if (this.phase === 'running') this.emit('preview', preview);
      },
      onFinished: () => {
        if (this.#runPending) void this.run();
      },
    });
  }

  /** Starts the workers before there is an input. @throws if the solver cannot be started */
  async start() {
    const solver = this.#connectedWorker().init();
    this.#previews.start();
    // An error occurs again, and is reported, where the worker is needed.
    startWorker().catch(() => {});
    await solver;
  }

  /** Says that the solver waits for an input. */
  wait() {
    if (this.phase === 'starting') this.#setPhase('idle');
  }

  /**
   * An example of the package as an input. The solver's worker makes it, unless that worker is busy or about to be disposed of.
   * @param {ExampleName} name
   * @param {{ size: number, noise: number }} options
   * @returns {Promise<Input>}
   */
  async example(name, options) {
    const isFree = !this.#job && !(this.#openSolver && isLarge(this.#openSolver.input));
    const { input, truth } = await (isFree ? this.#connectedWorker() : this.api).example(name, options);
    const { width, height, data, pixelSize = 1, heightScale = 1 } = input;
    return { name, width, height, data, pixelSize, heightScale, truth, example: options };
  }

  /** @param {Phase} phase */
  #setPhase(phase) {
    if (this.phase === phase) return;
    this.phase = phase;
    this.emit('phase', phase);
  }

  /** Reports an error to all panels; the state of the session does not change. @param {string} doing what could not be done @param {unknown} error */
  fail(doing, error) {
    this.emit('failure', { doing, error });
  }

  /**
   * Loads another input and makes it the present one. If loading fails, the present input and its run stay.
   * @param {string} doing what could not be done, for the message if loading fails
   * @param {(signal: AbortSignal) => Promise<Input>} load `signal` aborts when another file is opened instead
   * @param {Task} task
   * @returns {Promise<boolean>} whether the input was opened
   */
  async open(doing, load, task) {
    const isOpened = await this.whileOpening(doing, task, async (signal) => {
      const input = await load(signal);
      if (signal.aborted) return;
      this.#stop();
      this.#disposeSolver();
      this.input = input;
      this.result = null;
      this.#runRequested = false;
      this.emit('input', input);
      this.emit('cleared', null);
      return true;
    });
    this.wait();
    return isOpened ?? false;
  }

  /**
   * Does a part of what opens an input.
   * @template T
   * @param {string} doing what could not be done, for the message if it fails
   * @param {Task} task
   * @param {(signal: AbortSignal) => Promise<T>} work `signal` aborts when something else is opened instead
   * @returns {Promise<T | null>} null if it has failed or was cancelled
   */
  async whileOpening(doing, task, work) {
    this.cancelOpening();
    const opening = (this.#opening = new AbortController());
    const { signal } = opening;
    this.emit('opening', task);
    try {
      // What cannot be stopped is not waited for.
      const answer = await Promise.race([work(signal), new Promise((_, reject) => signal.addEventListener('abort', reject))]);
      return signal.aborted ? null : answer;
    } catch (error) {
      if (!signal.aborted) this.fail(doing, error);
      return null;
    } finally {
      if (this.#opening === opening) this.cancelOpening();
    }
  }

  /** Whether an input is being opened. */
  get isOpening() {
    return this.#opening !== null;
  }

  /** Cancels the file that is being opened; the present input stays. */
  cancelOpening() {
    if (!this.#opening) return;
    this.#opening.abort();
    this.#opening = null;
    this.emit('opening', null);
  }

  /** Changes properties of the present input, and solves it again if it has been solved. @param {Partial<Omit<Input, 'name'>>} change */
  updateInput(change) {
    if (!this.input) return;
    const input = (this.input = { ...this.input, ...change });
    this.emit('input', input);
    if (this.#runRequested) void this.run();
  }

  /** Changes settings, and solves the input with them if it has been solved before. @param {Partial<Settings>} change */
  updateSettings(change) {
    this.settings = { ...this.settings, ...change };
    this.emit('settings', this.settings);
    if (!this.#runRequested || !this.#autoRun) return;
    // The present run may have these settings already, from a preview of them.
    if (this.#job?.input === this.input && isSame(this.#job.settings, this.settings)) this.#runPending = false;
    else void this.run();
  }

  /** Previews a λ while a slider is dragged, in place of the present run; the run follows once the finest preview is ready. @param {number} lambda */
  previewLambda(lambda) {
    const { input } = this;
    this.settings = { ...this.settings, lambda };
    if (!input || !this.#runRequested || !this.#autoRun) return;
    this.#abortRun();
    this.#runPending = true;
    if (this.phase !== 'running') this.emit('start', this.settings);
    this.#setPhase('running');
    this.#requestPreview(input, true);
  }

  /** Lets changes of settings start runs, or ends the run and defers others while a whole mesh is shown. @param {boolean} enabled */
  setAutoRun(enabled) {
    if (this.#autoRun === enabled) return;
    this.#autoRun = enabled;
    if (!enabled && this.phase === 'running') this.#endRun();
    const last = this.#job?.settings ?? this.result?.settings;
    if (enabled && this.#runRequested && last && !isSame(last, this.settings)) void this.run();
  }

  /** @param {Input} input @param {boolean} isFine whether pictures of finer lattices follow the first one */
  #requestPreview(input, isFine) {
    this.#previews.request(input, this.settings, isFine, this.result?.surface.report.lambda);
  }

  /** Solves the present input, warm-started from its last result if there is one; aborts the present run. */
  async run() {
    const { input, settings } = this;
    if (!input) return;
    const abort = new AbortController();
    const job = (this.#job = { abort, input, settings, finest: /** @type {boolean} */ (false) });
    this.#runRequested = true;
    this.#runPending = false;
    clearTimeout(this.#idleTimer);
    this.emit('start', settings);
    this.#setPhase('running');
    // A finer picture of a small input would come little before the result, and delay it.
    if (isPreviewed(input)) this.#requestPreview(input, isLarge(input));
    const { coarsening, ...options } = settings;
    try {
      // Copying a large input to the worker takes time: let the browser draw first. Others are solved while the scene is made.
      if (isLarge(input) && this.#openSolver?.input !== input) await new Promise((resolve) => setTimeout(resolve));
      if (this.#job !== job) return;
      const solver = await this.#solverFor(input);
      if (this.#job !== job) return;
      const surface = await solver.fit({
        ...options,
        ...spacingOf(input, coarsening),
        signal: abort.signal,
        onAbort: 'keep',
        onProgress: (progress) => {
          job.finest = progress.level === 0;
          if (this.#job === job && !abort.signal.aborted) this.emit('progress', progress);
        },
      });
      const result = { input, settings, surface, ...await derivedOf(input, surface) };
      if (this.#job !== job) return;
      this.#previews.cancel();
      this.result = result;
      this.emit('result', result);
    } catch (error) {
      if (this.#job !== job) return;
      this.#disposeSolver();
      this.#endRun();
      this.fail('This could not be solved', error);
    } finally {
      if (this.#job === job) {
        this.#job = null;
        this.#disposeWhenIdle(input);
        this.#setPhase('idle');
      }
    }
  }

  /** The solver of an input. After a change of the input it starts warm from the last result. @param {Input} input @returns {Promise<OpenSolver>} */
  #solverFor(input) {
    const present = this.#openSolver;
    if (present?.input === input) return present.solver;
    const solver = present
      ? present.solver.then(async (open) => {
          await open.replace(heightsOf(input));
          return open;
        })
      : this.#workerFor(input).open(heightsOf(input));
    this.#openSolver = { input, solver };
    return solver;
  }

  /** The worker for solves of an input. A large one is solved on all cores but the page's own where workers may share memory. @param {Input} input */
  #workerFor(input) {
    if (!isLarge(input) || !crossOriginIsolated) return this.#connectedWorker();
    this.#worker?.dispose();
    return (this.#worker = new this.api.SolverWorker({ threads: Math.max(1, navigator.hardwareConcurrency - 1) }));
  }

  #connectedWorker() {
    return this.#worker?.connected ? this.#worker : (this.#worker = new this.api.SolverWorker());
  }

  /** Frees the memory of a large input's solver after it has been idle for a while. @param {Input} input */
  #disposeWhenIdle(input) {
    if (isLarge(input)) this.#idleTimer = window.setTimeout(() => this.#disposeWorker(), WORKER_IDLE_MS);
  }

  /** Disposes of the solver: the next run has no warm start. */
  #disposeSolver() {
    clearTimeout(this.#idleTimer);
    if (this.#openSolver && isLarge(this.#openSolver.input)) this.#disposeWorker();
    this.#openSolver?.solver.then((solver) => solver.dispose(), () => {});
    this.#openSolver = null;
  }

  /** Ends the worker: its memory is not freed in any other way. */
  #disposeWorker() {
    this.#openSolver = null;
    this.#worker?.dispose();
    this.#worker = null;
  }

  /** Cancels the run; its best surface so far becomes the result, if the solver returns it soon. */
  cancel() {
    this.#runPending = false;
    this.#previews.cancel();
    const job = this.#job;
    if (job) {
      job.abort.abort();
      // On a coarser lattice the best surface is no better than a preview, and certifying it takes long.
      if (isLarge(job.input) && !job.finest) setTimeout(() => this.#job === job && (this.#disposeWorker(), this.#endRun()), CANCEL_TIMEOUT_MS);
    } else if (this.phase === 'running') {
      // The phase is `running` because of previews; the run itself has not begun.
      this.#endRun();
    }
  }

  /** Aborts the run; its result is discarded. */
  #abortRun() {
    const job = this.#job;
    this.#job = null;
    job?.abort.abort();
  }

  /** Ends the run without a result. */
  #endRun() {
    this.#stop();
    this.emit('unsolved', null);
  }

  /** Aborts the run and the previews, and cancels a pending run. */
  #stop() {
    this.#abortRun();
    this.#runPending = false;
    this.#previews.cancel();
    if (this.phase === 'running') this.#setPhase('idle');
  }
}

/** @param {Settings} a @param {Settings} b */
function isSame(a, b) {
  return Object.entries({ ...a, ...b }).every(([name, value]) => a[/** @type {keyof Settings} */ (name)] === value);
}

/** @param {Input} input */
function isLarge({ width, height }) {
  return width * height >= MIN_LARGE_INPUT_PIXELS;
}

/** The lattice spacing of a solve, as an option of the package; an input that is a lattice already has one. @param {Input} input @param {number} coarsening */
export function spacingOf({ pixelSize, lattice }, coarsening) {
  return lattice ? {} : { spacing: coarsening * pixelSize };
}

/** Converts an input to a height image or heightfield of the package. @param {Input} input */
export function heightsOf({ width, height, data, pixelSize, heightScale, georeference, lattice }) {
  return lattice ?? { width, height, pixelSize, heightScale, georeference, data };
}

/**
 * The image of a surface at the input's pixels, or at those that show the input's lattice, and the errors against the truth, if that is known.
 * @param {Input} input
 * @param {Surface} surface
 * @returns {Promise<{ image: Image, accuracy: Accuracy | null }>}
 */
async function derivedOf(input, { image: given, rows, cols, spacing, origin, heights }) {
  const { truth, heightScale } = input;
  const grid = gridOf(input);
  const image = given ?? { width: grid.width, height: grid.height, pixelSize: grid.pixelSize, data: await callWorker('interpolateToGrid', { rows, cols, spacing, origin }, heights, grid) };
  if (!truth) return { image, accuracy: null };
  const [before, after] = await Promise.all([callWorker('rmsError', input.data, heightScale, truth, heightScale), callWorker('rmsError', image.data, 1, truth, heightScale)]);
  return { image, accuracy: { before, after } };
}
