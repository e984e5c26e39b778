/** `node tools/doors.mjs`: makes the pictures of the page's doors, `www/doors/{page,model,scan}.webp`, and of its gallery, `www/gallery/pictures/`, from the page's own examples. */
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { CARDS } from '../www/gallery/cards.js';
import { isolation, serve } from './serve.mjs';
import { www } from './util/paths.mjs';
import { main } from './util/problem.mjs';

/** Size of a door's picture in pixels, side of a card's, and their quality as WebP. */
const [WIDTH, HEIGHT, CARD_SIDE, QUALITY] = [640, 400, 224, 0.65];

/** @typedef {import('playwright-core').Page} Page */
/** What each door's picture shows, in equal parts from left to right. The sheet, the last part of a model, is shown whole. @type {Record<string, (page: Page) => Promise<Buffer[]>>} */
const DOORS = {
  page: async (page) => {
    await page.locator('#flat-view[aria-busy="false"] #flat-canvas').waitFor();
    await page.addStyleTag({ content: '.handle, .over svg, .divider { display: none !important }' });
    return [await page.locator('#page-canvas').screenshot(), await page.locator('#flat-canvas').screenshot()];
  },
  model: async (page) => {
    await page.locator('[data-whole] #stage[data-busy="false"]').waitFor();
    // The first turn has to end.
    await page.waitForTimeout(3000);
    const model = await page.locator('#space-canvas').screenshot();
    // About as wide as it is shown: lines that are drawn larger would be hairlines.
    await page.setViewportSize({ width: 390, height: 844 });
    await page.locator('#end-sheets').click();
    return [model, await page.locator('.preview[aria-busy="false"] img').screenshot()];
  },
  scan: async (page) => {
    await page.locator('#certificate').waitFor();
    await page.addStyleTag({ content: '.badge, .divider { display: none !important }' });
    return [await page.locator('#space-canvas').screenshot()];
  },
};

/**
 * Writes pictures side by side as one WebP.
 * @param {Page} page
 * @param {string} file
 * @param {Buffer[]} parts each covers its part of the picture
 * @param {{ width: number, height: number, isLastWhole?: boolean }} size of the whole picture; whether its last part is shown whole
 */
async function writePicture(page, file, parts, size) {
  const pictures = parts.map((png) => `data:image/png;base64,${png.toString('base64')}`);
  const url = await page.evaluate(async ({ pictures, width, height, quality, isLastWhole }) => {
    const canvas = Object.assign(document.createElement('canvas'), { width, height });
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    context.fillStyle = 'white';
    context.fillRect(0, 0, width, height);
    context.imageSmoothingQuality = 'high';
    const wide = width / pictures.length;
    for (const [i, source] of pictures.entries()) {
      const image = new Image();
      image.src = source;
      await image.decode();
      const isWhole = isLastWhole && i === pictures.length - 1;
      const scale = (isWhole ? Math.min : Math.max)(wide / image.width, height / image.height);
      context.save();
      context.beginPath();
      context.rect(i * wide, 0, wide, height);
      context.clip();
      context.drawImage(image, i * wide + (wide - scale * image.width) / 2, (height - scale * image.height) / 2, scale * image.width, scale * image.height);
      context.restore();
    }
    return canvas.toDataURL('image/webp', quality);
  }, { pictures, quality: QUALITY, ...size });
  await writeFile(join(www, file), Buffer.from(url.split(',')[1], 'base64'));
}

await main(async () => {
  const server = await serve({ headers: isolation });
  const browser = await chromium.launch({ executablePath: process.env.DEVELOPABLE_CHROME || '/usr/bin/chromium', args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });
  /** @param {string} hash @param {import('playwright-core').ViewportSize} viewport @param {(page: Page) => Promise<void>} work */
  const onPage = async (hash, viewport, work) => {
    const page = await browser.newPage({ viewport, reducedMotion: 'reduce', bypassCSP: true });
    page.setDefaultTimeout(120_000);
    await page.goto(server.url + hash);
    await work(page);
    await page.close();
  };
  try {
    for (const [door, parts] of Object.entries(DOORS)) {
      await onPage('', { width: 1280, height: 900 }, async (page) => {
        await page.locator(`[data-example="${door}"]`).click();
        await writePicture(page, join('doors', `${door}.webp`), await parts(page), { width: WIDTH, height: HEIGHT, isLastWhole: door === 'model' });
      });
    }
    for (const { id, view } of CARDS) {
      // So wide that the surface has a square frame.
      await onPage(`#${id}`, { width: 700, height: 1000 }, async (page) => {
        await page.locator('#certificate').waitFor();
        await page.locator('#verdict[aria-busy="false"]').waitFor();
        await page.locator(`#analysis[data-view="${view}"]`).waitFor({ state: 'attached' });
        await page.locator('#stage[data-busy="false"]').waitFor();
        await page.addStyleTag({ content: '.badge, .divider { display: none !important }' });
        await writePicture(page, join('gallery/pictures', `${id}.webp`), [await page.locator('#space canvas:not([hidden])').screenshot()], { width: CARD_SIDE, height: CARD_SIDE });
      });
    }
  } finally {
    await browser.close();
    await server.close();
  }
});
