/** While λ is dragged. */
import assert from 'node:assert/strict';
import { grid, npy } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { choose, doorTest, open, pageTest, reported, runBy, settled, typeLambda, viewed } from './support/page.mjs';

/** Pixels of the side of the smallest image that is a large one. */
const LARGE = 500;

pageTest('while λ is dragged, pictures follow, and the last wish is certified', async (page) => {
  // What makes pictures is started by the first λ that is chosen.
  await runBy(page, () => typeLambda(page, '1e6'));
  const { events, wishes } = await page.evaluate(async () => {
    const slider = /** @type {HTMLInputElement} */ (document.querySelector('#lambda'));
    const caption = /** @type {HTMLElement} */ (document.querySelector('#result-caption'));
    const mark = /** @type {HTMLElement} */ (document.querySelector('#result-mark'));
    /** @type {string[]} */
    const wishes = [];
    new MutationObserver(() => {
      if (mark.textContent === 'preview') wishes.push(caption.textContent ?? '');
    }).observe(caption, { childList: true });
    const events = 30;
    for (let i = 0; i < events; i++) {
      slider.value = String(5 + i / 15);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      // As fast as a hand that does not rest.
      await new Promise((resolve) => setTimeout(resolve, 33));
    }
    return { events, wishes };
  });
  // A few would be many for a machine that is busy with ten other things.
  assert.ok(new Set(wishes).size >= events / 6, `${wishes}`);
  await page.locator('#lambda').dispatchEvent('change');
  await settled(page);
  assert.equal(await page.locator('#result-mark').isVisible(), false, 'no preview any more');
  const wished = 10 ** Number(await page.locator('#lambda').inputValue());
  assert.ok(Math.abs(parsed(await reported(page, 'λ')) / wished - 1) < 0.06);
  assert.match(await page.locator('#certificate').innerText(), /^Proven/);

  // Cancelled while there is only a preview, the result before it stays.
  const caption = await page.locator('#result-caption').innerText();
  await page.evaluate(async () => {
    const slider = /** @type {HTMLInputElement} */ (document.querySelector('#lambda'));
    const mark = /** @type {HTMLElement} */ (document.querySelector('#result-mark'));
    const seen = new Promise((resolve) => {
      new MutationObserver(() => mark.textContent === 'preview' && resolve(null)).observe(mark, { childList: true });
    });
    slider.value = '4';
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await seen;
    /** @type {HTMLButtonElement} */ (document.querySelector('#running-cancel')).click();
  });
  await settled(page);
  assert.equal(await page.locator('#result-mark').isVisible(), false);
  assert.equal(await page.locator('#result-caption').innerText(), caption);
  assert.match(await page.locator('#verdict').innerText(), /not solved/);
}, { start: '#example=roof' });

pageTest('what grows with the size of a result is done in workers, and a picture comes before it where λ is auto', async (page) => {
  // How often each function was called by the main thread, which no other process has a say in.
  const debug = await page.context().newCDPSession(page);
  await debug.send('Profiler.enable');
  await debug.send('Profiler.startPreciseCoverage', { callCount: true });
  await page.evaluate(() => {
    const mark = /** @type {HTMLElement} */ (document.querySelector('#result-mark'));
    const seen = { previews: 0 };
    Object.assign(window, { seen });
    new MutationObserver(() => (seen.previews += Number(mark.textContent === 'preview'))).observe(mark, { childList: true });
  });
  assert.equal(await page.locator('#lambda-auto').getAttribute('aria-pressed'), 'true');
  await runBy(page, () => page.locator('#example').selectOption('house'));
  const previews = await page.evaluate(() => /** @type {any} */ (window).seen.previews);
  assert.ok(previews > 0, 'there was a picture before the result');
  for (const view of ['gaussian', 'rulings', 'patches', 'sheet']) {
    await choose(page.locator(`input[name="view"][value="${view}"]`));
    await viewed(page);
  }
  const { result } = await debug.send('Profiler.takePreciseCoverage');
  /** @param {string} file @param {string} [name] */
  const calls = (file, name) => result
    .filter(({ url }) => url.endsWith(`/${file}`))
    .flatMap(({ functions }) => functions)
    .filter(({ functionName }) => functionName !== '' && (!name || functionName === name))
    .reduce((sum, { ranges: [{ count }] }) => sum + count, 0);
  assert.ok(calls('surface/relief.js', 'reliefOf') > 0, 'it does count');
  for (const file of ['surface/compare.js', 'surface/colour-images.js', 'surface/gaussian-curvature.js']) assert.equal(calls(file), 0, file);
  assert.equal(calls('surface/triangles.js', 'fillTriangles'), 0);
}, { start: '#example=roof&size=200', sources: true });

doorTest('the solver of a large input gives its memory back when it rests, comes again, and ends even where its worker does not listen', async (page) => {
  await page.evaluate((bytes) => {
    // Of one core nothing is left for the page.
    Object.defineProperty(navigator, 'hardwareConcurrency', { value: 1 });
    const { postMessage, terminate } = Worker.prototype;
    /** Those that were handed a large image. @type {WeakSet<Worker>} */
    const large = new WeakSet();
    const seen = { opened: 0, ended: 0 };
    Object.assign(window, { seen });
    Worker.prototype.postMessage = function (/** @type {any} */ message, /** @type {any} */ transfer) {
      if (String(message?.path) === 'stop') return;
      const sent = Array.isArray(transfer) ? transfer.reduce((sum, { byteLength = 0 }) => sum + byteLength, 0) : 0;
      if (sent >= bytes && String(message.path) === 'open') {
        large.add(this);
        seen.opened++;
      }
      postMessage.call(this, message, transfer);
    };
    Worker.prototype.terminate = function () {
      if (large.delete(this)) seen.ended++;
      terminate.call(this);
    };
  }, 8 * LARGE ** 2);
  const seen = () => page.evaluate(() => /** @type {any} */ (window).seen);
  // Nearly all of it is a hole.
  const fold = grid(LARGE, LARGE, (col, row) => (Math.hypot(col - LARGE / 2, row - LARGE / 2) < 60 ? 0.4 * Math.abs(col - LARGE / 2) : NaN));
  await open(page, 'fold.npy', npy(LARGE, fold));
  assert.deepEqual(await seen(), { opened: 1, ended: 0 });
  await page.waitForFunction(() => /** @type {any} */ (window).seen.ended === 1);
  await runBy(page, () => typeLambda(page, '1e5'));
  assert.equal((await seen()).opened, 2);
  assert.match(await page.locator('#certificate').innerText(), /^Proven/);
  // Cancelled as soon as it runs, and so on a coarse lattice: what was there stays.
  const caption = await page.locator('#result-caption').innerText();
  await page.locator('#gap').evaluate((/** @type {HTMLSelectElement} */ select) => new Promise((resolve) => {
    const running = /** @type {HTMLElement} */ (document.querySelector('#page'));
    new MutationObserver(() => {
      if (running.dataset.phase !== 'running') return;
      /** @type {HTMLButtonElement} */ (document.querySelector('#running-cancel')).click();
      resolve(null);
    }).observe(running, { attributeFilter: ['data-phase'] });
    select.selectedIndex = select.options.length - 1;
    select.dispatchEvent(new Event('change', { bubbles: true }));
  }));
  await settled(page);
  assert.match(await page.locator('#verdict').innerText(), /not solved/);
  assert.equal(await page.locator('#result-caption').innerText(), caption);
});
