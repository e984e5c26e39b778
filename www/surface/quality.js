/** How finely to draw, from how long it takes: a graphics card draws everything, a processor alone less. */

/** @typedef {{ density: number, cells: number }} Level pixels for one of the page, quads along the longer side of a surface */

/** @type {readonly Level[]} */
const LEVELS = [
  { density: 2, cells: 400 },
  { density: 1, cells: 320 },
  { density: 1, cells: 160 },
  { density: 0.5, cells: 96 },
  { density: 0.35, cells: 64 },
];
/** Of what rests, at least: nobody waits for the next picture, but the page should not be held up by it either. */
const RESTING = 2;
/** Milliseconds that a picture may take, and below which a finer one is tried. */
const MOST = 24;
const LITTLE = 7;
/** Pictures from one measurement to the next. */
const EVERY = 12;

export class Quality {
  // From below: what is too much would be felt.
  #moving = 3;
  #drawn = 0;
  #resting = false;
  #measuring = false;
  #finer;

  /** @param {() => void} finer it is worth drawing again, as finely as it says now */
  constructor(finer) {
    this.#finer = finer;
  }

  get #level() {
    return this.#resting ? Math.min(RESTING, this.#moving) : this.#moving;
  }

  /** @returns {Level} of the next picture */
  get level() {
    return LEVELS[this.#level];
  }

  /** The next picture stays for a while: nothing else is going on. */
  rest() {
    this.#resting = true;
  }

  /**
   * Draws, and now and then takes the time, for which nobody waits.
   * @param {() => void} draw
   * @param {() => Promise<void>} finished when it is drawn
   */
  draw(draw, finished) {
    const [level, resting] = [this.#level, this.#resting];
    // The first picture is also when shaders are made ready.
    const measured = (resting || this.#drawn % EVERY === 1) && this.#drawn > 0 && !this.#measuring;
    this.#drawn++;
    const start = performance.now();
    draw();
    this.#resting = false;
    if (measured) void this.#measure(level, resting, start, finished());
  }

  /**
   * @param {number} level of the picture
   * @param {boolean} resting
   * @param {number} start
   * @param {Promise<void>} finished
   */
  async #measure(level, resting, start, finished) {
    this.#measuring = true;
    await finished;
    this.#measuring = false;
    const time = performance.now() - start;
    if (time < LITTLE && level > 0) {
      this.#moving = level - 1;
      if (resting) this.#finer();
    } else if (time < MOST) this.#moving = Math.min(level, this.#moving);
    else if (!resting) this.#moving = Math.min(LEVELS.length - 1, level + 1);
  }
}
