/** Fits on several threads in the browser. */
import assert from 'node:assert/strict';
import { downloaded, pageTest, runBy, settled } from './support/page.mjs';

pageTest('in an isolated page a fit runs on two threads, with the bits of one', async (page) => {
  const [one, two] = await page.evaluate(async () => {
    // Threads are not limited by the cores of the machine that tests.
    Object.defineProperty(navigator, 'hardwareConcurrency', { value: 2 });
    const { DevelopableWorker } = await import(new URL('/pkg/index.js', location.href).href);
    const data = Float64Array.from({ length: 190 * 190 }, (_, i) => Math.abs((i % 190) - 75) + Math.sin(i));
    const results = [];
    for (const threads of [1, 2]) {
      const worker = new DevelopableWorker({ threads });
      const { heights, report } = await worker.fit({ width: 190, height: 190, data }, { lambda: 1e6 });
      worker.dispose();
      results.push({ heights: Array.from(heights), threads: report.threads, limit: report.threadLimit });
    }
    return results;
  });
  assert.deepEqual([one.threads, one.limit, two.threads, two.limit], [1, 'options', 2, 'options']);
  assert.deepEqual(two.heights, one.heights);
});

pageTest('a large input is solved on all cores but the page’s own', async (page) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'hardwareConcurrency', { value: 3 }));
  await page.reload();
  await settled(page);
  const report = async () => {
    const { bytes } = await downloaded(page, () => page.locator('#report-save').evaluate((button) => /** @type {HTMLButtonElement} */ (button).click()));
    return JSON.parse(bytes.toString());
  };
  assert.equal((await report()).threads, 1, 'a small one needs no more');
  await runBy(page, () => page.evaluate(() => void (location.hash = '#example=cylinder&size=700&noise=0.02&lambda=1e7')));
  assert.deepEqual([(await report()).threads, (await report()).stopReason], [2, 'gap']);
});
