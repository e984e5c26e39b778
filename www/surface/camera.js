/** From where a surface is seen, without perspective: turned about the vertical, and tipped towards the viewer. */

/** @typedef {readonly [number, number, number]} Vector */
/**
 * @typedef {object} Box what is looked at
 * @property {number} left
 * @property {number} top y up
 * @property {number} width
 * @property {number} height
 * @property {number} low
 * @property {number} high
 */

/** @type {{ turn: number, tip: number }} */
const OBLIQUE = { turn: -0.5, tip: 0.9 };
/** Of the canvas, where a surface is seen at an angle. */
const MARGIN = 0.94;
/** How many times larger, at most. */
const MOST = 60;
/** Steps of the search along a line of sight. */
const STEPS = 400;

export class Camera {
  /** About the vertical, and away from straight above, in radians. */
  turn = OBLIQUE.turn;
  tip = OBLIQUE.tip;
  zoom = 1;
  /** The view that all is to have room in; turned from there, it stays as large. */
  #fitted = OBLIQUE;
  /** Of the middle, in shares of the canvas' shorter side. */
  shift = { x: 0, y: 0 };
  /** Heights count so many times. */
  exaggeration = 1;
  /** @type {Box} */
  box = { left: 0, top: 1, width: 1, height: 1, low: 0, high: 0 };
  size = { width: 1, height: 1 };

  above() {
    this.#look({ turn: 0, tip: 0 });
  }

  oblique() {
    this.#look(OBLIQUE);
  }

  /** @param {{ turn: number, tip: number }} view */
  #look(view) {
    this.#fitted = view;
    Object.assign(this, { ...view, zoom: 1, shift: { x: 0, y: 0 } });
  }

  /** @param {number} across @param {number} up in radians */
  rotate(across, up) {
    this.turn -= across;
    this.tip = Math.min(Math.PI / 2, Math.max(0, this.tip - up));
  }

  /** Keeps what is at a place of the canvas there. @param {number} factor @param {number} x @param {number} y */
  scaleAt(factor, x, y) {
    const zoom = Math.min(MOST, Math.max(0.5, this.zoom * factor));
    const change = zoom / this.zoom;
    const { width, height } = this.size;
    const least = Math.min(width, height);
    const [px, py] = [(x - width / 2) / least, (height / 2 - y) / least];
    this.shift = { x: px + (this.shift.x - px) * change, y: py + (this.shift.y - py) * change };
    this.zoom = zoom;
  }

  /** @param {number} x @param {number} y in pixels, y down */
  move(x, y) {
    const least = Math.min(this.size.width, this.size.height);
    this.shift = { x: this.shift.x + x / least, y: this.shift.y - y / least };
  }

  /** To the right, up and towards the viewer. @returns {[Vector, Vector, Vector]} */
  get axes() {
    const [c, s] = [Math.cos(this.turn), Math.sin(this.turn)];
    const [ct, st] = [Math.cos(this.tip), Math.sin(this.tip)];
    return [[c, s, 0], [-s * ct, c * ct, st], [s * st, -c * st, ct]];
  }

  /** Pixels of the canvas for a unit of length. */
  get scale() {
    const { width, height, low, high } = this.box;
    const { turn, tip } = this.#fitted;
    const [c, sine] = [Math.abs(Math.cos(turn)), Math.abs(Math.sin(turn))];
    const deep = (high - low) * this.exaggeration;
    const up = (width * sine + height * c) * Math.cos(tip) + deep * Math.sin(tip);
    return this.zoom * (tip > 0 ? MARGIN : 1) * Math.min(this.size.width / (width * c + height * sine), this.size.height / up);
  }

  get middle() {
    const { left, top, width, height, low, high } = this.box;
    return /** @type {const} */ ([left + width / 2, top - height / 2, (low + high) / 2]);
  }

  /** Where a point is on the canvas. @param {Vector} point @returns {[number, number]} */
  seen([x, y, z]) {
    const [right, up] = this.axes;
    const [mx, my, mz] = this.middle;
    const d = /** @type {const} */ ([x - mx, y - my, (z - mz) * this.exaggeration]);
    const { width, height } = this.size;
    const least = Math.min(width, height);
    return [
      width / 2 + dot(right, d) * this.scale + this.shift.x * least,
      height / 2 - dot(up, d) * this.scale - this.shift.y * least,
    ];
  }

  /**
   * The line of sight through a place of the canvas: a point on it, and its direction towards the viewer, in
   * true heights.
   * @param {number} x
   * @param {number} y
   * @returns {{ point: Vector, towards: Vector }}
   */
  sight(x, y) {
    const [right, up, out] = this.axes;
    const { width, height } = this.size;
    const least = Math.min(width, height);
    const across = (x - width / 2 - this.shift.x * least) / this.scale;
    const high = (height / 2 - y - this.shift.y * least) / this.scale;
    const [mx, my, mz] = this.middle;
    /** @param {0 | 1 | 2} k */
    const at = (k) => across * right[k] + high * up[k];
    return {
      point: [mx + at(0), my + at(1), mz + at(2) / this.exaggeration],
      towards: [out[0], out[1], out[2] / this.exaggeration],
    };
  }

  /**
   * The first place of a heightfield on the line of sight.
   * @param {number} x
   * @param {number} y
   * @param {(x: number, y: number) => number} heightAt NaN where there is none
   * @returns {Vector | null}
   */
  hit(x, y, heightAt) {
    const { point, towards } = this.sight(x, y);
    const { low, high, width, height } = this.box;
    if (towards[2] < 1e-6) return null;
    const room = 1e-9 + 0.02 * Math.max(high - low, 0.01 * Math.max(width, height));
    const [from, to] = [(high + room - point[2]) / towards[2], (low - room - point[2]) / towards[2]];
    /** @param {number} t @returns {Vector} */
    const at = (t) => [point[0] + t * towards[0], point[1] + t * towards[1], point[2] + t * towards[2]];
    /** @param {number} t */
    const over = (t) => {
      const [px, py, pz] = at(t);
      return pz - heightAt(px, py);
    };
    let before = from;
    for (let i = 1; i <= STEPS; i++) {
      const t = from + ((to - from) * i) / STEPS;
      if (!(over(t) <= 0)) {
        before = t;
        continue;
      }
      let [above, below] = [before, t];
      if (Number.isNaN(over(above))) return at(below);
      for (let k = 0; k < 20; k++) {
        const half = (above + below) / 2;
        if (over(half) > 0) above = half;
        else below = half;
      }
      return at(below);
    }
    return null;
  }
}

/** @param {Vector} a @param {Vector} b */
function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
