/** Fits on several threads in the browser. */
import assert from 'node:assert/strict';
import { doorTest, downloaded, runBy } from './support/page.mjs';

doorTest('a large input is solved on all cores but the page’s own', async (page) => {
  await page.evaluate(() => void Object.defineProperty(navigator, 'hardwareConcurrency', { value: 3 }));
  const report = async () => {
    const { bytes } = await downloaded(page, () => page.locator('#report-save').evaluate((button) => /** @type {HTMLButtonElement} */ (button).click()));
    return JSON.parse(bytes.toString());
  };
  await runBy(page, () => page.evaluate(() => void (location.hash = '#example=cylinder&size=64&noise=0.02')));
  assert.equal((await report()).threads, 1, 'a small one needs no more');
  await runBy(page, () => page.evaluate(() => void (location.hash = '#example=cylinder&size=700&noise=0.02&lambda=1e7')));
  assert.deepEqual([(await report()).threads, (await report()).stopReason], [2, 'gap']);
});
