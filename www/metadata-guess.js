/** Guesses of metadata that a file of heights lacks: its lattice, and whether its values are depths. */

/** @typedef {{ width: number, height: number, data: Float64Array, dataType?: string }} HeightValues */

/** Minimum difference of neighbouring depths at an occlusion, as a share of the smaller depth. */
const MIN_DEPTH_JUMP_SHARE = 0.15;
/** Minimum difference of neighbouring depths at an occlusion, in mean differences: a ramp that begins at 0 has no occlusion. */
const MIN_DEPTH_JUMP_STEPS = 5;
/** Maximum number of vertices of a solve that takes less than a few minutes. */
const MAX_QUICK_VERTICES = 1.2e6;

/**
 * Whether the values are probably those of a hexagonal lattice, whose odd rows lie half a spacing to the left: then the
 * mean of the four vertices above and below predicts a height better than the mean of two pixels in the same column.
 * @param {Pick<HeightValues, 'width' | 'height' | 'data'>} values
 */
export function isHexagonal({ width, height, data }) {
  let [square, left, right] = [0, 0, 0];
  for (let row = 1; row < height - 1; row++) {
    const shift = row % 2 === 1 ? -1 : 1;
    for (let i = row * width + 1; i < (row + 1) * width - 1; i++) {
      const straight = data[i - width] + data[i + width];
      const one = data[i] - (straight + data[i - width + shift] + data[i + width + shift]) / 4;
      const other = data[i] - (straight + data[i - width - shift] + data[i + width - shift]) / 4;
      if (!Number.isFinite(one + other)) continue;
      square += (data[i] - straight / 2) ** 2;
      left += one ** 2;
      right += other ** 2;
    }
  }
  return left < 0.6 * square && right > 1.5 * square;
}

/** Names of files that probably hold depths. */
const DEPTH_FILE_NAME = /depth|tiefe|kinect|lidar|tof(?![a-z])/i;
/** Minimum share of pixels without a depth in an image from a camera. */
const MIN_HOLE_SHARE = 0.002;

/**
 * Whether probable depths are taken for depths without asking the user: the name of the file says so, or pixels have no depth.
 * @param {string} name name of the file
 * @param {Float64Array} data NaN where there is no depth
 */
export function areSurelyDepths(name, data) {
  return DEPTH_FILE_NAME.test(name) || data.reduce((sum, value) => sum + Number(Number.isNaN(value)), 0) > MIN_HOLE_SHARE * data.length;
}

/**
 * The probable unit of depths from a camera, or null for heights: depths have occlusions, and lie within the range of
 * such cameras.
 * @param {string} name name of the file
 * @param {Pick<HeightValues, 'width' | 'height' | 'data' | 'dataType'>} values
 * @returns {'mm' | 'm' | null}
 */
export function depthUnitOf(name, { width, height, data, dataType = '' }) {
  const isInteger = /^u16|^i32|^u32/.test(dataType);
  if (!isInteger && !/^f/.test(dataType)) return null;
  let [valid, metres, millimetres, noDepth] = [0, 0, 0, 0];
  const minJump = MIN_DEPTH_JUMP_STEPS * meanStep(data, width);
  let [pairs, jumps] = [0, 0];
  for (let i = 0; i < data.length; i++) {
    const depth = data[i];
    if (isNoDepth(depth)) {
      noDepth++;
      continue;
    }
    valid++;
    if (depth >= 0.05 && depth <= 60) metres++;
    if (depth >= 100 && depth <= 20_000) millimetres++;
    const neighbour = i % width < width - 1 ? data[i + 1] : NaN;
    if (isNoDepth(neighbour)) continue;
    pairs++;
    if (Math.abs(neighbour - depth) > Math.max(MIN_DEPTH_JUMP_SHARE * Math.min(neighbour, depth), minJump)) jumps++;
  }
  const isNamedDepth = DEPTH_FILE_NAME.test(name);
  // Occlusions lie along curves, about as long as the image is wide; noise is everywhere.
  const hasOcclusions = jumps > 0.3 * Math.min(width, height) && jumps < 0.05 * pairs;
  const hasHoles = noDepth > MIN_HOLE_SHARE * data.length;
  if (valid === 0 || !(isNamedDepth || (hasOcclusions && (hasHoles || !isInteger)))) return null;
  if (!isInteger && metres > 0.98 * valid) return 'm';
  return (isInteger || isNamedDepth) && millimetres > 0.98 * valid ? 'mm' : null;
}

/** Mean absolute difference of neighbours in a row. @param {Float64Array} data @param {number} width */
function meanStep(data, width) {
  let [sum, pairs] = [0, 0];
  for (let i = 0; i + 1 < data.length; i++) {
    if (i % width === width - 1 || isNoDepth(data[i]) || isNoDepth(data[i + 1])) continue;
    sum += Math.abs(data[i + 1] - data[i]);
    pairs++;
  }
  return pairs > 0 ? sum / pairs : 0;
}

/** Whether a value stands for no depth: cameras store 0, or a very large value for the sky. @param {number} depth */
export function isNoDepth(depth) {
  return !(depth > 0 && depth < 65_000);
}

/**
 * The lattice spacing in pixels that keeps the solve of a large image short.
 * @param {Pick<HeightValues, 'width' | 'height'>} size
 */
export function coarseningFor({ width, height }) {
  return [1, 2, 4].find((step) => width * height <= MAX_QUICK_VERTICES * step * step) ?? 4;
}
