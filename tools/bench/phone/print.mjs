/** Printed pages: text, set by a browser. */
import { readPhoto } from '../../../pkg/direct.js';
import { launch, skip } from '../../../tests/js/support/browser.mjs';
import { Problem } from '../../util/problem.mjs';
import { uniform } from './sensor.mjs';
import { greyOf } from './truth.mjs';

/** @typedef {import('./sensor.mjs').Grey} Grey */
/** @typedef {{ original: Grey, fine: Grey, text: string }} Print as it is compared with, and as it is photographed */

/** Dots per inch of flat images and of their originals; what is photographed has twice as many. */
export const DPI = 150;
export const FINE = 2 * DPI;

const SENTENCES = [
  'A sheet of paper can be rolled and folded, but it does not stretch.',
  'Whoever opens a book in the middle sees how both pages rise from the gutter and then run almost level to the edge.',
  'The letter had been carried in a coat for several weeks, and its creases would not lie flat any more.',
  'Through every point of such a surface runs a straight line along which the normal stays the same.',
  'Four travellers asked for the way to the harbour; only one of them had brought a map.',
  'Light from the window falls across the desk and makes every dent in the page visible.',
  'In the year 1827 a famous paper showed that bending leaves the product of both curvatures as it was.',
  'Please return this form before the end of March, together with two photographs and the signed copy.',
  'Cones and cylinders belong to the same family, as do the tangents of any curve in space.',
  'When the rain had stopped, the gardener carried 36 empty pots back into the shed.',
  'A printer thinks of margins first, then of lines, and at last of the words themselves.',
  'The second volume is thicker than the first, so that its pages bend more steeply near the spine.',
  'Nobody could say afterwards who had crumpled the plan, or why it was thrown away.',
  'Measured along the page every word keeps its length, whatever the camera believes.',
  'Our train leaves at a quarter past nine from platform 12 and calls at seven stations.',
  'Good maps of the coast were rare in those days, and a fair wind was rarer still.',
];

/**
 * Paragraphs, the same each time.
 * @param {number} seed
 * @param {number} count
 */
export function paragraphs(seed, count) {
  const next = uniform(seed);
  const order = SENTENCES.map((sentence) => ({ sentence, at: next() })).sort((a, b) => a.at - b.at);
  return Array.from({ length: count }, (_, i) =>
    Array.from({ length: 3 }, (_, k) => order[(3 * i + k) % order.length].sentence).join(' '));
}

/** @param {{ width: number, height: number, margin: number, points: number, columns: string[][] }} layout in metres */
function html({ width, height, margin, points, columns }) {
  const dots = (/** @type {number} */ metres) => (metres / 0.0254) * FINE;
  const size = (points / 72) * FINE;
  const column = dots(width / columns.length);
  const boxes = columns.map((texts) => `<div style="box-sizing: border-box; width: ${column}px; height: ${dots(height)}px;`
    + ` padding: ${dots(margin)}px; overflow: hidden">${texts.map((text) => `<p>${text}</p>`).join('')}</div>`);
  return `<style>body { margin: 0; display: flex; background: white; color: black;`
    + ` font: ${size}px/1.4 'DejaVu Serif', 'Liberation Serif', serif } p { margin: 0 0 ${0.7 * size}px }</style>${boxes.join('')}`;
}

/**
 * The text that the pages carry which are one sheet, and that of a spread.
 * @returns {Promise<{ sheet: Print, spread: Print }>}
 */
export function prints() {
  return withBrowser(async (browser) => {
    /** @param {Omit<Parameters<typeof html>[0], 'margin'>} layout @returns {Promise<Print>} */
    const print = async (layout) => {
      const [width, height] = [layout.width, layout.height].map((side) => Math.round((side / 0.0254) * FINE));
      const page = await browser.newPage({ viewport: { width, height } });
      await page.setContent(html({ ...layout, margin: 0.018 }));
      const fine = greyOf(readPhoto(await page.screenshot({ type: 'png' })));
      await page.close();
      return { fine, original: halved(fine), text: layout.columns.flat().join('\n') };
    };
    return {
      sheet: await print({ width: 0.21, height: 0.297, points: 11, columns: [paragraphs(1, 11)] }),
      spread: await print({ width: 0.297, height: 0.21, points: 10, columns: [paragraphs(2, 5), paragraphs(3, 5)] }),
    };
  });
}

/**
 * A picture as a JPEG file, which cameras write.
 * @param {Uint8Array} png
 * @param {{ width: number, height: number }} size
 * @returns {Promise<Uint8Array>}
 */
export function jpeg(png, { width, height }) {
  return withBrowser(async (browser) => {
    const page = await browser.newPage({ viewport: { width, height } });
    await page.route('**/photo.png', (route) => route.fulfill({ contentType: 'image/png', body: Buffer.from(png) }));
    await page.route('**/page', (route) =>
      route.fulfill({ contentType: 'text/html', body: '<body style="margin: 0"><img src="photo.png" style="display: block">' }));
    await page.goto('http://localhost/page');
    return page.screenshot({ type: 'jpeg', quality: 92 });
  });
}

/**
 * @template T
 * @param {(browser: Awaited<ReturnType<typeof launch>>) => Promise<T>} work
 */
export async function withBrowser(work) {
  if (skip) throw new Problem(`The pages' text is set by a browser, and there is ${skip}: DEVELOPABLE_CHROME says where one is.`);
  const browser = await launch();
  try {
    return await work(browser);
  } finally {
    await browser.close();
  }
}

/** Each pixel the mean of four. @param {Grey} fine @returns {Grey} */
function halved({ width: across, height: down, data }) {
  const [width, height] = [across >> 1, down >> 1];
  const grey = Uint8Array.from({ length: width * height }, (_, i) => {
    const at = 2 * Math.floor(i / width) * across + 2 * (i % width);
    return (data[at] + data[at + 1] + data[at + across] + data[at + across + 1] + 2) >> 2;
  });
  return { width, height, data: grey };
}
