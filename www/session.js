/**
 * What the page is about, without any of its elements: one input, its settings,
 * at most one run, and the last result.
 *
 * Two rules keep it simple. The newest wish wins: a second run, or another input,
 * ends the one before. And once an input has been run, every change of a setting
 * runs it again, so that what is seen is what is set.
 */

/** @import {Api, Progress, Surface} from './api.js' */

/**
 * @typedef {object} Input
 * @property {string} name what to call it, and what saved files are named after
 * @property {number} width
 * @property {number} height
 * @property {Float64Array} data steps of height, row by row, NaN for no data
 * @property {number} pixelSize
 * @property {number} heightScale
 * @property {Float64Array} [truth] the surface without noise, where it is known
 * @property {string} [kind] of file, in words; examples have none
 */

/**
 * @typedef {object} Settings
 * @property {number} lambda
 * @property {number} gap
 * @property {'default' | 'paper'} schedule
 * @property {number} coarsening lattice spacing in pixels
 */

/** @typedef {{ input: Input, settings: Settings, surface: Surface }} Result */
/** @typedef {'starting' | 'idle' | 'running' | 'failed'} Phase */

/**
 * @typedef {object} Events
 * @property {Input} input another input, or the same understood otherwise
 * @property {Settings} start a run has begun
 * @property {Progress} progress
 * @property {Result} result
 * @property {null} cleared the last result is gone, for another input is there
 * @property {Phase} phase
 * @property {null} unsolved a run has ended with nothing
 * @property {{ doing: string, error: unknown }} failure
 */

/** @template T @typedef {(value: T) => void} Listener */

export class Session {
  /** @type {Settings} */
  settings = { lambda: 1e6, gap: 0.01, schedule: 'default', coarsening: 1 };
  /** @type {Input | null} */
  input = null;
  /** @type {Result | null} */
  result = null;
  /** @type {Phase} */
  phase = 'starting';

  /** @type {{ [E in keyof Events]?: Listener<Events[E]>[] }} */
  #listeners = {};
  /** @type {AbortController | null} */
  #job = null;
  /** Counts what was opened, to tell the newest. */
  #opened = 0;
  /** Whether the present input has been run. */
  #tried = false;

  /** @param {Api} api */
  constructor(api) {
    this.api = api;
  }

  /**
   * @template {keyof Events} E
   * @param {E} event
   * @param {Listener<Events[E]>} listener
   */
  on(event, listener) {
    /** @type {Listener<Events[E]>[]} */
    const listeners = (this.#listeners[event] ??= []);
    listeners.push(listener);
  }

  /**
   * @template {keyof Events} E
   * @param {E} event
   * @param {Events[E]} value
   */
  #emit(event, value) {
    for (const listener of this.#listeners[event] ?? []) listener(value);
  }

  /** @param {Phase} phase */
  #enter(phase) {
    if (this.phase === phase) return;
    this.phase = phase;
    this.#emit('phase', phase);
  }

  /**
   * Tells everyone what went wrong; nothing else changes.
   * @param {string} doing what could not be done
   * @param {unknown} error
   */
  fail(doing, error) {
    this.#emit('failure', { doing, error });
  }

  /**
   * Takes another input. If it cannot be had, what is there stays, and so does a run that is under way.
   * @param {string} doing for the message if it fails
   * @param {() => Promise<Input>} load
   * @returns {Promise<boolean>} whether it is the input now
   */
  async open(doing, load) {
    const turn = ++this.#opened;
    try {
      const input = await load();
      if (turn !== this.#opened) return false;
      this.#stop();
      this.input = input;
      this.result = null;
      this.#tried = false;
      this.#emit('input', input);
      this.#emit('cleared', null);
      return true;
    } catch (error) {
      if (turn === this.#opened) this.fail(doing, error);
      return false;
    } finally {
      if (this.phase === 'starting') this.#enter('idle');
    }
  }

  /**
   * The same input, understood otherwise.
   * @param {Partial<Pick<Input, 'data' | 'pixelSize' | 'heightScale'>>} change
   */
  amend(change) {
    if (!this.input) return;
    this.input = { ...this.input, ...change };
    this.#emit('input', this.input);
    if (this.#tried) void this.run();
  }

  /** @param {Partial<Settings>} change */
  set(change) {
    this.settings = { ...this.settings, ...change };
    if (this.#tried) void this.run();
  }

  /** Solves the present input; ends a run that is under way. */
  async run() {
    const { input, settings } = this;
    if (!input) return;
    this.#job?.abort();
    const job = (this.#job = new AbortController());
    this.#tried = true;
    this.#emit('start', settings);
    this.#enter('running');
    const { width, height, data, pixelSize, heightScale } = input;
    const { lambda, gap, schedule, coarsening } = settings;
    try {
      const surface = await this.api.fit({ width, height, data, pixelSize, heightScale }, {
        lambda, gap, schedule, spacing: coarsening * pixelSize,
        signal: job.signal,
        onAbort: 'keep',
        onProgress: (progress) => {
          if (this.#job === job && !job.signal.aborted) this.#emit('progress', progress);
        },
      });
      if (this.#job !== job) return;
      this.result = { input, settings, surface };
      this.#emit('result', this.result);
    } catch (error) {
      if (this.#job !== job) return;
      this.#emit('unsolved', null);
      this.fail('This could not be solved', error);
    } finally {
      if (this.#job === job) {
        this.#job = null;
        this.#enter('idle');
      }
    }
  }

  /** Ends the run; its best surface so far becomes the result. */
  cancel() {
    this.#job?.abort();
  }

  /** Ends the run and forgets it. */
  #stop() {
    const job = this.#job;
    this.#job = null;
    job?.abort();
    if (this.phase === 'running') this.#enter('idle');
  }
}
