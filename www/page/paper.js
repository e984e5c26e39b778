/** Paper sizes for a flat page: which one it looks like, and a PDF of it in that size. */

import { turnedPicture } from './quarter-turn.js';

/** @import {Worker} from '../worker-task.js' */
/** @import {DewarpedPage} from './flatten.js' */

/** @typedef {keyof typeof PAPERS} PaperName */

/** Width and height of paper in millimetres. */
export const PAPERS = /** @type {const} */ ({
  a4: [210, 297], letter: [215.9, 279.4], a5: [148, 210], a3: [297, 420], 'a4-wide': [297, 210], 'letter-wide': [279.4, 215.9],
});
/** Largest difference of a page's proportions from those of a paper size, as a share, for the page to look like it. */
const MAX_RATIO_DIFFERENCE = 0.03;
/** Points, the unit of PDF, in a millimetre. */
const POINTS_PER_MILLIMETRE = 72 / 25.4;

/**
 * The paper size with a page's proportions, if there is one.
 * @param {number} width of one page, in any unit
 * @param {number} height
 * @returns {PaperName | null}
 */
export function similarPaper(width, height) {
  const off = (/** @type {PaperName} */ name) => Math.abs(Math.log((width / height) * (PAPERS[name][1] / PAPERS[name][0])));
  const names = /** @type {PaperName[]} */ (['a4', 'letter', 'a4-wide', 'letter-wide']);
  const nearest = names.reduce((best, name) => (off(name) < off(best) ? name : best));
  return off(nearest) < MAX_RATIO_DIFFERENCE ? nearest : null;
}

/**
 * A PDF with a page for each page of a flat photo, each as large as fits into the paper size, or in true size without one.
 * @param {Worker} worker
 * @param {DewarpedPage} flat
 * @param {number} pages that it shows side by side
 * @param {number} quarters by which each is turned clockwise
 * @param {readonly [number, number] | null} paper in millimetres
 */
export async function pagesPdf(worker, flat, pages, quarters, paper) {
  const columns = Array.from({ length: pages }, (_, i) => [Math.round((i * flat.width) / pages), Math.round(((i + 1) * flat.width) / pages)]);
  const made = [];
  for (const [from, to] of columns) {
    const { width, height, data } = turnedPicture(columnsOf(flat, from, to), quarters);
    const jpeg = await worker.writePhoto({ width, height, data }, { format: 'jpeg' });
    const dots = paper ? Math.max(width / paper[0], height / paper[1]) : flat.resolution;
    made.push({ jpeg, width, height, size: [width / dots, height / dots].map((side) => side * POINTS_PER_MILLIMETRE) });
  }
  return pdfOf(made);
}

/**
 * A part of a picture, from one column to another.
 * @param {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} picture RGBA
 * @param {number} from
 * @param {number} to
 */
function columnsOf({ width, height, data }, from, to) {
  if (to - from === width) return { width, height, data };
  const part = new Uint8ClampedArray(4 * (to - from) * height);
  for (let row = 0; row < height; row++) part.set(data.subarray(4 * (row * width + from), 4 * (row * width + to)), 4 * row * (to - from));
  return { width: to - from, height, data: part };
}

/**
 * A PDF with one picture on each page.
 * @param {readonly { jpeg: Uint8Array<ArrayBuffer>, width: number, height: number, size: number[] }[]} pages `size` in points
 * @returns {Uint8Array<ArrayBuffer>}
 */
function pdfOf(pages) {
  const encoder = new TextEncoder();
  /** @type {Uint8Array<ArrayBuffer>[]} */
  const chunks = [];
  let length = 0;
  const put = (/** @type {string | Uint8Array<ArrayBuffer>} */ chunk) => {
    const bytes = typeof chunk === 'string' ? encoder.encode(chunk) : chunk;
    chunks.push(bytes);
    length += bytes.length;
  };
  /** @type {number[]} */
  const places = [];
  const object = (/** @type {string} */ dictionary, /** @type {string | Uint8Array<ArrayBuffer>} */ stream = '') => {
    places.push(length);
    put(`${places.length} 0 obj\n${dictionary}\n`);
    if (stream) [`stream\n`, stream, '\nendstream\n'].forEach(put);
    put('endobj\n');
  };
  put('%PDF-1.4\n');
  object('<< /Type /Catalog /Pages 2 0 R >>');
  object(`<< /Type /Pages /Count ${pages.length} /Kids [${pages.map((_, i) => `${3 + 3 * i} 0 R`).join(' ')}] >>`);
  for (const { jpeg, width, height, size: [wide, high] } of pages) {
    const at = places.length + 1;
    const box = `${wide.toFixed(3)} ${high.toFixed(3)}`;
    object(`<< /Type /Page /Parent 2 0 R /MediaBox [0 0 ${box}] /Contents ${at + 1} 0 R /Resources << /XObject << /P ${at + 2} 0 R >> >> >>`);
    const content = `q ${wide.toFixed(3)} 0 0 ${high.toFixed(3)} 0 0 cm /P Do Q`;
    object(`<< /Length ${content.length} >>`, content);
    object(`<< /Type /XObject /Subtype /Image /Width ${width} /Height ${height} /ColorSpace /DeviceRGB /BitsPerComponent 8 /Filter /DCTDecode /Length ${jpeg.length} >>`, jpeg);
  }
  const table = length;
  const lines = places.map((place) => `${String(place).padStart(10, '0')} 00000 n \n`).join('');
  put(`xref\n0 ${places.length + 1}\n0000000000 65535 f \n${lines}trailer\n<< /Size ${places.length + 1} /Root 1 0 R >>\nstartxref\n${table}\n%%EOF\n`);
  const file = new Uint8Array(length);
  let place = 0;
  for (const chunk of chunks) {
    file.set(chunk, place);
    place += chunk.length;
  }
  return file;
}
