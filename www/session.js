/**
 * What the page is about, without any of its elements: one input, its settings,
 * at most one run, and the last result.
 *
 * Two rules keep it simple. The newest wish wins: a second run, or another input,
 * ends the one before. And once an input has been run, every change of a setting
 * runs it again, so that what is seen is what is set. Until the answer is there, and while a setting is
 * still being chosen, previews show what it is about (`preview.js`).
 */
import { settingsFor } from './design.js';
import { breath } from './dom.js';
import { Events } from './events.js';
import { Live } from './preview.js';
import { lookAt, lookAtOnce, lookInto } from './surface/known.js';

/** @import {Design} from './design.js' */
/** @import {Preview} from './preview.js' */
/** @import {Api, DepthOptions, Energy, ExampleName, ExampleOptions, Heightfield, Mesh, OpenSolver, Occlusions, Progress, SampledMesh, SampleMeshOptions, Surface} from './api.js' */

/**
 * @typedef {object} Input
 * @property {string} name what to call it, and what saved files are named after
 * @property {number} width
 * @property {number} height
 * @property {Float64Array} data steps of height, row by row, NaN for no data
 * @property {boolean} [design] the data are constraints, and there is nothing else
 * @property {Float64Array | Float32Array} [confidence] how far each height is to be trusted
 * @property {Float64Array} [constraints] steps of height to be met exactly, NaN for none
 * @property {number} pixelSize
 * @property {number} heightScale
 * @property {string} [unit] of lengths, where it is known
 * @property {Heightfield & Partial<SampledMesh> & { heights: Float64Array }} [lattice] what is solved in the place of the pixels, which show it
 * @property {{ file: File, names: readonly string[], name: string }} [array] of a file with several
 * @property {{ mesh: Mesh, options: SampleMeshOptions, whole?: Mesh }} [seen] the mesh, what it is a part of, and how the
 *   lattice was taken from it
 * @property {Float64Array} [truth] the surface without noise, where it is known
 * @property {string} [kind] of file, in words; examples have none
 * @property {string} [dataType] what the file stores, such as `u16`
 * @property {'mm' | 'm'} [depths] that a camera has seen, and what they seem to be counted in
 * @property {import('./import-interpretation.js').Stored} [stored] what the file holds, and how it is understood
 * @property {{ name: string, image: ImageData }} [photo] that came with it
 * @property {Design} [drawn] what a design was made of
 * @property {Beside} [beside] what came with depths, besides
 * @property {Input} [depthSource] the depths that a mesh was built from
 * @property {string} [assumed] what was guessed of their camera
 */

/**
 * @typedef {object} Beside
 * @property {DepthOptions['confidence']} [confidence]
 * @property {DepthOptions['mask']} [mask]
 * @property {string[]} names of their files
 */

/**
 * @typedef {object} Settings
 * @property {number | 'auto'} lambda
 * @property {number} gap certified gap to stop at, of the default schedule
 * @property {'default' | 'paper'} schedule
 * @property {number} coarsening lattice spacing in pixels
 * @property {Energy} [energy] default: by the input
 * @property {number} reweighting passes
 * @property {number} [occlusionThreshold] none are looked for without it
 */

/** @typedef {{ input: Input, settings: Settings, surface: Surface }} Result */
/**
 * What may take long.
 * @typedef {object} Slow
 * @property {string} words what is done
 * @property {string} kind what takes as long as others of it
 * @property {number} size vertices, or bytes
 * @property {number} each milliseconds for one of these, until that was measured
 */
/** @typedef {'starting' | 'idle' | 'running' | 'failed'} Phase */

/**
 * @typedef {object} SessionEvents
 * @property {Input} input another input, or the same understood otherwise
 * @property {Settings} settings they have changed
 * @property {Settings} start a run has begun
 * @property {Progress} progress
 * @property {Preview} preview of the result to come, on a coarser lattice
 * @property {Result} result
 * @property {null} cleared the last result is gone, for another input is there
 * @property {Occlusions | null} occlusions where the present input is torn, if that was asked for
 * @property {Phase} phase
 * @property {Slow | null} opening something is being opened, or nothing is any more
 * @property {null} unsolved a run has ended with nothing
 * @property {{ doing: string, error: unknown }} failure
 */

/** Between two λ whose answers are hardly told apart. */
const CLOSE = 1.3;
/** Fewer pixels than this are solved in a moment. */
const MANY = 150 ** 2;
/** From so many pixels on, a solver that rests for so many milliseconds is given up. */
const LARGE = 500 ** 2;
const REST = 5000;
/** Milliseconds that a cancelled run of so many pixels has for its last surface. */
const SOON = 150;
/** @extends {Events<SessionEvents>} */
export class Session extends Events {
  /** @type {Readonly<Settings>} */
  defaults = { lambda: 'auto', gap: 0.01, schedule: 'default', coarsening: 1, energy: undefined, reweighting: 0, occlusionThreshold: undefined };
  /** @type {Settings} */
  settings = { ...this.defaults };
  /** @type {Input | null} */
  input = null;
  /** @type {Result | null} */
  result = null;
  /** @type {Phase} */
  phase = 'starting';

  /** The run under way, and whether it has come to the finest lattice. @type {{ abort: AbortController, input: Input, settings: Settings, finest: boolean } | null} */
  #job = null;
  /** Whether a setting is still being chosen. */
  #following = false;
  #live;
  /** The solver, which remembers its last answer, in a worker of its own. @type {{ input: Input, solver: Promise<OpenSolver> } | null} */
  #kept = null;
  /** @type {InstanceType<Api['DevelopableWorker']> | null} */
  #worker = null;
  #resting = 0;
  /** What is being opened. @type {AbortController | null} */
  #opening = null;
  /** Counts what was looked for in the input, likewise. */
  #looked = 0;
  /** Whether the present input has been run. */
  #tried = false;
  /** Whether heights are looked at. */
  #watched = true;

  /** @param {Api} api */
  constructor(api) {
    super();
    this.api = api;
    this.#live = new Live(api, {
      shown: (preview) => {
        if (this.phase === 'running') this.emit('preview', preview);
      },
      rested: () => {
        if (this.#following && !this.#job) void this.run();
      },
    });
  }

  /**
   * Starts the workers of the solver and of previews, while there is no input yet.
   * @throws where the solver cannot be started
   */
  async start() {
    const solver = this.#own().init();
    this.#live.start();
    await solver;
  }

  /**
   * An example of the package, made by the worker that will solve it unless that has something to do, or may be given back
   * meanwhile.
   * @param {ExampleName} name
   * @param {ExampleOptions} options
   */
  example(name, options) {
    const isFree = !this.#job && !(this.#kept && isLarge(this.#kept.input));
    return (isFree ? this.#own() : this.api).example(name, options);
  }

  /** @param {Phase} phase */
  #enter(phase) {
    if (this.phase === phase) return;
    this.phase = phase;
    this.emit('phase', phase);
  }

  /**
   * Tells everyone what went wrong; nothing else changes.
   * @param {string} doing what could not be done
   * @param {unknown} error
   */
  fail(doing, error) {
    this.emit('failure', { doing, error });
  }

  /**
   * Takes another input. If it cannot be had, what is there stays, and so does a run that is under way.
   * @param {string} doing for the message if it fails
   * @param {(signal: AbortSignal) => Promise<Input>} load `signal`: it is given up
   * @param {Slow} [slow] for what is said meanwhile
   * @returns {Promise<boolean>} whether it is the input now
   */
  async open(doing, load, slow) {
    const opened = await this.obtain(doing, async (signal) => {
      const input = await load(signal);
      await lookAt(input);
      if (signal.aborted) return false;
      this.#stop();
      this.#forget();
      this.input = input;
      this.result = null;
      this.#tried = false;
      this.emit('input', input);
      this.emit('cleared', null);
      void this.#look();
      return true;
    }, slow);
    if (this.phase === 'starting') this.#enter('idle');
    return opened ?? false;
  }

  /**
   * Something from a file, in the place of what is being opened.
   * @template T
   * @param {string} doing for the message if it fails
   * @param {(signal: AbortSignal) => Promise<T>} load `signal`: it is given up
   * @param {Slow} [slow] for what is said meanwhile
   * @returns {Promise<T | undefined>} nothing where it failed, or was given up
   */
  async obtain(doing, load, slow) {
    this.giveUp();
    const opening = (this.#opening = new AbortController());
    if (slow) this.emit('opening', slow);
    try {
      const found = await load(opening.signal);
      return opening.signal.aborted ? undefined : found;
    } catch (error) {
      if (!opening.signal.aborted) this.fail(doing, error);
      return undefined;
    } finally {
      if (this.#opening === opening) this.giveUp();
    }
  }

  /** Nothing is being opened any more; what is there stays. */
  giveUp() {
    if (!this.#opening) return;
    this.#opening.abort();
    this.#opening = null;
    this.emit('opening', null);
  }

  /**
   * The same input, understood otherwise.
   * @param {Partial<Omit<Input, 'name'>>} change
   */
  async amend(change) {
    if (!this.input) return;
    const input = (this.input = { ...this.input, ...change });
    await lookAt(input);
    // Another one may have been opened, or this one amended again.
    if (this.input !== input) return;
    this.emit('input', input);
    void this.#look();
    if (this.#tried) void this.run();
  }

  /** @param {Partial<Settings>} change */
  set(change) {
    this.settings = { ...this.settings, ...change };
    this.emit('settings', this.settings);
    if ('occlusionThreshold' in change || 'coarsening' in change) void this.#look();
    if (!this.#tried || !this.#watched) return;
    // It may have been run, or be under way, since it was first thought of.
    if (this.#job?.input === this.input && isSame(this.#job.settings, this.settings)) this.#following = false;
    else void this.run();
  }

  /**
   * What is being chosen, and may be another in a moment: a preview follows, and the run when the choice
   * rests. One that is under way is let finish where its λ is close.
   * @param {{ lambda: number }} change
   */
  follow({ lambda }) {
    const { input } = this;
    this.settings = { ...this.settings, lambda };
    if (!input || !this.#tried || !this.#watched) return;
    if (this.#job && !isClose(this.#job.settings.lambda, lambda)) this.#drop();
    this.#awaitRest(input);
  }

  /** While heights are not looked at, settings are taken for later. @param {boolean} watched */
  watch(watched) {
    if (this.#watched === watched) return;
    this.#watched = watched;
    const last = this.#job?.settings ?? this.result?.settings;
    if (watched && this.#tried && last && !isSame(last, this.settings)) void this.run();
  }

  /**
   * Heights that are being changed by hand, likewise.
   * @param {Partial<Pick<Input, 'data' | 'drawn'>>} change
   */
  reshape(change) {
    if (!this.input) return;
    const input = (this.input = { ...this.input, ...change });
    lookAtOnce(input);
    this.emit('input', input);
    if (!this.#tried) return;
    this.#drop();
    this.#awaitRest(input);
  }

  /** What was being chosen is chosen. */
  settle() {
    if (this.#following && !this.#job) void this.run();
  }

  /** @param {Input} input */
  #awaitRest(input) {
    this.#following = true;
    if (this.phase !== 'running') this.emit('start', this.settings);
    this.#enter('running');
    this.#wish(input);
  }

  /** @param {Input} input */
  #wish(input) {
    this.#live.wish(input, this.settings, this.result?.surface.report.lambda);
  }

  /** Solves the present input, from the last answer if there is one; ends a run that is under way. */
  async run() {
    const { input, settings } = this;
    if (!input) return;
    const abort = new AbortController();
    const job = (this.#job = { abort, input, settings, finest: /** @type {boolean} */ (false) });
    this.#tried = true;
    this.#following = false;
    clearTimeout(this.#resting);
    this.emit('start', settings);
    this.#enter('running');
    if (input.width * input.height > MANY) this.#wish(input);
    const { coarsening, ...options } = settingsFor(input, settings);
    try {
      // A large input is copied for the solver: not within the same moment as all else that is done with it.
      if (this.#kept?.input !== input) await breath();
      if (this.#job !== job) return;
      const solver = await this.#solverOf(input);
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
      const result = { input, settings, surface };
      await lookInto(result);
      if (this.#job !== job) return;
      if (!this.#following) this.#live.stop();
      this.result = result;
      this.emit('result', this.result);
    } catch (error) {
      if (this.#job !== job) return;
      this.#stop();
      this.#forget();
      this.emit('unsolved', null);
      this.fail('This could not be solved', error);
    } finally {
      if (this.#job === job) {
        this.#job = null;
        this.#rest(input);
        if (!this.#following) this.#enter('idle');
        // What was chosen meanwhile.
        else if (!this.#live.busy) void this.run();
      }
    }
  }

  /**
   * The solver of an input; of the same one understood otherwise it goes on from the last answer.
   * @param {Input} input
   * @returns {Promise<OpenSolver>}
   */
  #solverOf(input) {
    const kept = this.#kept;
    if (kept?.input === input) return kept.solver;
    const solver = kept
      ? kept.solver.then(async (open) => {
          await open.replace(heightsOf(input));
          return open;
        })
      : this.#own().open(heightsOf(input));
    this.#kept = { input, solver };
    return solver;
  }

  #own() {
    return this.#worker?.connected ? this.#worker : (this.#worker = new this.api.DevelopableWorker());
  }

  /** A solver of many vertices holds much memory: it is given back when nothing is asked of it for a while. @param {Input} input */
  #rest(input) {
    if (isLarge(input)) this.#resting = window.setTimeout(() => this.#giveBack(), REST);
  }

  /** Gives the solver up: the next run starts from nothing. */
  #forget() {
    clearTimeout(this.#resting);
    if (this.#kept && isLarge(this.#kept.input)) this.#giveBack();
    this.#kept?.solver.then((solver) => solver.dispose(), () => {});
    this.#kept = null;
  }

  /** Only a worker's end gives its memory back. */
  #giveBack() {
    this.#kept = null;
    this.#worker?.dispose();
    this.#worker = null;
  }

  /** Looks where the present input is torn, if that is wanted. */
  async #look() {
    const turn = ++this.#looked;
    const { input, settings: { occlusionThreshold: threshold, coarsening } } = this;
    if (!input || input.design || threshold === undefined) {
      this.emit('occlusions', null);
      return;
    }
    try {
      const found = await this.api.occlusions(heightsOf(input), { threshold, ...spacingOf(input, coarsening) });
      if (turn === this.#looked) this.emit('occlusions', found);
    } catch (error) {
      if (turn !== this.#looked) return;
      this.emit('occlusions', null);
      this.fail('Occlusions could not be looked for', error);
    }
  }

  /** Ends the run; its best surface so far becomes the result, if it can be had soon. */
  cancel() {
    this.#following = false;
    this.#live.stop();
    const job = this.#job;
    if (job) {
      job.abort.abort();
      // Before the finest lattice is reached, that surface is no better than a preview, and takes long to be certified.
      if (isLarge(job.input) && !job.finest) setTimeout(() => this.#job === job && this.#leave(), SOON);
    } else if (this.phase === 'running') {
      // There were previews only.
      this.#stop();
      this.emit('unsolved', null);
    }
  }

  /** Ends the run and forgets it. */
  #drop() {
    const job = this.#job;
    this.#job = null;
    job?.abort.abort();
  }

  /** Ends the run with its worker. */
  #leave() {
    this.#giveBack();
    this.#stop();
    this.emit('unsolved', null);
  }

  /** Ends the run and forgets it; nothing else is to come. */
  #stop() {
    this.#drop();
    this.#following = false;
    this.#live.stop();
    if (this.phase === 'running') this.#enter('idle');
  }
}

/** @param {Settings} a @param {Settings} b */
function isSame(a, b) {
  return Object.entries({ ...a, ...b }).every(([name, value]) => a[/** @type {keyof Settings} */ (name)] === value);
}

/**
 * @param {number | 'auto'} a
 * @param {number} b
 */
function isClose(a, b) {
  return a !== 'auto' && Math.abs(Math.log(a / b)) <= Math.log(CLOSE);
}

/** @param {Input} input */
function isLarge({ width, height }) {
  return width * height >= LARGE;
}

/**
 * A lattice has its own.
 * @param {Input} input
 * @param {number} coarsening
 */
function spacingOf({ pixelSize, lattice }, coarsening) {
  return lattice ? {} : { spacing: coarsening * pixelSize };
}

/**
 * An input as the package takes it.
 * @param {Input} input
 */
export function heightsOf({ width, height, data, pixelSize, heightScale, lattice, design, confidence, constraints }) {
  if (lattice) return lattice;
  const frame = { width, height, pixelSize, heightScale };
  return design ? { ...frame, constraints: data } : { ...frame, data, confidence, constraints };
}
