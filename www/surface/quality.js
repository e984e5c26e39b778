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

  /** @returns {Level} */
  get level() {
    return LEVELS[this.#level];
  }

  /** The next picture is measured: nothing else is going on. */
  rest() {
    this.#drawn = 1;
  }

  /**
   * Draws, and now and then takes the time.
   * @param {() => void} draw
   * @param {() => void} wait until it is drawn
   * @returns {boolean} whether to draw again, as finely as it says now
   */
  draw(draw, wait) {
    const measured = this.#drawn++ % EVERY < 2;
    const start = performance.now();
    draw();
    if (!measured) return false;
    wait();
    const time = performance.now() - start;
    const before = this.#level;
    if (time > MOST) this.#level = Math.min(LEVELS.length - 1, before + 1);
    // The first picture is also when shaders are made ready.
    else if (time < LITTLE && this.#drawn > 1) this.#level = Math.max(0, before - 1);
    if (this.#level < before) this.#drawn = 0;
    return this.#level < before;
  }
}
