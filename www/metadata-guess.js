/** What a file of numbers does not say: the scale, holes, the lattice, whether they are depths. Guessed, and said. */
import { number } from './format.js';
import { GUESS_WORDS } from './messages.js';

/** @typedef {{ width: number, height: number, data: Float64Array, pixelSize: number, heightScale: number, unit?: string | null, dataType?: string, rowSpacing?: number }} Numbers `rowSpacing`: of rows, in pixels, where it is not 1 */

/** Smallest share of the longer side that a relief may well have, of a file that does not give its pixels' size. */
const MIN_LIKELY_RELIEF_SHARE = 0.01;
/** Largest such share: a fold of 76 degrees across the whole image, which a user is asked about but which is not rescaled. */
const MAX_LIKELY_RELIEF_SHARE = 4;
/** What a relief is made to be where nothing else suggests itself. */
const GUESS = 1 / 4;
/** Differences of neighbours, as a share of the depth, from where on they are the edge of something in front. */
const JUMP = 0.15;
/** More vertices than this take long. */
const MANY = 1.2e6;

/**
 * The size of a pixel in the unit of the heights, where it is not in the file and cannot be 1.
 * @param {Numbers} numbers
 * @returns {{ pixelSize: number, words: string } | null}
 */
export function guessedPixel({ width, height, data, pixelSize, heightScale, unit, dataType = '', rowSpacing = 1 }) {
  // Of whole numbers the package suggests the height scale.
  if (pixelSize !== 1 || unit || heightScale !== 1 || /^u/.test(dataType)) return null;
  const side = Math.max(width, height * rowSpacing);
  const relief = reliefOf(data);
  const share = relief / side;
  if (relief === 0 || (share >= MIN_LIKELY_RELIEF_SHARE && share <= MAX_LIKELY_RELIEF_SHARE)) return null;
  const steep = share > MAX_LIKELY_RELIEF_SHARE;
  if (relief >= 0.02 && relief <= 2) {
    return { pixelSize: Number((1 / side).toPrecision(6)), words: GUESS_WORDS.side(number(relief, 2), steep) };
  }
  const guessed = Number((relief / GUESS / side).toPrecision(1));
  return { pixelSize: guessed, words: GUESS_WORDS.pixels(number(relief, 2), steep, number(guessed)) };
}

/** From the second to the ninety-eighth hundredth. @param {Float64Array} data */
export function reliefOf(data) {
  const step = Math.ceil(data.length / 1e5);
  const some = Float64Array.from({ length: Math.ceil(data.length / step) }, (_, i) => data[i * step]).filter(Number.isFinite).sort();
  return some.length > 0 ? some[Math.floor(0.98 * (some.length - 1))] - some[Math.ceil(0.02 * (some.length - 1))] : 0;
}

/**
 * Whether 0 is no height: it is there often, and everything else is on one side of it and far away.
 * @param {Float64Array} data
 */
export function zeroIsNothing(data) {
  let [zeros, low, high] = [0, Infinity, -Infinity];
  for (const value of data) {
    if (value === 0) zeros++;
    else if (value < low) low = value;
    if (value !== 0 && value > high) high = value;
  }
  if (zeros < 0.002 * data.length || !(low <= high) || low * high < 0) return false;
  return Math.min(Math.abs(low), Math.abs(high)) > 0.03 * (high - low);
}

/**
 * Whether the odd rows lie half a step to the left of the even ones: heights are then between those of the two
 * neighbours above and below, and not those right above and below.
 * @param {Pick<Numbers, 'width' | 'height' | 'data'>} numbers
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

/** Names of files that hold depths. */
const NAMED_DEPTHS = /depth|tiefe|kinect|lidar|tof(?![a-z])/i;
/** Share of pixels without a depth, from which on a camera has left them out. */
const MIN_HOLE_SHARE = 0.002;

/**
 * Whether what looks like depths is taken for depths without asking: the file is called so, or a camera has left pixels out.
 * @param {string} name of the file
 * @param {Float64Array} data NaN where there is no depth
 */
export function areSurelyDepths(name, data) {
  return NAMED_DEPTHS.test(name) || data.reduce((sum, value) => sum + Number(Number.isNaN(value)), 0) > MIN_HOLE_SHARE * data.length;
}

/**
 * Whether these are depths from a camera rather than heights: they are far from 0, and jump where one thing is in
 * front of another.
 * @param {string} name of the file
 * @param {Pick<Numbers, 'width' | 'height' | 'data' | 'dataType'>} numbers
 * @returns {'mm' | 'm' | null} what they seem to be counted in
 */
export function depthsIn(name, { width, height, data, dataType = '' }) {
  const whole = /^u16|^i32|^u32/.test(dataType);
  if (!whole && !/^f/.test(dataType)) return null;
  let [valid, metres, millimetres, nothing] = [0, 0, 0, 0];
  /** How much larger than usual a jump is, too: a ramp that begins at 0 has none. */
  const usual = typicalStep(data, width);
  let [pairs, jumps] = [0, 0];
  for (let i = 0; i < data.length; i++) {
    const depth = data[i];
    if (isNoDepth(depth)) {
      nothing++;
      continue;
    }
    valid++;
    if (depth >= 0.05 && depth <= 60) metres++;
    if (depth >= 100 && depth <= 20_000) millimetres++;
    const beside = i % width < width - 1 ? data[i + 1] : NaN;
    if (isNoDepth(beside)) continue;
    pairs++;
    if (Math.abs(beside - depth) > Math.max(JUMP * Math.min(beside, depth), 5 * usual)) jumps++;
  }
  const named = NAMED_DEPTHS.test(name);
  // An edge in front of something crosses about as many pixels as the image is wide; noise is everywhere.
  const edges = jumps > 0.3 * Math.min(width, height) && jumps < 0.05 * pairs;
  const holes = nothing > MIN_HOLE_SHARE * data.length;
  if (valid === 0 || !(named || (edges && (holes || !whole)))) return null;
  if (!whole && metres > 0.98 * valid) return 'm';
  return (whole || named) && millimetres > 0.98 * valid ? 'mm' : null;
}

/** Mean difference of neighbours along rows. @param {Float64Array} data @param {number} width */
function typicalStep(data, width) {
  let [sum, pairs] = [0, 0];
  for (let i = 0; i + 1 < data.length; i++) {
    if (i % width === width - 1 || isNoDepth(data[i]) || isNoDepth(data[i + 1])) continue;
    sum += Math.abs(data[i + 1] - data[i]);
    pairs++;
  }
  return pairs > 0 ? sum / pairs : 0;
}

/** What a camera stores where it has seen nothing, or the sky. @param {number} depth */
export function isNoDepth(depth) {
  return !(depth > 0 && depth < 65_000);
}

/**
 * Pixels between vertices, so that opening a large file does not take minutes.
 * @param {Pick<Numbers, 'width' | 'height'>} size
 */
export function coarseningFor({ width, height }) {
  return [1, 2, 4].find((step) => width * height <= MANY * step * step) ?? 4;
}
