/** `node tools/doors.mjs`: makes the pictures of the page's doors, `www/doors/{page,model,scan}.webp`, from the page's own examples. */
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { isolation, serve } from './serve.mjs';
import { www } from './util/paths.mjs';
import { main } from './util/problem.mjs';

/** Size of a picture in pixels, and its quality as WebP. */
const [WIDTH, HEIGHT, QUALITY] = [640, 400, 0.65];

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
    await page.locator('#end-sheets').click();
    return [model, await page.locator('.preview[aria-busy="false"] img').screenshot()];
  },
  scan: async (page) => {
    await page.locator('#certificate').waitFor();
    await page.addStyleTag({ content: '.badge, .divider { display: none !important }' });
    return [await page.locator('#space-canvas').screenshot()];
  },
};

await main(async () => {
  const server = await serve({ headers: isolation });
  const browser = await chromium.launch({ executablePath: process.env.DEVELOPABLE_CHROME || '/usr/bin/chromium', args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });
  try {
    for (const [door, parts] of Object.entries(DOORS)) {
      const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce', bypassCSP: true });
      await page.goto(server.url);
      await page.locator(`[data-example="${door}"]`).click();
      const pictures = (await parts(page)).map((png) => `data:image/png;base64,${png.toString('base64')}`);
      const url = await page.evaluate(async ({ pictures, width, height, quality, isLastWhole }) => {
        const canvas = Object.assign(document.createElement('canvas'), { width, height });
        const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
        context.fillStyle = 'white';
        context.fillRect(0, 0, width, height);
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
      }, { pictures, width: WIDTH, height: HEIGHT, quality: QUALITY, isLastWhole: door === 'model' });
      await writeFile(join(www, 'doors', `${door}.webp`), Buffer.from(url.split(',')[1], 'base64'));
      await page.close();
    }
  } finally {
    await browser.close();
    await server.close();
  }
});
