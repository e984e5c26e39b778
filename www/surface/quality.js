/** How finely to draw, from how long it takes: a graphics card draws everything, a processor alone less. */

/** @typedef {{ density: number, cells: number }} Level pixels for one of the page, quads along the longer side of a surface */

/** @type {readonly Level[]} */
const LEVELS = [
  { density: 2, cells: 400 },
  { density: 1, cells: 320 },
  { density: 0.7, cells: 160 },
  { density: 0.5, cells: 96 },
  { density: 0.35, cells: 64 },
];
/** Milliseconds that a picture may take, and below which a finer one is tried. */
const MOST = 24;
const LITTLE = 7;
/** Pictures from one measurement to the next. */
const EVERY = 12;

export class Quality {
  // From below: what is too much would be felt.
  #level = 3;
  #drawn = 0;
  #measuring = false;
  #finer;

  /** @param {() => void} finer it is worth drawing again, as finely as it says now */
  constructor(finer) {
    this.#finer = finer;
  }

  /** @returns {Level} */
  get level() {
    return LEVELS[this.#level];
  }

  /** The next picture is measured: nothing else is going on. */
  rest() {
    this.#drawn = 1;
  }

  /**
   * Draws, and now and then takes the time, for which nobody waits.
   * @param {() => void} draw
   * @param {() => Promise<void>} finished when it is drawn
   */
  draw(draw, finished) {
    const measured = this.#drawn++ % EVERY < 2 && !this.#measuring;
    const start = performance.now();
    draw();
    if (measured) void this.#measure(start, finished());
  }

  /** @param {number} start @param {Promise<void>} finished */
  async #measure(start, finished) {
    // The first picture is also when shaders are made ready.
    const first = this.#drawn === 1;
    this.#measuring = true;
    await finished;
    this.#measuring = false;
    const time = performance.now() - start;
    if (time > MOST) this.#level = Math.min(LEVELS.length - 1, this.#level + 1);
    else if (time < LITTLE && !first && this.#level > 0) {
      this.#level--;
      this.#drawn = 0;
      this.#finer();
    }
  }
}
