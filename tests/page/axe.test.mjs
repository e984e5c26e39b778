/** What axe finds wrong with the page, view by view, in both colour schemes. */
import assert from 'node:assert/strict';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import axe from 'axe-core';
import { serve } from '../../tools/serve.mjs';
import { writeGuide } from '../../tools/site/guide.mjs';
import { CARDS } from '../../www/gallery/cards.js';
import { noisyBox } from './support/box.mjs';
import { obj } from './support/files.mjs';
import { levelPhoto } from './support/photos.mjs';
import { choose, doorTest, drop, enterPages, inChromium, openFromOneSide, pageTest, painted, sheetsDrawn, solvedWhole, viewed } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */

/**
 * Violations, each with the elements that have it.
 * @param {Page} page
 * @param {{ within?: string, rules?: string[] }} [what] a part of the page, and some rules
 * @returns {Promise<string[]>}
 */
async function violations(page, { within = 'html', rules } = {}) {
  // Added by the debugger, about which the page's security policy says nothing.
  if (!(await page.evaluate(() => 'axe' in globalThis))) await page.evaluate(axe.source);
  const found = await page.evaluate(async ([part, only]) => {
    const { axe: own } = /** @type {typeof globalThis & { axe: typeof import('axe-core') }} */ (globalThis);
    const options = { resultTypes: /** @type {['violations']} */ (['violations']), ...(only && { runOnly: /** @type {string[]} */ (only) }) };
    const { violations: list } = await own.run(/** @type {string} */ (part), options);
    return list.map(({ id, help, nodes }) => ({ id, help, nodes: nodes.map(({ target, failureSummary }) => `${target}: ${failureSummary}`) }));
  }, /** @type {const} */ ([within, rules]));
  return found.flatMap(({ id, help, nodes }) => nodes.map((node) => `${id} (${help}): ${node}`));
}

/** @param {Page} page */
async function unfold(page) {
  for (const details of await page.locator('details').all()) await details.evaluate((one) => one.setAttribute('open', ''));
}

/** In the dark only the colours differ; on a phone and at twice the size, the sizes. */
const NARROW = ['target-size', 'scrollable-region-focusable'];

/**
 * In both colour schemes on a desk, on a phone, and at twice the size.
 * @param {Page} page
 * @param {string} what
 * @param {{ within?: string, small?: string[] }} [where] a part of the page, and rules where there is little room
 */
async function soundEverywhere(page, what, { within, small = NARROW } = {}) {
  for (const width of [1280, 390, 640]) {
    await page.setViewportSize({ width, height: 800 });
    // Colours are the same at every width.
    for (const colorScheme of width < 1280 ? /** @type {const} */ (['light']) : /** @type {const} */ (['light', 'dark'])) {
      await page.emulateMedia({ colorScheme });
      await painted(page);
      /** @type {string[] | undefined} */
      const rules = width < 1280 ? small : colorScheme === 'dark' ? ['color-contrast'] : undefined;
      assert.deepEqual(await violations(page, { within, rules }), [], `${what}, ${colorScheme}, ${width}`);
    }
    const excess = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok(excess <= 0, `${what}: ${excess} pixels at ${width}`);
  }
}

pageTest('axe finds nothing wrong with any view', async (page) => {
  await unfold(page);
  await soundEverywhere(page, 'the page');
  await page.setViewportSize({ width: 1280, height: 800 });
  if (!(await page.locator('#drawer').isVisible())) await page.locator('#report-open').click();
  for (const radio of await page.locator('label:not([hidden]) > input[name="view"]').all()) {
    await choose(radio);
    await viewed(page);
    await soundEverywhere(page, await radio.inputValue(), { within: 'section[aria-label="Surfaces"]' });
  }
  // It does see what is wrong.
  await page.locator('#open').evaluate(({ style }) => Object.assign(style, { color: '#777', background: '#888' }));
  assert.match(String(await violations(page, { rules: ['color-contrast'] })), /color-contrast.*#open/s);
});

pageTest('with more contrast, text has 7 to 1, and borders are seen', async (page) => {
  await unfold(page);
  for (const colorScheme of /** @type {const} */ (['light', 'dark'])) {
    const enhanced = async () => violations(page, { rules: ['color-contrast-enhanced'] });
    await page.emulateMedia({ colorScheme, contrast: 'no-preference' });
    await painted(page);
    const usual = await enhanced();
    await page.emulateMedia({ contrast: 'more' });
    await painted(page);
    assert.deepEqual(await enhanced(), [], colorScheme);
    if (colorScheme === 'light') assert.ok(usual.length > 0, 'the rule sees what is less');
  }
  // With the system's colours, what has no border otherwise is told from its ground; progress that moves is the browser's own.
  await page.emulateMedia({ contrast: 'no-preference', forcedColors: 'active', reducedMotion: 'reduce' });
  await painted(page);
  await page.locator('#running progress').evaluate((bar) => bar.removeAttribute('value'));
  const drawn = await page.evaluate(() => ['.frame', '#running progress'].map((one) => getComputedStyle(/** @type {Element} */ (document.querySelector(one))).borderTopWidth));
  assert.deepEqual(drawn, ['1px', '1px']);
});

doorTest('axe finds nothing wrong with a photo of a page', async (page) => {
  await enterPages(page);
  await drop(page, 'IMG_1.png', levelPhoto);
  await page.locator('#page-caption', { hasText: 'IMG_1' }).waitFor();
  await page.locator('#flat-view[aria-busy="false"]').waitFor({ state: 'attached' });
  await unfold(page);
  // Handles lie where the page's corners and bends are, as close to each other as that may be.
  await soundEverywhere(page, 'a photo', { small: NARROW.filter((rule) => rule !== 'target-size') });
});

doorTest('axe finds nothing wrong with a whole mesh', async (page) => {
  await openFromOneSide(page, 'box.obj', obj(noisyBox(5, 0.02)));
  await soundEverywhere(page, 'a mesh');
  await choose(page.getByRole('radio', { name: 'Whole mesh', exact: true }));
  for (const view of ['shaded', 'gaussian', 'patches', 'sheet']) {
    await solvedWhole(page);
    await choose(page.locator(`input[name="view"][value="${view}"]`));
    await solvedWhole(page);
    await soundEverywhere(page, `whole, ${view}`);
  }
});

pageTest('axe finds nothing wrong with surfaces in space, the gallery, and dialogs', async (page) => {
  await soundEverywhere(page, 'the stage');
  await page.locator('#gallery-open').click();
  assert.equal(await page.locator('.card').count(), CARDS.length);
  await soundEverywhere(page, 'the gallery', { within: '#gallery' });
  await page.keyboard.press('Escape');
  await page.locator('#end-file').click();
  await page.locator('#save-dialog[open]').waitFor();
  await soundEverywhere(page, 'the dialog that saves', { within: '#save-dialog' });
  await page.keyboard.press('Escape');
  await page.locator('#end-sheets').click();
  await soundEverywhere(page, 'sheets, or while they are cut', { within: '#save-dialog' });
  await sheetsDrawn(page);
  await soundEverywhere(page, 'sheets', { within: '#save-dialog' });
  await page.keyboard.press('Escape');
}, { drawn: true });

inChromium('axe finds nothing wrong with guides', async (page) => {
  const folder = await mkdtemp(join(tmpdir(), 'developable-guide-'));
  await writeGuide(folder, { references: true });
  const server = await serve({ folders: { '/': folder } });
  try {
    for (const path of ['README', 'docs/scans', 'pkg/README']) {
      await page.goto(`${server.url}guide/${path}.html`);
      await soundEverywhere(page, path);
    }
  } finally {
    await server.close();
    await rm(folder, { recursive: true, force: true });
  }
});
