/** Numbers as people read them. */

const NARROW = '\u202f';
const BREAKLESS = '\u00a0';
const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/** @param {number} n */
export function count(n) {
  return n.toLocaleString('en', { maximumFractionDigits: 0 }).replaceAll(',', NARROW);
}

/**
 * A number of a quantity of which a typical size is known: 0 where it is a rounding error.
 * @param {number} value
 * @param {number} size
 */
export function numberAgainst(value, size) {
  return number(Math.abs(value) < 1e-9 * Math.abs(size) ? 0 : value, 2);
}

/**
 * Three significant digits, by powers of ten where that is shorter.
 * @param {number} value
 * @param {number} [digits]
 */
export function number(value, digits = 3) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return scientific(value, digits);
  return value
    .toLocaleString('en', { maximumSignificantDigits: digits })
    .replaceAll(',', NARROW)
    .replace('-', '−');
}

/**
 * @param {number} value
 * @param {number} digits
 */
function scientific(value, digits) {
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  const short = String(Number(mantissa)).replace('-', '−');
  const power = superscript(Number(exponent));
  return short === '1' ? `10${power}` : `${short}${NARROW}·${NARROW}10${power}`;
}

/** @param {number} n an integer */
export function superscript(n) {
  const digits = [...String(Math.abs(n))].map((digit) => SUPERSCRIPTS[Number(digit)]);
  return (n < 0 ? '⁻' : '') + digits.join('');
}

/**
 * A bound in percent, if there is one. Rounded up, for what is certified must not be overstated.
 * @param {number | undefined} share
 */
export function percentAtMost(share) {
  if (share === undefined || !Number.isFinite(share)) return '–';
  const percent = 100 * share;
  if (percent <= 0) return `0${BREAKLESS}%`;
  const unit = 10 ** (Math.floor(Math.log10(percent)) - 1);
  const up = Math.ceil(percent / unit - 1e-9) * unit;
  return `${number(up, 2)}${BREAKLESS}%`;
}

/** Shares below this are rounding errors. */
const MIN_SHARE = 1e-7;

/** @param {number} share */
export function percent(share) {
  if (Math.abs(share) < MIN_SHARE) return `0${BREAKLESS}%`;
  return `${number(100 * share, 2)}${BREAKLESS}%`;
}

/** @param {number} share with its sign */
export function signed(share) {
  return `${share >= MIN_SHARE ? '+' : ''}${percent(share)}`;
}

/** What is under the pointer on a sheet. @param {number} strain NaN beside it */
export function strainInWords(strain) {
  return Number.isNaN(strain) ? '' : `strain ${signed(strain)}`;
}

/** @param {number} angle in radians */
export function degrees(angle) {
  return `${number((angle * 180) / Math.PI, 2)}°`;
}

/** @param {number} s */
export function seconds(s) {
  return s < 0.1 ? `${number(1000 * s, 2)}${BREAKLESS}ms` : `${number(s, s < 100 ? 2 : 3)}${BREAKLESS}s`;
}

/**
 * λ as a person would type it: 1e6, 2.5e6.
 * @param {number} lambda
 */
export function shortest(lambda) {
  return Number(lambda.toPrecision(2)).toExponential().replace('e+', 'e');
}

/**
 * What is under the pointer.
 * @param {number} height NaN where there is none
 * @param {string} [unit]
 * @param {string} [value] what else is known there
 */
export function readingOf(height, unit = 'units', value = '') {
  return Number.isNaN(height) ? '' : [`height ${number(height)} ${unit}`, value].filter(Boolean).join(' · ');
}

/** @param {number} bytes */
export function fileSize(bytes) {
  if (bytes < 1e3) return `${count(bytes)}${BREAKLESS}bytes`;
  return bytes < 1e6 ? `${number(bytes / 1e3, 2)}${BREAKLESS}kB` : `${number(bytes / 1e6, 2)}${BREAKLESS}MB`;
}
