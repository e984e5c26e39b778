/** Numbers read back from the page's text. */

/**
 * A number as the page writes it, with its grouping and powers of ten.
 * @param {string} text
 */
export function parsed(text) {
  const digits = '⁰¹²³⁴⁵⁶⁷⁸⁹';
  const plain = text
    .replace(/[\s\u202f\u00a0]/g, '')
    .replaceAll('−', '-')
    .replace(/·?10(⁻?)([⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, minus, power) =>
      `e${minus ? '-' : ''}${[...power].map((digit) => digits.indexOf(digit)).join('')}`)
    .replace(/^e/, '1e');
  return Number.parseFloat(plain);
}
