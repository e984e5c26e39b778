/** The one light that both surfaces share. */
import { NOTHING } from './raster.js';
import { fillSteel } from './steel.js';

/** How far from the middle the light may go: not quite down to the horizon. */
const RIM = 0.96;
const START = { x: -0.38, y: 0.42 };
const SIDES = ['right', 'upper right', 'above', 'upper left', 'left', 'lower left', 'below', 'lower right'];

export class Light {
  x = START.x;
  y = START.y;
  /** Colours by normal, for the present direction. */
  table = new Uint32Array(NOTHING + 1);
  /** @type {(() => void)[]} */
  #listeners = [];
  #stale = true;

  /** @param {() => void} listener */
  onMove(listener) {
    this.#listeners.push(listener);
  }

  /**
   * Puts the light above a point of the disk of radius 1, `y` up.
   * @param {number} x
   * @param {number} y
   */
  moveTo(x, y) {
    const shrink = Math.min(1, RIM / Math.max(Math.hypot(x, y), 1e-9));
    this.x = x * shrink;
    this.y = y * shrink;
    this.#stale = true;
    for (const listener of this.#listeners) listener();
  }

  reset() {
    this.moveTo(START.x, START.y);
  }

  /** The colours for the present direction; made when they are asked for. */
  colours() {
    if (this.#stale) {
      const z = Math.sqrt(1 - this.x * this.x - this.y * this.y);
      fillSteel(this.table, [this.x, this.y, z]);
      this.#stale = false;
    }
    return this.table;
  }

  /** Degrees counter-clockwise from the right, 0 to 359. */
  get azimuth() {
    return (Math.round((Math.atan2(this.y, this.x) * 180) / Math.PI) + 360) % 360;
  }

  /** Degrees above the surface. */
  get elevation() {
    return Math.round((Math.acos(Math.min(1, Math.hypot(this.x, this.y))) * 180) / Math.PI);
  }

  /** The direction in words. */
  toString() {
    if (this.elevation > 82) return 'light from straight overhead';
    const side = SIDES[Math.round(this.azimuth / 45) % SIDES.length];
    return `light from ${side}, ${this.elevation}° above the surface`;
  }
}
