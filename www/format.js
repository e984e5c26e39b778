/** Formats numbers and quantities for display, and reads numbers. */

const NARROW_NO_BREAK_SPACE = '\u202f';
const NO_BREAK_SPACE = '\u00a0';
/** Minimum size of a share, or of a value relative to a typical one, that is not a rounding error. */
const MIN_SHARE = 1e-7;
const SUPERSCRIPT_DIGITS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/** An integer with separated thousands. @param {number} n */
export function count(n) {
  return n.toLocaleString('en', { maximumFractionDigits: 0 }).replaceAll(',', NARROW_NO_BREAK_SPACE);
}

/** An integer with its noun. @param {number} n @param {string} one @param {string} [many] */
export const countOf = (n, one, many = `${one}s`) => `${count(n)} ${n === 1 ? one : many}`;

/** A number, or 0 if it is a rounding error compared with a typical value of its quantity. @param {number} value @param {number} typicalValue */
export function numberAgainst(value, typicalValue) {
  return number(Math.abs(value) < MIN_SHARE * Math.abs(typicalValue) ? 0 : value, 2);
}

/** A number, by a power of ten if it is very large or very small. @param {number} value @param {number} [digits] maximum number of significant digits */
export function number(value, digits = 3) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return scientific(value, digits);
  return value
    .toLocaleString('en', { maximumSignificantDigits: digits })
    .replaceAll(',', NARROW_NO_BREAK_SPACE)
    .replace('-', '−');
}

/** @param {number} value @param {number} digits */
function scientific(value, digits) {
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  const short = String(Number(mantissa)).replace('-', '−');
  const power = superscript(Number(exponent));
  return short === '1' ? `10${power}` : `${short}${NARROW_NO_BREAK_SPACE}·${NARROW_NO_BREAK_SPACE}10${power}`;
}

/** The number of a text as `number` formats it, or as people type it, with a decimal comma, too; NaN for another text. @param {string} text */
export function numberIn(text) {
  const word = text.trim().replaceAll(NARROW_NO_BREAK_SPACE, '').replaceAll('−', '-').replace(/^(-?\d*),(\d+)/, '$1.$2');
  const [, mantissa = '1', power] = word.match(/^(?:(.*?) ?[·×] ?)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)$/) ?? [];
  const exponent = [...power ?? ''].map((digit) => (digit === '⁻' ? '-' : SUPERSCRIPT_DIGITS.indexOf(digit))).join('');
  return word === '' ? NaN : Number(power ? `${mantissa}e${exponent}` : word);
}

/** An integer in superscript digits. @param {number} n */
export function superscript(n) {
  const digits = [...String(Math.abs(n))].map((digit) => SUPERSCRIPT_DIGITS[Number(digit)]);
  return (n < 0 ? '⁻' : '') + digits.join('');
}

/** An upper bound in percent, rounded up, so that it stays a bound; a dash if there is none. @param {number | undefined} share */
export function percentAtMost(share) {
  if (share === undefined || !Number.isFinite(share)) return '–';
  const percent = 100 * share;
  if (percent <= 0) return `0${NO_BREAK_SPACE}%`;
  const unit = 10 ** (Math.floor(Math.log10(percent)) - 1);
  const roundedUp = Math.ceil(percent / unit - 1e-9) * unit;
  return `${number(roundedUp, 2)}${NO_BREAK_SPACE}%`;
}

/** A share in percent. @param {number} share */
export function percent(share) {
  if (Math.abs(share) < MIN_SHARE) return `0${NO_BREAK_SPACE}%`;
  return `${number(100 * share, 2)}${NO_BREAK_SPACE}%`;
}

/** A share in percent, with its sign. @param {number} share */
export function signedPercent(share) {
  return `${share >= MIN_SHARE ? '+' : ''}${percent(share)}`;
}

/** A duration in seconds or milliseconds. @param {number} s in seconds */
export function seconds(s) {
  return s < 0.1 ? `${number(1000 * s, 2)}${NO_BREAK_SPACE}ms` : `${number(s, s < 100 ? 2 : 3)}${NO_BREAK_SPACE}s`;
}

/** λ with two significant digits, as it is typed: 1e6, 2.5e6. @param {number} lambda */
export function shortLambda(lambda) {
  return Number(lambda.toPrecision(2)).toExponential().replace('e+', 'e');
}

/** The unit of areas, or of volumes. @param {string | null} [unit] of lengths @param {'²' | '³'} [power] */
export function areaUnit(unit, power = '²') {
  return unit && unit !== 'units' ? `${unit}${power}` : `${power === '²' ? 'square' : 'cubic'} units`;
}

/** Words with a capital first letter. @param {string} words */
export const capitalised = (words) => words[0].toUpperCase() + words.slice(1);

/** The size of a file. @param {number} bytes */
export function fileSize(bytes) {
  if (bytes < 1e3) return `${count(bytes)}${NO_BREAK_SPACE}bytes`;
  return bytes < 1e6 ? `${number(bytes / 1e3, 2)}${NO_BREAK_SPACE}kB` : `${number(bytes / 1e6, 2)}${NO_BREAK_SPACE}MB`;
}
