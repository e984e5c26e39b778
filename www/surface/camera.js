/** A camera with parallel projection, turned about the vertical and tipped towards the viewer. */

/** @typedef {readonly [number, number, number]} Vector */
/**
 * @typedef {object} Box the region that the camera shows
 * @property {number} left
 * @property {number} top y up
 * @property {number} width
 * @property {number} height
 * @property {number} low
 * @property {number} high
 */

/** Angles of the default view, in radians. @type {{ turn: number, tip: number }} */
const OBLIQUE_VIEW = { turn: -0.5, tip: 0.9 };
/** Share of the canvas that the box fills in a view that is not from above. */
const OBLIQUE_FIT_SHARE = 0.94;
/** Bounds of the enlargement. */
const MIN_ZOOM = 0.5;
const MAX_ZOOM = 60;
/** Number of steps along a ray in the search for an intersection. */
const RAY_STEPS = 400;
/** Number of bisections that refine an intersection. */
const RAY_BISECTIONS = 20;

export class Camera {
  /** Angle about the vertical and angle from straight above, in radians. */
  turn = OBLIQUE_VIEW.turn;
  tip = OBLIQUE_VIEW.tip;
  zoom = 1;
  /** The view to which the scale fits the box; turning the camera does not change the scale. */
  #fittedView = OBLIQUE_VIEW;
  /** Shift of the centre, in shorter sides of the canvas. */
  shift = { x: 0, y: 0 };
  /** Factor by which heights are exaggerated. */
  exaggeration = 1;
  /** @type {Box} */
  box = { left: 0, top: 1, width: 1, height: 1, low: 0, high: 0 };
  size = { width: 1, height: 1 };

  viewFromAbove() {
    this.#setView({ turn: 0, tip: 0 });
  }

  viewObliquely() {
    this.#setView(OBLIQUE_VIEW);
  }

  /** Sets the view, and resets zoom and shift. @param {{ turn: number, tip: number }} view */
  #setView(view) {
    this.#fittedView = view;
    Object.assign(this, { ...view, zoom: 1, shift: { x: 0, y: 0 } });
  }

  /** Turns and tips the camera. @param {number} across @param {number} up in radians */
  rotate(across, up) {
    this.turn -= across;
    this.tip = Math.min(Math.PI / 2, Math.max(0, this.tip - up));
  }

  /** Zooms about a fixed place of the canvas. @param {number} factor @param {number} x @param {number} y */
  zoomAt(factor, x, y) {
    const zoom = Math.min(MAX_ZOOM, Math.max(MIN_ZOOM, this.zoom * factor));
    const change = zoom / this.zoom;
    const { width, height } = this.size;
    const shorterSide = Math.min(width, height);
    const [px, py] = [(x - width / 2) / shorterSide, (height / 2 - y) / shorterSide];
    this.shift = { x: px + (this.shift.x - px) * change, y: py + (this.shift.y - py) * change };
    this.zoom = zoom;
  }

  /** Shifts the picture. @param {number} x @param {number} y in pixels, y down */
  pan(x, y) {
    const shorterSide = Math.min(this.size.width, this.size.height);
    this.shift = { x: this.shift.x + x / shorterSide, y: this.shift.y - y / shorterSide };
  }

  /** Unit vectors to the right, up and towards the viewer. @returns {[Vector, Vector, Vector]} */
  get axes() {
    const [c, s] = [Math.cos(this.turn), Math.sin(this.turn)];
    const [ct, st] = [Math.cos(this.tip), Math.sin(this.tip)];
    return [[c, s, 0], [-s * ct, c * ct, st], [s * st, -c * st, ct]];
  }

  /** Pixels of the canvas per unit of length. */
  get scale() {
    const { width, height, low, high } = this.box;
    const { turn, tip } = this.#fittedView;
    const [c, sine] = [Math.abs(Math.cos(turn)), Math.abs(Math.sin(turn))];
    const deep = (high - low) * this.exaggeration;
    const up = (width * sine + height * c) * Math.cos(tip) + deep * Math.sin(tip);
    return this.zoom * (tip > 0 ? OBLIQUE_FIT_SHARE : 1) * Math.min(this.size.width / (width * c + height * sine), this.size.height / up);
  }

  get centre() {
    const { left, top, width, height, low, high } = this.box;
    return /** @type {const} */ ([left + width / 2, top - height / 2, (low + high) / 2]);
  }

  /** The place of a point on the canvas. @param {Vector} point @returns {[number, number]} */
  project([x, y, z]) {
    const [right, up] = this.axes;
    const [mx, my, mz] = this.centre;
    const d = /** @type {const} */ ([x - mx, y - my, (z - mz) * this.exaggeration]);
    const { width, height } = this.size;
    const shorterSide = Math.min(width, height);
    return [
      width / 2 + dot(right, d) * this.scale + this.shift.x * shorterSide,
      height / 2 - dot(up, d) * this.scale - this.shift.y * shorterSide,
    ];
  }

  /**
   * The ray through a place of the canvas: a point and the direction towards the viewer, in heights without exaggeration.
   * @param {number} x
   * @param {number} y
   * @returns {{ point: Vector, towards: Vector }}
   */
  rayAt(x, y) {
    const [right, up, out] = this.axes;
    const { width, height } = this.size;
    const shorterSide = Math.min(width, height);
    const across = (x - width / 2 - this.shift.x * shorterSide) / this.scale;
    const high = (height / 2 - y - this.shift.y * shorterSide) / this.scale;
    const [mx, my, mz] = this.centre;
    /** @param {0 | 1 | 2} k */
    const at = (k) => across * right[k] + high * up[k];
    return {
      point: [mx + at(0), my + at(1), mz + at(2) / this.exaggeration],
      towards: [out[0], out[1], out[2] / this.exaggeration],
    };
  }

  /**
   * The first intersection of a heightfield with the ray through a place of the canvas.
   * @param {number} x
   * @param {number} y
   * @param {(x: number, y: number) => number} heightAt height at a place of the plane, NaN for no data
   * @returns {Vector | null}
   */
  intersectHeightfield(x, y, heightAt) {
    const { point, towards } = this.rayAt(x, y);
    const { low, high, width, height } = this.box;
    if (towards[2] < 1e-6) return null;
    const room = 1e-9 + 0.02 * Math.max(high - low, 0.01 * Math.max(width, height));
    const [from, to] = [(high + room - point[2]) / towards[2], (low - room - point[2]) / towards[2]];
    /** @param {number} t @returns {Vector} */
    const at = (t) => [point[0] + t * towards[0], point[1] + t * towards[1], point[2] + t * towards[2]];
    /** @param {number} t */
    const heightAbove = (t) => {
      const [px, py, pz] = at(t);
      return pz - heightAt(px, py);
    };
    let before = from;
    for (let i = 1; i <= RAY_STEPS; i++) {
      const t = from + ((to - from) * i) / RAY_STEPS;
      if (!(heightAbove(t) <= 0)) {
        before = t;
        continue;
      }
      let [above, below] = [before, t];
      if (Number.isNaN(heightAbove(above))) return at(below);
      for (let k = 0; k < RAY_BISECTIONS; k++) {
        const half = (above + below) / 2;
        if (heightAbove(half) > 0) above = half;
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
