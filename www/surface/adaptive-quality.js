/** Adapts the resolution of drawing to the measured time: a graphics card draws everything, a software renderer less. */

/** @typedef {{ density: number, cells: number }} QualityLevel device pixels per CSS pixel; quads along the longer side of a surface */

/** Quality levels from fine to coarse. @type {readonly QualityLevel[]} */
const LEVELS = [
  { density: 2, cells: 400 },
  { density: 1, cells: 320 },
  { density: 1, cells: 160 },
  { density: 0.5, cells: 96 },
  { density: 0.35, cells: 64 },
];
/** Coarsest level of a picture that stays: nobody waits for the next one, but it must not block the page. */
const MAX_RESTING_LEVEL = 2;
/** Maximum time of a picture, in milliseconds. */
const MAX_FRAME_MS = 24;
/** Time in milliseconds below which a finer level is tried. */
const FAST_FRAME_MS = 7;
/** Number of pictures from one measurement to the next. */
const FRAMES_PER_MEASUREMENT = 12;
/** Level of the first pictures: coarse, since too fine a level would be noticed. */
const START_LEVEL = 3;

export class AdaptiveQuality {
  #movingLevel = START_LEVEL;
  #frames = 0;
  #isResting = false;
  #isMeasuring = false;
  #onFiner;

  /** @param {() => void} onFiner called when drawing again would be finer */
  constructor(onFiner) {
    this.#onFiner = onFiner;
  }

  get #levelIndex() {
    return this.#isResting ? Math.min(MAX_RESTING_LEVEL, this.#movingLevel) : this.#movingLevel;
  }

  /** The level of the next picture. @returns {QualityLevel} */
  get level() {
    return LEVELS[this.#levelIndex];
  }

  /** Says that the next picture stays for a while: nothing moves. */
  rest() {
    this.#isResting = true;
  }

  /**
   * Draws a picture, and measures the time of some pictures asynchronously.
   * @param {() => void} draw
   * @param {() => Promise<void>} finished resolves when the picture is drawn
   */
  draw(draw, finished) {
    const [level, resting] = [this.#levelIndex, this.#isResting];
    // The first picture is not measured: it includes the compilation of shaders.
    const measured = (resting || this.#frames % FRAMES_PER_MEASUREMENT === 1) && this.#frames > 0 && !this.#isMeasuring;
    this.#frames++;
    const start = performance.now();
    draw();
    this.#isResting = false;
    if (measured) void this.#measure(level, resting, start, finished());
  }

  /**
   * Chooses the level of the next pictures by the time of one.
   * @param {number} level of the picture
   * @param {boolean} resting
   * @param {number} start
   * @param {Promise<void>} finished
   */
  async #measure(level, resting, start, finished) {
    this.#isMeasuring = true;
    await finished;
    this.#isMeasuring = false;
    const time = performance.now() - start;
    if (time < FAST_FRAME_MS && level > 0) {
      this.#movingLevel = level - 1;
      if (resting) this.#onFiner();
    } else if (time < MAX_FRAME_MS) this.#movingLevel = Math.min(level, this.#movingLevel);
    else if (!resting) this.#movingLevel = Math.min(LEVELS.length - 1, level + 1);
  }
}
