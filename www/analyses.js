/**
 * What can be asked about a result, each question once.
 *
 * In a worker of its own: an answer may take seconds, and meanwhile the next run goes on. What is
 * no longer wanted is stopped with the worker.
 */

/** @import {Api} from './api.js' */
/** @import {Input, Result} from './session.js' */

/** @typedef {import('../pkg/types.js').Analysis} Analysis */
/** @typedef {import('../pkg/types.js').Photo} Photo */
/** @typedef {InstanceType<Api['DevelopableWorker']>} Worker */
/**
 * @typedef {object} FlatOptions
 * @property {number} [dots]
 * @property {boolean} trim
 * @property {[number, number][]} [crop]
 */

export class Analyses {
  #api;
  /** @type {Worker | null} */
  #worker = null;
  /** Questions without an answer yet. */
  #open = 0;
  /** @type {WeakMap<object, Map<string, Promise<any>>>} */
  #known = new WeakMap();

  /** @param {Api} api */
  constructor(api) {
    this.#api = api;
  }

  /**
   * @template T
   * @param {(worker: Worker) => Promise<T>} question
   */
  async #ask(question) {
    const worker = (this.#worker ??= new this.#api.DevelopableWorker());
    this.#open++;
    try {
      return await question(worker);
    } finally {
      if (worker === this.#worker) this.#open--;
    }
  }

  /**
   * @template T
   * @param {object} about
   * @param {string} name of the question
   * @param {(worker: Worker) => Promise<T>} question
   * @returns {Promise<T>}
   */
  #once(about, name, question) {
    const answers = this.#known.get(about) ?? new Map();
    this.#known.set(about, answers);
    const found = answers.get(name);
    if (found) return found;
    const answer = this.#ask(question);
    answers.set(name, answer);
    // What failed may be asked again.
    answer.catch(() => answers.delete(name));
    return answer;
  }

  /** Stops what is still being worked out; those who wait for it are told so. */
  stop() {
    if (this.#open === 0) return;
    this.#worker?.dispose();
    this.#worker = null;
    this.#open = 0;
  }

  /**
   * Curvatures before, on the same lattice, and after. Of a design there is no before.
   * @param {Result} result
   * @returns {Promise<{ before: Analysis | null, after: Analysis }>}
   */
  async curvatures({ input, surface }) {
    const { spacing } = surface;
    const [before, after] = await Promise.all([
      input.design ? null : this.#once(input, `curvatures ${spacing}`, (worker) =>
        worker.analyze(heightsAlone(input), input.lattice ? {} : { spacing })),
      this.#once(surface, 'curvatures', (worker) => worker.analyze(surface)),
    ]);
    return { before, after };
  }

  /** @param {Result} result */
  patches({ surface }) {
    return this.#once(surface, 'patches', (worker) => worker.patches(surface));
  }

  /** @param {Result} result */
  rulings({ surface }) {
    return this.#once(surface, 'rulings', (worker) => worker.rulings(surface));
  }

  /** @param {Result} result */
  unroll({ surface }) {
    return this.#once(surface, 'sheet', (worker) => worker.unroll(surface));
  }

  /**
   * The true surface of an example, laid flat.
   * @param {Input & { truth: Float64Array }} input
   */
  sheetOfTruth(input) {
    return this.#once(input.truth, 'sheet', (worker) => worker.unroll({ ...heightsAlone(input), data: input.truth }));
  }

  /**
   * @param {Result} result
   * @param {Photo} photo
   * @param {FlatOptions} options
   */
  dewarp({ surface }, photo, options) {
    return this.#once(surface, `dewarp ${numberOf(photo)} ${JSON.stringify(options)}`, (worker) =>
      worker.dewarp(surface, photo, options));
  }
}

let photos = 0;
/** @type {WeakMap<Photo, number>} */
const numbers = new WeakMap();

/** A number that no other photo has: answers are kept with the surface, and go with it. @param {Photo} photo */
function numberOf(photo) {
  const number = numbers.get(photo) ?? ++photos;
  numbers.set(photo, number);
  return number;
}

/**
 * An input without what else is known of it.
 * @param {Input} input
 */
function heightsAlone({ width, height, data, pixelSize, heightScale, lattice }) {
  return lattice ?? { width, height, data, pixelSize, heightScale };
}
