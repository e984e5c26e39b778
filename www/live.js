/**
 * Pictures of what a setting gives, while the certified answer is still to come: the same input on
 * lattices from coarse to fine, in a worker of its own.
 *
 * The coarsest run always ends, so that each of many wishes in a row is followed by a picture; a finer one
 * gives way to a newer wish.
 */
import { coarse } from './surface/coarse.js';

/** @import {Api, OpenSolver} from './api.js' */
/** @import {Input, Settings} from './session.js' */
/** @typedef {{ width: number, height: number, pixelSize: number, data: ArrayLike<number> }} Image */
/** @typedef {{ input: Input, settings: Settings, image: Image }} Preview */
/** @typedef {{ pixelSize: number, solver: Promise<OpenSolver> }} Rung */

/** Pixels along the longer side: some 30 ms of work, and four and four times as much. */
const SIDES = [96, 192, 384];
/** What a picture needs no better than. */
const GAP = 0.1;

export class Live {
  #api;
  #events;
  /** @type {InstanceType<Api['DevelopableWorker']> | null} */
  #worker = null;
  /** @type {Input | null} */
  #input = null;
  /** Those that were needed so far, from coarse to fine. @type {Rung[]} */
  #rungs = [];
  /** @type {{ input: Input, settings: Settings, abort: AbortController } | null} */
  #wish = null;
  #climbing = false;
  /** The last that was followed to the end. @type {Settings | null} */
  #done = null;

  /**
   * @param {Api} api
   * @param {{ shown: (preview: Preview) => void, rested: (settings: Settings) => void }} events
   *   `rested`: the finest picture of the newest wish is there
   */
  constructor(api, events) {
    this.#api = api;
    this.#events = events;
  }

  /** @param {Input} input @param {Settings} settings */
  wish(input, settings) {
    if (this.#input === input && [this.#wish?.settings, this.#done].includes(settings)) return;
    this.#wish?.abort.abort();
    this.#wish = { input, settings, abort: new AbortController() };
    if (!this.#climbing) void this.#climb();
  }

  /** No more pictures are wanted. */
  stop() {
    this.#wish?.abort.abort();
    this.#wish = null;
  }

  /** From rung to rung for one wish, then for the newest one, until there is none. */
  async #climb() {
    this.#climbing = true;
    for (let wish = this.#wish; wish; wish = this.#wish) {
      const { input, settings, abort } = wish;
      const sides = SIDES.filter((side, i) => i === 0 || 1.5 * side < Math.max(input.width, input.height));
      for (let i = 0; i < sides.length && (i === 0 || !abort.signal.aborted); i++) {
        try {
          const image = await this.#solve(input, settings, sides[i], i === 0 ? undefined : abort.signal);
          if (this.#wish?.input === input) this.#events.shown({ input, settings, image });
        } catch {
          // The run that certifies says what is wrong, if anything is.
          break;
        }
      }
      if (this.#wish !== wish) continue;
      this.#wish = null;
      this.#done = settings;
      this.#events.rested(settings);
    }
    this.#climbing = false;
  }

  /**
   * @param {Input} input
   * @param {Settings} settings
   * @param {number} side
   * @param {AbortSignal} [signal]
   * @returns {Promise<Image>}
   */
  async #solve(input, { lambda, energy }, side, signal) {
    const { pixelSize, solver } = this.#rung(input, side);
    const surface = await (await solver).fit({ lambda, energy, gap: GAP, signal });
    const { image } = surface;
    if (!image) throw new Error('it has no image');
    return { ...image, pixelSize };
  }

  /** @param {Input} input @param {number} side */
  #rung(input, side) {
    if (this.#input !== input || !this.#worker?.connected) {
      for (const { solver } of this.#rungs) solver.then((open) => open.dispose(), () => {});
      this.#input = input;
      this.#rungs = [];
      if (!this.#worker?.connected) this.#worker = new this.#api.DevelopableWorker();
    }
    return (this.#rungs[SIDES.indexOf(side)] ??= this.#opened(input, side, this.#worker));
  }

  /**
   * @param {Input} input
   * @param {number} side
   * @param {InstanceType<Api['DevelopableWorker']>} worker
   * @returns {Rung}
   */
  #opened({ width, height, data, pixelSize: each, heightScale, design, confidence, constraints }, side, worker) {
    /** @param {ArrayLike<number>} values */
    const reduced = (values) => coarse({ width, height, data: values }, side);
    const heights = reduced(data);
    const pixelSize = (each * width) / heights.width;
    const frame = { width: heights.width, height: heights.height, pixelSize, heightScale };
    const known = {
      confidence: confidence && reduced(confidence).data,
      constraints: constraints && reduced(constraints).data,
    };
    const solver = worker.open(design ? { ...frame, constraints: heights.data } : { ...frame, data: heights.data, ...known });
    // Told where it is waited for.
    solver.catch(() => {});
    return { pixelSize, solver };
  }
}
