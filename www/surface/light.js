/** The light of the page, which all surfaces share. */

/** Maximum distance of the light from the centre of the unit disk: not quite at the horizon. */
const MAX_LIGHT_RADIUS = 0.96;
/** Initial place of the light in the unit disk, y up. */
const DEFAULT_POSITION = { x: -0.38, y: 0.42 };

class Light {
  x = DEFAULT_POSITION.x;
  y = DEFAULT_POSITION.y;
  /** @type {Set<() => void>} */
  #listeners = new Set();

  /** Adds a listener, and returns a function that removes it. @param {() => void} listener */
  onMove(listener) {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /**
   * Moves the light above a point of the unit disk, `y` up.
   * @param {number} x
   * @param {number} y
   */
  moveTo(x, y) {
    const shrink = Math.min(1, MAX_LIGHT_RADIUS / Math.max(Math.hypot(x, y), 1e-9));
    this.x = x * shrink;
    this.y = y * shrink;
    for (const listener of this.#listeners) listener();
  }

  reset() {
    this.moveTo(DEFAULT_POSITION.x, DEFAULT_POSITION.y);
  }

  /**
   * The unit vector towards the light along the axes of the view. It turns twice as far as the camera is tilted, so that a level
   * surface mirrors the same from every side.
   * @param {number} tilt in radians, from straight above
   * @returns {[number, number, number]}
   */
  from(tilt) {
    const z = Math.sqrt(1 - this.x ** 2 - this.y ** 2);
    const [c, s] = [Math.cos(2 * tilt), Math.sin(2 * tilt)];
    return [this.x, c * this.y + s * z, c * z - s * this.y];
  }
}

export const light = new Light();
