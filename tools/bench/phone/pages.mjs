/** Bent pages of which every point is known: isometries of the flat page to space, in metres. */

/**
 * @typedef {[number, number, number]} Point in space: to the right, up, and towards who looks at the page
 *
 * @typedef {object} Page
 * @property {string} name
 * @property {number} width
 * @property {number} height
 * @property {(u: number, v: number) => Point} point where a place on the page is, from its upper left corner
 */

export const A4 = /** @type {const} */ ([0.21, 0.297]);
/** Both pages of a book of format A5. */
export const SPREAD = /** @type {const} */ ([0.297, 0.21]);

const STEP = 1e-4;

/**
 * A page that is bent in one direction only.
 * @param {string} name
 * @param {readonly [number, number]} size
 * @param {number} direction of the bend, against the page's width
 * @param {(p: number) => number} slope the angle to the plane, by the length in that direction from the middle
 * @returns {Page}
 */
export function profile(name, [width, height], direction, slope) {
  const half = Math.hypot(width, height) / 2;
  const count = Math.ceil((2 * half) / STEP) + 2;
  const [across, up] = [new Float64Array(count), new Float64Array(count)];
  for (let i = 1; i < count; i += 1) {
    const angle = slope((i - 0.5) * STEP - half);
    across[i] = across[i - 1] + STEP * Math.cos(angle);
    up[i] = up[i - 1] + STEP * Math.sin(angle);
  }
  const [cos, sin] = [Math.cos(direction), Math.sin(direction)];
  return {
    name, width, height,
    point(u, v) {
      const [x, y] = [u - width / 2, height / 2 - v];
      const [p, q] = [cos * x + sin * y, cos * y - sin * x];
      const at = (p + half) / STEP;
      const i = Math.min(Math.floor(at), count - 2);
      const t = at - i;
      const seen = across[i] + t * (across[i + 1] - across[i]) - half;
      return [cos * seen - sin * q, sin * seen + cos * q, up[i] + t * (up[i + 1] - up[i])];
    },
  };
}

/** Distance to the nearest even number. @param {number} t */
const zigzag = (t) => Math.abs(t - 2 * Math.round(t / 2));

/**
 * A page of A4 crumpled into facets: Miura's fold of parallelograms, partly folded (M. Schenk, S. D. Guest, *Geometry of
 * Miura-folded metamaterials*, PNAS 110(9), 2013, Eqs. 1–4).
 * @param {number} fold the facets' angle to the plane
 * @param {readonly [number, number]} [facet] sides of a facet, in widths of the page
 * @returns {Page}
 */
export function crumpled(fold, facet = [0.31, 0.37]) {
  const [width, height] = A4;
  const [a, b, corner] = [facet[0] * width, facet[1] * width, 1.25];
  const spread = Math.sqrt(1 + (Math.cos(fold) * Math.tan(corner)) ** 2);
  const folded = [
    (b * Math.cos(fold) * Math.tan(corner)) / spread,
    a * Math.sqrt(1 - (Math.sin(fold) * Math.sin(corner)) ** 2),
    b / spread,
  ];
  const ridge = a * Math.sin(fold) * Math.sin(corner);
  return {
    name: 'crumpled', width, height,
    point(u, v) {
      const across = u / (b * Math.sin(corner));
      const along = (height - v - b * Math.cos(corner) * zigzag(across)) / a;
      return [across * folded[0], along * folded[1] + folded[2] * zigzag(across), ridge * zigzag(along)];
    },
  };
}
