/** Edits of heights by brush and lasso: the pixels of a stroke, their new values, and undo. */

/** @import {Input} from './session.js' */
/** @typedef {readonly [number, number]} Place position in pixels; (0, 0) is the upper left corner */
/** @typedef {'out' | 'doubt' | 'hold' | 'crop'} Effect removes heights, lowers their confidence, makes them constraints, or removes all heights outside */
/** @typedef {'data' | 'confidence' | 'constraints'} Field */
/**
 * Values of a field before an edit; null if the input did not have the field.
 * @typedef {{ field: Field, pixels: Uint32Array, values: Float64Array | null }} UndoStep
 */

/** Maximum confidence of a height after the user has marked it as doubtful. */
const MAX_DOUBTFUL_CONFIDENCE = 0.1;

/**
 * Pixels within a distance of a polyline.
 * @param {{ width: number, height: number }} size
 * @param {readonly Place[]} line
 * @param {number} radius in pixels
 */
export function pixelsAlong({ width, height }, line, radius) {
  /** @type {Set<number>} */
  const found = new Set();
  line.forEach(([bx, by], i) => {
    const [ax, ay] = line[Math.max(0, i - 1)];
    const length = (bx - ax) ** 2 + (by - ay) ** 2;
    const [left, right] = [Math.max(0, Math.floor(Math.min(ax, bx) - radius)), Math.min(width - 1, Math.ceil(Math.max(ax, bx) + radius))];
    const [top, bottom] = [Math.max(0, Math.floor(Math.min(ay, by) - radius)), Math.min(height - 1, Math.ceil(Math.max(ay, by) + radius))];
    for (let row = top; row <= bottom; row++) {
      for (let col = left; col <= right; col++) {
        const [x, y] = [col + 0.5, row + 0.5];
        const t = length > 0 ? Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length)) : 0;
        if (Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)) <= radius) found.add(row * width + col);
      }
    }
  });
  return Uint32Array.from(found);
}

/**
 * Pixels inside a polygon (even-odd rule).
 * @param {{ width: number, height: number }} size
 * @param {readonly Place[]} line
 * @param {boolean} [outside] whether the pixels outside of it are returned instead
 */
export function pixelsInside({ width, height }, line, outside = false) {
  const found = [];
  for (let row = 0; row < height; row++) {
    const y = row + 0.5;
    /** @type {number[]} */
    const crossings = [];
    line.forEach(([bx, by], i) => {
      const [ax, ay] = line[(i || line.length) - 1];
      if (ay <= y !== by <= y) crossings.push(ax + ((y - ay) / (by - ay)) * (bx - ax));
    });
    crossings.sort((a, b) => a - b);
    for (let col = 0, passed = 0; col < width; col++) {
      while (crossings[passed] <= col + 0.5) passed++;
      if ((passed % 2 === 1) !== outside) found.push(row * width + col);
    }
  }
  return Uint32Array.from(found);
}

/**
 * The effect of an edit on an input: the changed field, and the step that undoes it.
 * @param {Input} input
 * @param {Uint32Array} pixels
 * @param {Effect} effect
 * @param {(pixel: number) => number} heightAt height of a new constraint, in steps of `heightScale`
 */
export function applyEdit(input, pixels, effect, heightAt) {
  const field = /** @type {const} */ ({ out: 'data', crop: 'data', doubt: 'confidence', hold: 'constraints' })[effect];
  const known = input[field];
  const values = known?.slice() ?? new Float64Array(input.data.length).fill(effect === 'doubt' ? 1 : NaN);
  for (const pixel of pixels) {
    if (field === 'data') values[pixel] = NaN;
    else if (field === 'confidence') values[pixel] = Math.min(values[pixel], MAX_DOUBTFUL_CONFIDENCE);
    else values[pixel] = heightAt(pixel);
  }
  /** @type {UndoStep} */
  const undo = { field, pixels, values: known ? Float64Array.from(pixels, (pixel) => known[pixel]) : null };
  return { change: /** @type {Partial<Pick<Input, Field>>} */ ({ [field]: values }), undo };
}

/**
 * The change that undoes an edit.
 * @param {Input} input
 * @param {UndoStep} step
 * @returns {Partial<Pick<Input, Field>>}
 */
export function undoEdit(input, { field, pixels, values }) {
  const now = input[field]?.slice();
  if (!values || !now) return { [field]: undefined };
  pixels.forEach((pixel, i) => (now[pixel] = values[i]));
  return { [field]: now };
}
