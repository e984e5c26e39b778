/** A box of triangles, closed, whose vertices are off its sides by noise. */

/** @typedef {import('./files.mjs').Mesh} Mesh */
/** @typedef {[number, number, number]} Place */

/** Its lengths along x, y and z. */
export const SIDES = /** @type {const} */ ([3, 2, 1.2]);

/** A box of twelve triangles whose opposite corners are the origin and a place. @param {readonly number[]} sides @returns {Mesh} */
export const cuboid = (sides) => ({
  points: Array.from({ length: 8 }, (_, i) => /** @type {Place} */ (sides.map((side, k) => side * ((i >> k) & 1)))),
  triangles: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].flatMap(([a, b, c, d]) => /** @type {Place[]} */ ([[a, b, c], [a, c, d]])),
});

/** Random numbers from −1 to 1, the same each time. */
export function randomNumbers() {
  let seed = 1;
  return () => (seed = (seed * 16807) % 2147483647) / 1073741823.5 - 1;
}

/**
 * @param {number} fine edges for each unit of length
 * @param {number} noise largest in each direction
 * @returns {Mesh}
 */
export function noisyBox(fine, noise) {
  const random = randomNumbers();
  /** @type {Map<string, number>} */
  const numbers = new Map();
  /** @type {Place[]} */
  const points = [];
  /** @type {Place[]} */
  const triangles = [];
  /** @param {Place} place */
  const vertex = (place) => {
    const name = place.map((value) => value.toFixed(6)).join();
    const known = numbers.get(name);
    if (known !== undefined) return known;
    numbers.set(name, points.length);
    return points.push(/** @type {Place} */ (place.map((value) => value + noise * random()))) - 1;
  };
  for (const [axis, u, v] of [[0, 1, 2], [1, 2, 0], [2, 0, 1]]) {
    const [wide, high] = [Math.round(fine * SIDES[u]), Math.round(fine * SIDES[v])];
    for (const end of [0, 1]) {
      /** @param {number} i @param {number} j */
      const corner = (i, j) => {
        /** @type {Place} */
        const place = [0, 0, 0];
        [place[axis], place[u], place[v]] = [end * SIDES[axis], (i / wide) * SIDES[u], (j / high) * SIDES[v]];
        return vertex(place);
      };
      for (let i = 0; i < wide; i++) {
        for (let j = 0; j < high; j++) {
          const [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
          triangles.push(...(end ? [[a, b, c], [a, c, d]] : [[a, c, b], [a, d, c]]).map((one) => /** @type {Place} */ (one)));
        }
      }
    }
  }
  return { points, triangles };
}

/** How far a place is off the sides of the box. @param {readonly number[]} place */
export function offBox(place) {
  const inside = Math.min(...place.flatMap((value, k) => [value, SIDES[k] - value]));
  if (inside >= 0) return inside;
  return Math.hypot(...place.map((value, k) => Math.max(0, -value, value - SIDES[k])));
}
