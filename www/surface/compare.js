/** Differences of heights. */

/**
 * Root mean square of the height differences, over the pixels with data in both.
 * @param {ArrayLike<number>} heights
 * @param {number} scale unit of length per unit of `heights`
 * @param {ArrayLike<number>} truth
 * @param {number} truthScale unit of length per unit of `truth`
 */
export function rmsError(heights, scale, truth, truthScale) {
  let [sum, count] = [0, 0];
  for (let i = 0; i < truth.length; i++) {
    const difference = heights[i] * scale - truth[i] * truthScale;
    if (Number.isNaN(difference)) continue;
    sum += difference * difference;
    count++;
  }
  return Math.sqrt(sum / count);
}
