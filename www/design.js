/** A procedural design: lines and points that a surface is to pass through, free everywhere else. */

/**
 * Two sheets' edges, curled differently, and a few pins between them: after the paper's Figs. 18
 * and 19, where a designer fixes curves and points and lets the surface find its folds.
 * @param {number} size pixels along a side
 * @returns {Float64Array} heights in pixels, NaN where the surface is free
 */
export function designConstraints(size) {
  const constraints = new Float64Array(size * size).fill(NaN);
  /** @param {number} x @param {number} y both from 0 to 1, y up @param {number} z in sides */
  const pin = (x, y, z) => {
    const [col, row] = [Math.round(x * (size - 1)), Math.round((1 - y) * (size - 1))];
    constraints[row * size + col] = z * size;
  };
  for (let i = 0; i < size; i++) {
    const x = i / (size - 1);
    pin(x, 0, 0.24 * Math.sin(Math.PI * x));
    pin(x, 1, 0.1 * Math.sin(2 * Math.PI * x) + 0.05);
  }
  pin(0, 0.5, 0.1);
  pin(1, 0.5, 0);
  pin(0.5, 0.55, 0.3);
  return constraints;
}
