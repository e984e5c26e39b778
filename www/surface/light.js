/** The light, which input and result share. */
import { EMPTY_ENTRY } from './raster.js';
import { fillSteelTable } from './steel.js';

/** Maximum distance of the light from the centre of the unit disk: not quite at the horizon. */
const MAX_LIGHT_RADIUS = 0.96;
/** Initial place of the light in the unit disk, y up. */
const DEFAULT_POSITION = { x: -0.38, y: 0.42 };
/** Names of directions, counter-clockwise in steps of 45°. */
const DIRECTION_NAMES = ['right', 'upper right', 'above', 'upper left', 'left', 'lower left', 'below', 'lower right'];
/** Maximum elevation at which the light has a direction; above, it is overhead. */
const MAX_NAMED_ELEVATION_DEGREES = 82;

export class Light {
  x = DEFAULT_POSITION.x;
  y = DEFAULT_POSITION.y;
  /** Colour of each normal under the light, as in `steel.js`. */
  table = new Uint32Array(EMPTY_ENTRY + 1);
  /** @type {(() => void)[]} */
  #listeners = [];
  #stale = true;

  /** @param {() => void} listener */
  onMove(listener) {
    this.#listeners.push(listener);
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
    this.#stale = true;
    for (const listener of this.#listeners) listener();
  }

  reset() {
    this.moveTo(DEFAULT_POSITION.x, DEFAULT_POSITION.y);
  }

  /** The colour of each normal under the light; computed when needed. */
  colours() {
    if (this.#stale) {
      const z = Math.sqrt(1 - this.x * this.x - this.y * this.y);
      fillSteelTable(this.table, [this.x, this.y, z]);
      this.#stale = false;
    }
    return this.table;
  }

  /** Azimuth in degrees, counter-clockwise from the right, 0 to 359. */
  get azimuth() {
    return (Math.round((Math.atan2(this.y, this.x) * 180) / Math.PI) + 360) % 360;
  }

  /** Elevation above the surface in degrees. */
  get elevation() {
    return Math.round((Math.acos(Math.min(1, Math.hypot(this.x, this.y))) * 180) / Math.PI);
  }

  /** The direction of the light in words, for screen readers. */
  toString() {
    if (this.elevation > MAX_NAMED_ELEVATION_DEGREES) return 'light from straight overhead';
    const side = DIRECTION_NAMES[Math.round(this.azimuth / 45) % DIRECTION_NAMES.length];
    return `light from ${side}, ${this.elevation}° above the surface`;
  }
}
