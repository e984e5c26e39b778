/** Heightfields whose answers are known. */
export { gridMesh } from '../../../tools/util/grid-mesh.mjs';

/**
 * An image of `f(x, y)` at the pixels' centres, `y` up.
 * @param {number} width
 * @param {number} height
 * @param {(x: number, y: number) => number} f
 * @param {number} [pixelSize]
 */
export function image(width, height, f, pixelSize = 1) {
  const data = new Float64Array(width * height);
  for (let i = 0; i < data.length; i += 1) {
    const x = ((i % width) + 0.5) * pixelSize;
    const y = (height - Math.floor(i / width) - 0.5) * pixelSize;
    data[i] = f(x, y);
  }
  return { width, height, data, pixelSize };
}

/**
 * Where a vertex of a lattice is.
 * @param {{ cols: number, spacing: number, origin?: readonly [number, number] }} lattice
 * @param {number} vertex
 */
export function placeOf({ cols, spacing, origin: [left, top] = [0, 0] }, vertex) {
  const row = Math.floor(vertex / cols);
  return [left + ((vertex % cols) - (row % 2) / 2) * spacing, top - row * spacing * Math.sqrt(0.75)];
}

/**
 * Heights of `f(x, y)` on the lattice.
 * @param {number} rows
 * @param {number} cols
 * @param {(x: number, y: number) => number} f
 * @param {number} [spacing]
 */
export function lattice(rows, cols, f, spacing = 1) {
  const heights = Float64Array.from({ length: rows * cols }, (_, i) => {
    const [x, y] = placeOf({ cols, spacing }, i);
    return f(x, y);
  });
  return { rows, cols, spacing, heights };
}

/** A photo of such colours (red, green, blue, alpha). @param {number} width @param {number} height @param {(x: number, y: number) => number[]} colour */
export function photoOf(width, height, colour) {
  const data = new Uint8ClampedArray(4 * width * height);
  for (let i = 0; i < width * height; i += 1) data.set(colour(i % width, Math.floor(i / width)), 4 * i);
  return { width, height, data };
}

/** @type {(x: number, y: number) => number} */
export const plane = (x, y) => 5 + 0.3 * x - 0.2 * y;

/**
 * The top of a cylinder that lies across a square of this size.
 * @param {number} size
 */
export function cylinder(size) {
  const radius = 0.8 * size;
  return (/** @type {number} */ x, /** @type {number} */ y) => {
    const across = 0.8 * (x - size / 2) + 0.6 * (y - size / 2);
    return Math.sqrt(radius * radius - across * across);
  };
}

/**
 * The same with noise, the same each time.
 * @param {(x: number, y: number) => number} f
 * @param {number} amplitude
 */
export function noisy(f, amplitude) {
  let state = 1;
  return (/** @type {number} */ x, /** @type {number} */ y) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return f(x, y) + amplitude * (state / 2 ** 31 - 1);
  };
}

/**
 * Work for longer than any test lasts.
 * @param {number} [size]
 */
export function endless(size = 150) {
  const input = image(size, size, noisy(cylinder(size), 1));
  const options = { lambda: /** @type {const} */ ('small'), gap: 1e-12, maxIterations: 1e9 };
  return { input, options };
}

/**
 * The largest difference; infinite where one has data and the other has not.
 * @param {ArrayLike<number>} found
 * @param {ArrayLike<number>} expected
 */
export function deviation(found, expected) {
  let most = 0;
  for (let i = 0; i < expected.length; i += 1) {
    const [a, b] = [found[i], expected[i]];
    if (Number.isNaN(a) !== Number.isNaN(b)) return Infinity;
    if (!Number.isNaN(a)) most = Math.max(most, Math.abs(a - b));
  }
  return most;
}

/**
 * @param {ArrayLike<number>} found
 * @param {ArrayLike<number>} expected
 */
export function rms(found, expected) {
  let sum = 0;
  for (let i = 0; i < expected.length; i += 1) sum += (found[i] - expected[i]) ** 2;
  return Math.sqrt(sum / expected.length);
}

/** A box from the origin to a corner. @param {number[]} corner */
export function boxTo(corner) {
  const positions = Float64Array.from({ length: 24 }, (_, i) => corner[i % 3] * ((Math.floor(i / 3) >> i % 3) & 1));
  const quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  return { positions, triangles: Uint32Array.from(quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])) };
}
