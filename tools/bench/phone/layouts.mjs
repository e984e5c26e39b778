/** Printed pages as they are, and not only columns of text: set by a browser, as large as a sheet of A4. */
import { readPhoto } from '../../../pkg/direct.js';
import { FINE, paragraphs, withBrowser } from './print.mjs';
import { greyOf } from './truth.mjs';

/** @typedef {import('./sensor.mjs').Grey} Grey */

/** @param {number} points */
const dots = (points) => (points / 72) * FINE;
const [WIDE, HIGH] = [210, 297].map((millimetres) => Math.round((millimetres / 25.4) * FINE));

/** A picture with horizons, hills and a frame, none of which is a line of text. */
const picture = `<svg viewBox="0 0 100 60" style="width: 100%; display: block">
  <defs><linearGradient id="sky" x2="0" y2="1"><stop stop-color="#666"/><stop offset="1" stop-color="#eee"/></linearGradient></defs>
  <rect width="100" height="60" fill="url(#sky)"/><path d="M0 40L20 22L34 37L60 14L100 43V60H0Z" fill="#555"/>
  <path d="M0 50Q30 40 55 49T100 46V60H0Z" fill="#222"/><circle cx="80" cy="12" r="6" fill="#fff"/></svg>`;

/** @param {string[]} texts */
const set = (texts) => texts.map((text) => `<p>${text}</p>`).join('');

function table() {
  const rows = Array.from({ length: 9 }, (_, row) =>
    `<tr>${Array.from({ length: 4 }, (_, col) => `<td>${col === 0 ? `Item ${row + 1}` : (37 * (row + 3) * (col + 1)) % 911}</td>`).join('')}</tr>`);
  return `<table>${rows.join('')}</table>`;
}

/** Each as its body, and the style of that. */
const LAYOUTS = /** @type {const} */ ({
  text: { style: `font: ${dots(11)}px/1.4 'DejaVu Serif', serif`, body: () => set(paragraphs(1, 11)) },
  columns: {
    style: `font: ${dots(9)}px/1.25 'Liberation Sans', sans-serif`,
    body: () => `<h1>Of sheets that were bent</h1><div class="columns"><div>${set(paragraphs(4, 5))}${picture}${set(paragraphs(5, 4))}</div>`
      + `<div><h2>What was measured</h2>${set(paragraphs(6, 2))}${table()}${set(paragraphs(7, 6))}</div></div>`,
  },
});

/** @typedef {keyof typeof LAYOUTS} Layout */

/**
 * Each of these layouts as it is photographed.
 * @template {Layout} L
 * @param {readonly L[]} names
 * @returns {Promise<Record<L, Grey>>}
 */
export function layouts(names) {
  return withBrowser(async (browser) => {
    const found = /** @type {Record<L, Grey>} */ ({});
    for (const name of names) {
      const { style, body } = LAYOUTS[name];
      const page = await browser.newPage({ viewport: { width: WIDE, height: HIGH } });
      await page.setContent(`<style>body { box-sizing: border-box; height: ${HIGH}px; margin: 0; padding: ${dots(50)}px; overflow: hidden; background: white; ${style} }
        p { margin: 0 0 0.7em } h1 { font-size: 2.4em; line-height: 1.1; margin: 0 0 0.6em } h2 { font-size: 1.5em; margin: 0 0 0.5em }
        .columns { display: grid; grid-template-columns: 1fr 1fr; gap: ${dots(20)}px }
        table { border-collapse: collapse; width: 100%; margin: 1em 0 } td { border: 2px solid #333; padding: 0.2em 0.5em }</style>${body()}`);
      found[name] = greyOf(readPhoto(await page.screenshot({ type: 'png' })));
      await page.close();
    }
    return found;
  });
}
