/** A procedural design: lines and points that a surface is to pass through, free everywhere else. */

/** @import {Input} from './session.js' */

/** Pixels along a side. */
const SIZE = 120;

/** @returns {Input} */
export function designInput() {
  const data = constraintsOf(SIZE);
  return { name: 'design', width: SIZE, height: SIZE, data, pixelSize: 1, heightScale: 1, design: true };
}

/**
 * Two edges, curled differently, and a few pins between them: in the way of the paper's Figs. 18
 * and 19, where curves and points are given and the surface finds its folds.
 * @param {number} size pixels along a side
 * @returns {Float64Array} heights in pixels, NaN where the surface is free
 */
function constraintsOf(size) {
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
