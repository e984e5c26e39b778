/** Best similarities between places. */

/** @typedef {[x: number, y: number, p: number, q: number]} Pair a place, and where it should be */

/**
 * @typedef {object} Similarity x, y to [a x − b y + s, b x + a y + t]
 * @property {number} a
 * @property {number} b
 * @property {number} s
 * @property {number} t
 * @property {number} rms distance that is left
 */

/**
 * By least squares, without reflection: in complex numbers a quotient.
 * @param {readonly Pair[]} pairs
 * @returns {Similarity}
 */
export function similarity(pairs) {
  const mean = [0, 1, 2, 3].map((k) => pairs.reduce((sum, pair) => sum + pair[k], 0) / pairs.length);
  const product = (/** @type {number} */ k, /** @type {number} */ l) =>
    pairs.reduce((sum, pair) => sum + (pair[k] - mean[k]) * (pair[l] - mean[l]), 0) / pairs.length;
  const [from, to] = [product(0, 0) + product(1, 1), product(2, 2) + product(3, 3)];
  const [re, im] = [product(0, 2) + product(1, 3), product(0, 3) - product(1, 2)];
  const [a, b] = [re / from, im / from];
  const [x, y, p, q] = mean;
  const rms = Math.sqrt(Math.max(0, to - (re * re + im * im) / from));
  return { a, b, s: p - a * x + b * y, t: q - b * x - a * y, rms };
}
