/** The first screen: three doors, and the right one for whatever is dropped or pasted. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { deflateSync } from 'node:zlib';
import { chunk, grid, npy, ramp, tornObj } from './support/files.mjs';
import { choose, drop, pageTest, settled, solvedWhole } from './support/page.mjs';
import { colouredPicture } from './support/photos.mjs';

/** @typedef {import('playwright-core').Page} Page */

/** The most presses of Tab that lead through a job before anything is unfolded. */
const MAX_TAB_STOPS = 15;

/** How many places the Tab key stops at before it leaves the page. @param {Page} page */
async function tabStops(page) {
  await page.evaluate(() => {
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    scrollTo(0, 0);
  });
  await page.locator('h1').click({ position: { x: 200, y: 5 }, force: true });
  /** @type {string[]} */
  const seen = [];
  for (let presses = 0; presses < 60; presses++) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const { activeElement: one } = document;
      if (!one || one === document.body) return '';
      return one.id || `${one.tagName} ${one.textContent?.trim().slice(0, 30)}`;
    });
    if (at === '' || at === seen[0]) return seen;
    seen.push(at);
  }
  return seen;
}

pageTest('behind each door is an example, one click away, and Back leads to the doors', async (page) => {
  const home = page.locator('#home');
  assert.equal(await home.getByRole('article').count(), 3);
  const lefts = await Promise.all(['h1 a', '.lead', '.doors', '.colophon p'].map(async (one) => (await page.locator(one).first().boundingBox())?.x));
  assert.equal(new Set(lefts).size, 1, `one left edge, not ${lefts.join(', ')}`);
  for (const picture of await home.locator('img').all()) assert.ok(await picture.evaluate((one) => /** @type {HTMLImageElement} */ (one).decode().then(() => true)));

  await page.evaluate(() => (location.hash = '#file=99'));
  await page.locator('#notice', { hasText: 'has not kept the file' }).waitFor();
  assert.ok(await home.isVisible(), 'a file that is gone leads to the doors');

  await drop(page, 'broken.obj', tornObj);
  await page.getByRole('alert').filter({ hasText: 'broken.obj' }).waitFor();
  await home.waitFor();
  assert.ok(await home.isVisible(), 'so does one that cannot be read');

  await page.locator('[data-example="scan"]').click();
  await page.locator('#page[data-phase="running"]').waitFor();
  assert.match(await page.evaluate(() => location.hash), /example=roof/, 'Back can be used during the solve');
  await page.locator('#certificate', { hasText: 'Proven' }).waitFor();
  await settled(page);
  await page.waitForFunction(() => location.hash.includes('example=roof'));
  await page.goBack();
  await home.waitFor();

  // A link that is followed from here, and is what the page would show next anyway.
  await page.evaluate(() => (location.hash = '#example=roof&size=100&noise=0.02'));
  await page.locator('#input-caption', { hasText: '100 × 100' }).waitFor();
  await page.locator('#certificate', { hasText: 'Proven' }).waitFor();
  await page.getByRole('link', { name: 'developable' }).click();

  await page.locator('[data-example="model"]').click();
  await solvedWhole(page);
  assert.match(await page.locator('#mesh-name').innerText(), /house \(OBJ\)/);
  // What one needs for sheets, and the rest one click away.
  const [views, others] = ['#view-choice', '#view-others'].map((box) => page.locator(box).getByRole('radio'));
  assert.deepEqual([await views.count(), await others.count(), await page.getByText('From one side').isVisible()], [3, 0, false]);
  await page.getByText('More views').click();
  assert.equal(await others.count(), 2);
  // Its faces are flat: colours between its corners would be none of theirs.
  await choose(page.getByRole('radio', { name: 'Curvature K' }));
  await page.locator('#stage[data-busy="false"] #about-view', { hasText: 'all faces are flat' }).waitFor();
  assert.equal(await page.locator('.bar').count(), 0);
  await choose(page.getByRole('radio', { name: 'Laid flat' }));
  await page.locator('#stage[data-busy="false"] #about-view', { hasText: 'Nothing of it is stretched.' }).waitFor();
  assert.equal(await page.locator('.bar').count(), 0);
  assert.equal(await page.locator('.primary:visible').count(), 1, 'one main button');
  await page.locator('#end-sheets').click();
  await page.locator('#save-title', { hasText: /64 mm, 1 page/ }).waitFor();
  assert.match(await page.locator('.sheets .said').innerText(), /^One sheet, /, 'as its door promises');
  await page.keyboard.press('Escape');
  await page.getByRole('link', { name: 'developable' }).click();

  await page.locator('[data-example="page"]').click();
  await page.locator('#flat-view[aria-busy="false"]').waitFor();
  await page.goBack();
  await home.waitFor();
  assert.equal(await home.getByText('Opened before').isVisible(), false, 'nothing of one’s own');
}, { start: '', unfolded: [] });

pageTest('what is dropped or pasted on the first screen opens its door', async (page) => {
  await drop(page, 'ramp.npy', npy(24, grid(24, 20, (col, row) => 3 * col + row)));
  await page.locator('#input-caption', { hasText: 'ramp' }).waitFor({ state: 'attached' });
  assert.ok(await page.locator('#heights-side').isVisible());
  await page.getByRole('link', { name: 'developable' }).click();
  await page.locator('#home').getByText('Opened before: ramp.npy').waitFor();
  // As a screenshot is pasted.
  await page.evaluate((content) => {
    const clipboardData = new DataTransfer();
    clipboardData.items.add(new File([Uint8Array.from(atob(content), (character) => character.charCodeAt(0))], 'image.png', { type: 'image/png' }));
    document.body.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true }));
  }, colouredPicture.toString('base64'));
  await page.locator('#page-caption', { hasText: 'image' }).waitFor();
}, { start: '' });

pageTest('a picture that is chosen as a page is one, though it is grey', async (page) => {
  const [dialog] = await Promise.all([page.waitForEvent('filechooser'), page.locator('[data-open="page"]').click()]);
  const [width, height] = [160, 120];
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  // 8 bits of grey.
  head.set([8, 0], 8);
  const rows = Buffer.alloc(height * (1 + width), 128);
  for (let row = 0; row < height; row++) rows[row * (1 + width)] = 0;
  const buffer = Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
  await dialog.setFiles({ name: 'letter.png', mimeType: 'image/png', buffer });
  await page.locator('#page-caption', { hasText: 'letter' }).waitFor();
  await page.locator('#page-side[data-state="unfound"]').waitFor();
  assert.equal(await page.locator('#notice').isVisible(), false, 'nothing was guessed');
}, { start: '' });

pageTest('few stops of the Tab key lead through a scan before more is asked for', async (page) => {
  const stops = await tabStops(page);
  assert.ok(stops.length > 8 && stops.length <= MAX_TAB_STOPS, `${stops.length}: ${stops.join(' · ')}`);
  assert.equal(await page.locator('.primary:visible').count(), 1, 'one main button');
}, { unfolded: [], drawn: true });

pageTest('a file that cannot be read leads back to the doors, though something was open before, and not away from what is shown', async (page) => {
  const home = page.locator('#home');
  await page.getByRole('link', { name: 'developable' }).click();
  await home.waitFor();
  await drop(page, 'broken.obj', tornObj);
  await page.getByRole('alert').filter({ hasText: 'broken.obj' }).waitFor();
  await home.waitFor();
  assert.equal(await page.locator('#heights-side').isVisible(), false);
  await page.goBack();
  await page.locator('#heights-side').waitFor();
  assert.match(await page.locator('#input-caption').innerText(), /^cylinder/, 'Back leads to what was open');
  await drop(page, 'later.obj', tornObj);
  await page.getByRole('alert').filter({ hasText: 'later.obj' }).waitFor();
  assert.ok(await page.locator('#heights-side').isVisible());
});

pageTest('while something is opened, the page says so and not that it shows nothing', async (page) => {
  const verdict = page.locator('#verdict');
  const said = await verdict.evaluateHandle((element) => {
    /** @type {string[]} */
    const words = [];
    const look = () => {
      if (element.checkVisibility() && words.at(-1) !== element.textContent) words.push(element.textContent ?? '');
      requestAnimationFrame(look);
    };
    look();
    return words;
  });
  // Only its contents tell what it is.
  await drop(page, 'ramp', ramp);
  await page.locator('#mesh-name', { hasText: 'OBJ' }).waitFor();
  assert.equal((await said.jsonValue())[0], 'Reading the file…');
  await page.getByRole('link', { name: 'developable' }).click();
  await page.locator('[data-example="scan"]').click();
  await page.locator('#input-caption', { hasText: 'roof' }).waitFor();
  await settled(page);
  const all = await said.jsonValue();
  assert.equal(all.some((words) => /Nothing/.test(words)), false);
  assert.match(all.slice(-2).join(' '), /^Solving… \d+ smooth pieces meet in \d+ creases\.$/, 'one sentence, once it is known');
}, { start: '' });

pageTest('letters have the sizes of the scale in www/design.md, and no others', async (page) => {
  const scale = await readFile(new URL('../../www/design.md', import.meta.url), 'utf8');
  const [, type] = /\*\*Type\*\*([^]*?)\n/.exec(scale) ?? [];
  const allowed = Array.from(type?.matchAll(/(\d+)(?: px| on phones)/g) ?? [], ([, size]) => `${size}px`);
  const used = await page.evaluate(() => {
    /** @param {CSSRuleList} rules @returns {string[]} */
    const sizesOf = (rules) => [...rules].flatMap((rule) => {
      const own = rule instanceof CSSStyleRule && rule.style.fontSize !== '' && rule.style.fontSize !== 'inherit' ? [rule.style.fontSize] : [];
      return [...own, ...('cssRules' in rule ? sizesOf(/** @type {CSSRuleList} */ (rule.cssRules)) : [])];
    });
    return [...new Set([...document.styleSheets].flatMap((sheet) => sizesOf(sheet.cssRules)))];
  });
  assert.ok(allowed.length === 5 && used.includes('13px') && used.length >= 4, `${allowed} against ${used}`);
  assert.deepEqual(used.filter((size) => !allowed.includes(size)), []);
}, { start: '' });
