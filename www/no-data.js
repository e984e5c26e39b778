/** Which value of a file is no data, where the user says so. */
import { numberIn } from './format.js';

/** @typedef {number | 'none'} NoData value that is no data, or that none but NaN is */

/** What a text gives as no data; nothing where it is no number. @param {string} text @returns {NoData | undefined} */
export function noDataOf(text) {
  const [word, value] = [text.trim(), numberIn(text)];
  return word === 'none' ? word : Number.isNaN(value) ? undefined : value;
}

/** The options of `read` that say what is no data: without them, the reader decides. @param {NoData} [noData] */
export function noDataOptions(noData) {
  return noData === undefined ? {} : { assumeNoData: false, ...(noData !== 'none' && { noData }) };
}
