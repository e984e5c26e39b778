/** By keyboard, on a phone, and in the dark. */
import assert from 'node:assert/strict';
import { grid, npy, tornObj } from './support/files.mjs';
import { choose, doorTest, drop, enterPages, look, open, pageTest, painted, runBy, settled, viewed } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */

/** @param {Page} page */
async function looks(page) {
  return [(await look(page, 'input')).hash, (await look(page, 'result')).hash];
}

/**
 * By how many pixels the page is wider than its window.
 * @param {import('playwright-core').Page} page
 */
function excess(page) {
  return page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
}

/**
 * Presses Tab until the focus is on what matches.
 * @param {Page} page
 * @param {string} selector
 * @param {string} [key]
 */
async function tabTo(page, selector, key = 'Tab') {
  for (let presses = 0; presses < 40; presses++) {
    await page.keyboard.press(key);
    const there = await page.evaluate((wanted) => document.activeElement?.matches(wanted), selector);
    if (there) return;
  }
  assert.fail(`${key} never reaches ${selector}`);
}

/** Lets the next run of a page begin in its worker only when it is cancelled. @param {Page} page */
const neverEnding = (page) => page.evaluate(() => {
  const { postMessage } = Worker.prototype;
  let start = () => {};
  Worker.prototype.postMessage = function (/** @type {any} */ message, /** @type {any} */ transfer) {
    const send = () => postMessage.call(this, message, transfer);
    if (message?.path?.[0] === 'startOpen') return void (start = send);
    if (message?.path?.[0] === 'stop') {
      Worker.prototype.postMessage = postMessage;
      start();
    }
    send();
  };
});

pageTest('attributes name elements that there are, and nothing that is said waits for a picture', async (page) => {
  await choose(page.getByRole('radio', { name: 'Patches', exact: true }));
  await viewed(page);
  await enterPages(page);
  await page.locator('#page-format').waitFor();
  const { missing, silent } = await page.evaluate(() => {
    const names = ['aria-describedby', 'aria-controls', 'aria-labelledby'].flatMap((name) => [...document.querySelectorAll(`[${name}]`)].flatMap((one) => String(one.getAttribute(name)).split(' ')));
    return { missing: names.filter((name) => !document.getElementById(name)), silent: document.querySelectorAll('[aria-busy] :is([role="status"], [role="alert"])').length };
  });
  assert.deepEqual([missing, silent], [[], 0]);
  for (const [name, attribute, wanted] of [['pixel-size', 'aria-describedby', /scale-hint scale-span/], ['height-scale', 'aria-describedby', /scale-hint scale-span/], ['page-format', 'aria-describedby', /format-hint/], ['find-occlusions', 'aria-controls', /^threshold$/]]) {
    assert.match(await page.locator(`#${name}`).getAttribute(String(attribute)) ?? '', /** @type {RegExp} */ (wanted));
  }
  assert.deepEqual(await Promise.all(['pixel-size', 'height-scale', 'lambda-value'].map((name) => page.locator(`#${name}`).getAttribute('inputmode'))), ['decimal', 'text', 'text']);
});

pageTest('everything can be done by keyboard', async (page) => {
  await tabTo(page, '#end-file');
  await page.keyboard.press('Enter');
  // What it offers is loaded first.
  await page.locator('#save-dialog[open]').waitFor();
  await tabTo(page, 'input[name="save-format"]');
  await page.keyboard.press('ArrowUp');
  await page.locator('#save-size', { hasText: /exr, \d/ }).waitFor();
  await tabTo(page, '#save-now');
  const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);
  assert.match(download.suggestedFilename(), /\.exr$/);
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => document.activeElement?.id), 'end-file', 'the focus is back');

  await tabTo(page, '#example');
  await runBy(page, () => page.keyboard.press('ArrowDown'));
  await tabTo(page, '#lambda');
  await runBy(page, () => page.keyboard.press('PageUp'));
  await tabTo(page, '#settings-more > summary');
  await page.keyboard.press('Enter');

  await tabTo(page, '#gap');
  await neverEnding(page);
  await page.keyboard.press('ArrowUp');
  await tabTo(page, '#running-cancel', 'Shift+Tab');
  await page.keyboard.press('Space');
  await settled(page);
  assert.equal(await page.evaluate(() => document.activeElement?.id), 'run', 'the focus goes to what solves it again');
  await runBy(page, () => page.keyboard.press('Enter'));
}, { start: '#example=roof&size=100', unfolded: [] });

pageTest('what has the focus can be seen to have it', async (page) => {
  for (const selector of ['#end-file', '#size', '#open', '#lambda', 'summary']) {
    await tabTo(page, selector);
    const width = await page.evaluate(() => {
      const style = getComputedStyle(/** @type {Element} */ (document.activeElement));
      return style.outlineStyle === 'none' ? 0 : Number.parseFloat(style.outlineWidth);
    });
    assert.ok(width >= 1, selector);
  }
});

pageTest('by keyboard both surfaces are turned', async (page) => {
  const before = await looks(page);
  await tabTo(page, '#space-canvas');
  await page.keyboard.press('ArrowRight');
  const turned = await looks(page);
  assert.ok(turned[0] !== before[0] && turned[1] !== before[1]);
  const outline = await page.locator('#space-canvas').evaluate((canvas) => Number.parseFloat(getComputedStyle(canvas).outlineWidth));
  assert.ok(outline >= 1, 'the focus is seen');
}, { drawn: true });

pageTest('every view fits on a phone, light and dark, with the pixels of the device', async (page) => {
  const sizes = await page.locator('canvas:visible').evaluateAll((canvases) =>
    canvases.map((canvas) => [/** @type {HTMLCanvasElement} */ (canvas).width, canvas.clientWidth]));
  for (const [pixels, width] of sizes) assert.equal(pixels, 2 * width);
  if (!(await page.locator('#drawer').isVisible())) await page.locator('#report-open').click();
  for (const colorScheme of /** @type {const} */ (['light', 'dark'])) {
    await page.emulateMedia({ colorScheme });
    for (const radio of await page.locator('label:not([hidden]) > input[name="view"]').all()) {
      await choose(radio);
      await viewed(page);
      await painted(page);
      assert.ok(await excess(page) <= 0, `${await radio.inputValue()}: ${await excess(page)} pixels, ${colorScheme}`);
    }
  }
  const [paper, ink] = await page.evaluate(() => {
    const { backgroundColor, color } = getComputedStyle(document.body);
    return [backgroundColor, color].map((text) => (text.match(/\d+/g) ?? []).slice(0, 3).map(Number));
  });
  assert.ok(Math.max(...paper) < 64 && Math.min(...ink) > 192, `${ink} on ${paper}`);
}, { size: { width: 360, height: 740 }, pixels: 2, drawn: true });

doorTest('a file with a long name can be saved on a phone', async (page) => {
  await open(page, `${'long_words_joined_by_lines_'.repeat(4)}.npy`, npy(24, grid(24, 20, (col, row) => 3 * col + row)));
  await page.locator('#end-file').click();
  await page.locator('#save-now:enabled').waitFor();
  const [dialog, save] = await Promise.all(['#save-dialog', '#save-now'].map((one) => page.locator(one).boundingBox()));
  assert.ok(dialog && save && save.x + save.width <= dialog.x + dialog.width, `${save?.x} + ${save?.width}`);
  const [name, links] = await Promise.all(['.masthead h1', '.masthead nav'].map((one) => page.locator(one).boundingBox()));
  assert.ok(name && links && links.y < name.y, 'one line above the picture');
  await page.keyboard.press('Escape');
  await drop(page, `${'long_words_joined_by_lines_'.repeat(4)}.obj`, tornObj);
  const close = await page.getByRole('button', { name: 'Dismiss this message' }).boundingBox();
  assert.ok(close && close.x + close.width <= 390, 'what is said about it can be dismissed');
}, { size: { width: 390, height: 844 } });
