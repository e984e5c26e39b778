/** Surfaces of the gallery, as heights over the unit square. Coordinates start at its middle, x to the right and y up. */

/** @typedef {(x: number, y: number) => number} Heights NaN outside of the shape */

/** Heights rotated about the middle. @param {Heights} heights @param {number} degrees counter-clockwise @returns {Heights} */
export function rotated(heights, degrees) {
  const angle = (degrees * Math.PI) / 180;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return (x, y) => heights(cos * x + sin * y, cos * y - sin * x);
}

/** Sails of a concert hall: parts of cylinders that lean against each other, each a sheet of steel. @type {Heights} */
export function hall(x, y) {
  /** @param {number} left @param {number} low @param {number} angle @param {number} radius @param {number} lean */
  const sail = (left, low, angle, radius, lean) => {
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const across = cos * (x - left) + sin * (y - low);
    const along = cos * (y - low) - sin * (x - left);
    return Math.abs(across) < 0.96 * radius ? Math.sqrt(radius ** 2 - across ** 2) - 0.55 * radius + lean * along : -1;
  };
  return Math.max(
    0,
    Math.min(sail(-0.22, -0.05, 0.5, 0.3, 0.35), 0.36 - 0.2 * y),
    Math.min(sail(0.16, 0.1, -0.35, 0.33, -0.25), 0.4 + 0.1 * x),
    sail(0.05, -0.3, 1.2, 0.2, 0.15),
  );
}

/** The upper half of a cylinder whose axis leans against the ground. @type {Heights} */
export function tiltedCylinder(x, y) {
  return Math.sqrt(0.6 ** 2 - x ** 2) + 0.3 * y;
}

/** Pleats like those of a folded fan, whose ridges run one way. @type {Heights} */
export function pleats(x, y) {
  const u = 5 * x + 0.6 * y;
  return 0.09 * (1 - 2 * Math.abs(u - Math.round(u))) + 0.12 * y;
}

/** The front of a bust, modelled by signed distances: the height where a ray from the front meets it. @type {Heights} */
export function bust(x, y) {
  for (let z = 0.62; z > 0.02; ) {
    const distance = bustDistance(x, y, z);
    if (distance < 1e-4) return z;
    z -= Math.max(0.6 * distance, 1e-3);
  }
  return 0.02;
}

/** Approximate signed distance from the bust. @param {number} x @param {number} y @param {number} z */
function bustDistance(x, y, z) {
  const side = Math.abs(x);
  /** @param {number} u @param {number} v @param {number} w @param {readonly [number, number, number]} radii */
  const ellipsoid = (u, v, w, [a, b, c]) => {
    const scaled = Math.hypot(u / a, v / b, w / c);
    const steep = Math.hypot(u / a ** 2, v / b ** 2, w / c ** 2) || 1;
    return (scaled * (scaled - 1)) / steep;
  };
  const head = ellipsoid(x, y - 0.12, z - 0.12, [0.21, 0.28, 0.27]);
  const jaw = ellipsoid(x, y + 0.06, z - 0.16, [0.13, 0.13, 0.19]);
  const nose = ellipsoid(x, y - 0.06 + 0.3 * (z - 0.38), z - 0.38, [0.035, 0.075, 0.065]);
  const brow = ellipsoid(side - 0.08, y - 0.155, z - 0.335, [0.075, 0.022, 0.04]);
  const eye = ellipsoid(side - 0.08, y - 0.1, z - 0.385, [0.05, 0.035, 0.05]);
  const cheek = ellipsoid(side - 0.1, y + 0.0, z - 0.28, [0.07, 0.08, 0.07]);
  const lip = ellipsoid(x, y + 0.065, z - 0.345, [0.06, 0.02, 0.03]);
  const chin = ellipsoid(x, y + 0.13, z - 0.29, [0.055, 0.045, 0.06]);
  const ear = ellipsoid(side - 0.215, y - 0.08, z - 0.1, [0.03, 0.07, 0.05]);
  const hair = ellipsoid(x, y - 0.27, z - 0.12, [0.24, 0.17, 0.2]);
  const neck = Math.max(Math.hypot(x, z - 0.08) - 0.12, y - 0.1);
  const chest = ellipsoid(x, y + 0.55, z - 0.02, [0.46, 0.27, 0.2]);
  let face = smoothMinimum(smoothMinimum(head, jaw, 0.05), cheek, 0.04);
  face = Math.max(face, -eye + 0.012);
  face = smoothMinimum(smoothMinimum(smoothMinimum(smoothMinimum(face, nose, 0.02), brow, 0.02), lip, 0.015), chin, 0.03);
  return smoothMinimum(smoothMinimum(smoothMinimum(Math.min(face, ear), hair, 0.02), neck, 0.03), chest, 0.06);
}

/** Smooth minimum of two distances. @param {number} a @param {number} b @param {number} k width of the transition */
function smoothMinimum(a, b, k) {
  const share = Math.max(k - Math.abs(a - b), 0) / k;
  return Math.min(a, b) - (share * share * k) / 4;
}

/** A column and a leaf in front of a wall that leans: seen from the front they hide a part of it. @type {Heights} */
export function occludedWall(x, y) {
  const wall = 0.12 * y - 0.1;
  if (Math.abs(x + 0.2) < 0.1) return 0.32 + Math.sqrt(0.1 ** 2 - (x + 0.2) ** 2) * 0.9;
  const [u, v] = [x - 0.16, y + 0.04];
  if (Math.abs(u) < 0.2 && Math.abs(v + 0.3 * u) < 0.22) return 0.28 + 0.5 * u ** 2 * 3 - 0.15 * u;
  return wall;
}

/** A note that was crumpled and spread again: facets between folds in all directions. @type {Heights} */
export function crumpledNote(x, y) {
  if (Math.abs(x) > 0.36 || Math.abs(y) > 0.46) return NaN;
  let z = 0;
  for (const [angle, place, fold] of NOTE_FOLDS) z += fold * Math.abs(Math.cos(angle) * x + Math.sin(angle) * y - place);
  return z;
}
/** Folds of the note: direction of the normal in radians, distance from the middle, and slope. */
const NOTE_FOLDS = /** @type {const} */ ([
  [0.3, 0.05, 0.16], [1.2, -0.12, -0.14], [2.1, 0.1, 0.12], [2.7, -0.2, -0.1], [0.9, 0.22, 0.11], [1.7, 0.2, -0.13], [0.05, -0.18, 0.09], [1.5, -0.3, 0.1],
]);

/** Mountains: ridges at every scale, each half as high as the last. @type {Heights} */
export function terrain(x, y) {
  let [z, size, scale] = [0, 0.11, 3];
  for (let octave = 0; octave < 6; octave++) {
    z += size * (1 - 2 * Math.abs(valueNoise(scale * (x + 7) + 3.1 * octave, scale * (y + 5) - 1.7 * octave) - 0.5));
    size *= 0.48;
    scale *= 2.03;
  }
  return z - 0.15;
}

/** Value noise: random values on a grid, interpolated smoothly, between 0 and 1. @param {number} x @param {number} y */
function valueNoise(x, y) {
  const [i, j] = [Math.floor(x), Math.floor(y)];
  const [u, v] = [x - i, y - j].map((t) => t * t * (3 - 2 * t));
  return (randomAt(i, j) * (1 - u) + randomAt(i + 1, j) * u) * (1 - v) + (randomAt(i, j + 1) * (1 - u) + randomAt(i + 1, j + 1) * u) * v;
}

/** A pseudo-random number between 0 and 1, which is the same for the same integers. @param {number} a @param {number} b */
export function randomAt(a, b) {
  let hash = Math.imul(a, 374761393) + Math.imul(b, 668265263);
  hash = Math.imul(hash ^ (hash >>> 13), 1274126177);
  return ((hash ^ (hash >>> 16)) >>> 0) / 2 ** 32;
}
