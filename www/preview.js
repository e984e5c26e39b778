/**
 * Pictures of what a setting gives, while the certified answer is still to come: the same input on
 * lattices from coarse to fine, in a worker of its own.
 *
 * The coarsest run always ends, so that each of many wishes in a row is followed by a picture; a finer one
 * gives way to a newer wish.
 */
import { settingsFor } from './design.js';
import { coarse } from './surface/coarse.js';
import { smallOf } from './surface/known.js';
import { PREVIEW } from './surface/look.js';

/** @import {Api, OpenSolver} from './api.js' */
/** @import {Input, Settings} from './session.js' */
/** @typedef {{ width: number, height: number, pixelSize: number, data: ArrayLike<number> }} Image */
/** @typedef {{ input: Input, lambda: number, image: Image }} Preview */
/** @typedef {{ input: Input, pixelSize: number, solver: Promise<OpenSolver> }} Rung */

/** Pixels along the longer side: some 30 ms of work, and four and four times as much. */
const SIDES = [96, 192, PREVIEW];
/** A design has nothing to begin with but its pins, and takes longer: a small one, then itself, from the last one for so many iterations. */
const DESIGN = [48, 100];
const DESIGN_ITERATIONS = 8;
/** Milliseconds without a wish after which the worker's memory is given back. */
const REST = 10_000;
/** What a picture needs no better than. */
const GAP = 0.1;

export class Live {
  #api;
  #events;
  /** @type {InstanceType<Api['DevelopableWorker']> | null} */
  #worker = null;
  /** Those that were needed so far, by the side. @type {Map<number, Rung>} */
  #rungs = new Map();
  /** @type {{ input: Input, settings: Settings, lambda?: number, abort: AbortController } | null} */
  #wish = null;
  #climbing = false;
  #resting = 0;
  /** The last that was followed to the end. @type {{ input: Input, settings: Settings } | null} */
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

  /** Starts the worker before there is anything to show. What fails here fails again, and is told, where it is needed. */
  start() {
    this.#own().init().catch(() => {});
    this.#rest();
  }

  #own() {
    return this.#worker?.connected ? this.#worker : (this.#worker = new this.#api.DevelopableWorker());
  }

  /**
   * @param {Input} input
   * @param {Settings} settings
   * @param {number} [lambda] in the place of `auto`, where one was found before
   */
  wish(input, settings, lambda) {
    if ([this.#wish, this.#done].some((one) => one?.input === input && one.settings === settings)) return;
    this.#wish?.abort.abort();
    this.#wish = { input, settings, lambda, abort: new AbortController() };
    if (!this.#climbing) void this.#climb();
  }

  /** Whether there is more to come of the newest wish. */
  get busy() {
    return this.#wish !== null;
  }

  /** No more pictures are wanted. */
  stop() {
    this.#wish?.abort.abort();
    this.#wish = null;
  }

  /** From rung to rung for one wish, then for the newest one, until there is none. */
  async #climb() {
    this.#climbing = true;
    clearTimeout(this.#resting);
    for (let wish = this.#wish; wish; wish = this.#wish) {
      const { input, settings, abort } = wish;
      const wanted = settingsFor(input, settings);
      /** The coarsest lattice tells the finer ones what it has found. @type {Settings['lambda']} */
      let lambda = wanted.lambda === 'auto' ? wish.lambda ?? 'auto' : wanted.lambda;
      const sides = input.design ? DESIGN : SIDES.filter((side, i) => i === 0 || 1.5 * side < Math.max(input.width, input.height));
      for (let i = 0; i < sides.length && (i === 0 || !abort.signal.aborted); i++) {
        try {
          const picture = await this.#solve(input, { ...wanted, lambda }, sides[i], i === 0 ? undefined : abort.signal);
          lambda = picture.lambda;
          if (this.#wish?.input === input) this.#events.shown(picture);
        } catch {
          // The run that certifies says what is wrong, if anything is.
          break;
        }
      }
      if (this.#wish !== wish) continue;
      this.#wish = null;
      this.#done = wish;
      this.#events.rested(settings);
    }
    this.#climbing = false;
    this.#rest();
  }

  /** Gives the worker's memory back, unless there is another wish before. */
  #rest() {
    this.#resting = window.setTimeout(() => {
      this.#worker?.dispose();
      this.#worker = null;
      this.#rungs.clear();
    }, REST);
  }

  /**
   * @param {Input} input
   * @param {Pick<ReturnType<typeof settingsFor>, 'lambda' | 'energy'>} settings
   * @param {number} side
   * @param {AbortSignal} [signal]
   * @returns {Promise<Preview>}
   */
  async #solve(input, { lambda, energy }, side, signal) {
    const { pixelSize, solver } = this.#rung(input, side);
    // Passes at creases are for the answer.
    const passes = energy === 'huber' ? { creasePasses: 0 } : {};
    const few = input.design && side > DESIGN[0] ? { maxIterations: DESIGN_ITERATIONS } : {};
    const surface = await (await solver).fit({ lambda, energy, ...passes, ...few, gap: GAP, signal });
    const { image, report } = surface;
    if (!image) throw new Error('it has no image');
    return { input, lambda: report.lambda, image: { ...image, pixelSize } };
  }

  /** The rung for an input, which goes on from its last answer where only heights have changed. @param {Input} input @param {number} side */
  #rung(input, side) {
    const worker = this.#own();
    const found = this.#rungs.get(side);
    if (found?.input === input) return found;
    const { pixelSize, heights } = reducedTo(input, side);
    const again = found && isAlike(found.input, input) && worker.connected;
    const solver = again
      ? found.solver.then((open) => open.replace(heights).then(() => open))
      : worker.open(heights);
    if (found && !again) found.solver.then((open) => open.dispose(), () => {});
    // Told where it is waited for.
    solver.catch(() => this.#rungs.delete(side));
    const rung = { input, pixelSize, solver };
    this.#rungs.set(side, rung);
    return rung;
  }
}

/** @param {Input} a @param {Input} b */
function isAlike(a, b) {
  return ['width', 'height', 'pixelSize', 'heightScale', 'design'].every((name) => a[/** @type {keyof Input} */ (name)] === b[/** @type {keyof Input} */ (name)]);
}

/**
 * An input on fewer pixels, as the package takes it.
 * @param {Input} input
 * @param {number} side
 */
function reducedTo({ width, height, data, pixelSize: each, heightScale, design, confidence, constraints }, side) {
  /** @param {ArrayLike<number>} values */
  const reduced = (values) => coarse(smallOf({ width, height, data: values }), side);
  const heights = reduced(data);
  const pixelSize = (each * width) / heights.width;
  const frame = { width: heights.width, height: heights.height, pixelSize, heightScale };
  const known = { confidence: confidence && reduced(confidence).data, constraints: constraints && reduced(constraints).data };
  return { pixelSize, heights: design ? { ...frame, constraints: heights.data } : { ...frame, data: heights.data, ...known } };
}
