/** Input and result in space. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { standsRather } from '../../www/surface/triangles.js';
import { noisyBox } from './support/box.mjs';
import { obj } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { parsePng } from './support/photos.mjs';
import { choose, doorTest, look, openWhole, pageTest, painted, sharedTest, viewed } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */

/**
 * Brightness of what is seen of a canvas, over a square of so many places around its middle.
 * @param {Page} page
 * @param {string} selector
 * @param {number} [places]
 * @param {[number, number]} [columns] shares of the square that are wanted
 */
async function brightness(page, selector, places = 30, [from, to] = [0, 1]) {
  await page.locator(selector).scrollIntoViewIfNeeded();
  await painted(page);
  const box = await page.locator(selector).boundingBox();
  assert.ok(box);
  const { width, height, data } = parsePng(await page.screenshot({ clip: box }));
  const side = Math.min(width, height);
  const found = [];
  for (let row = 2; row < places - 2; row++) {
    for (let col = 2; col < places - 2; col++) {
      if (col < from * places || col >= to * places) continue;
      const x = Math.floor((width - side) / 2 + ((col + 0.5) * side) / places);
      const y = Math.floor((height - side) / 2 + ((row + 0.5) * side) / places);
      found.push(data[4 * (y * width + x) + 1]);
    }
  }
  return found;
}

/** @param {number[]} a @param {number[]} b */
function correlation(a, b) {
  const mean = (/** @type {number[]} */ values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [ma, mb] = [mean(a), mean(b)];
  const product = (/** @type {number[]} */ p, /** @type {number} */ mp, /** @type {number[]} */ q, /** @type {number} */ mq) =>
    mean(p.map((value, i) => (value - mp) * (q[i] - mq)));
  return product(a, ma, b, mb) / Math.sqrt(product(a, ma, a, ma) * product(b, mb, b, mb));
}

sharedTest('a card that is seen from above is seen so when an address opens it', async (page) => {
  const first = await brightness(page, '#space-canvas');
  await page.getByRole('button', { name: 'From above' }).click();
  const alike = correlation(first, await brightness(page, '#space-canvas'));
  assert.ok(alike > 0.9, `${alike}`);
}, { start: '#fig-8', drawn: true });

doorTest('the last view that is asked for before the surface can be drawn is the first that is shown', async (page) => {
  /** @type {() => void} */
  let release = () => {};
  const released = new Promise((resolve) => (release = () => resolve(undefined)));
  await page.route(/three/, (route) => released.then(() => route.continue()));
  await page.evaluate(() => (location.hash = '#example=roof&size=100&noise=0.02'));
  await page.locator('#certificate').waitFor();
  for (const name of ['From above', 'At an angle']) await page.getByRole('button', { name }).click();
  release();
  await page.waitForFunction(() => document.querySelector('canvas#space-canvas:not([width="300"], :not([width]))'));
  const first = await brightness(page, '#space-canvas');
  await page.getByRole('button', { name: 'At an angle' }).click();
  const alike = correlation(first, await brightness(page, '#space-canvas'));
  assert.ok(alike > 0.95, `${alike}`);
}, { drawn: true });

sharedTest('in space the surface is turned and divided', async (page) => {
  const divider = page.getByRole('slider', { name: 'Divider between input and result' });

  await page.getByRole('button', { name: 'From above' }).click();
  await divider.press('Home');
  const above = await brightness(page, '#space-canvas');
  assert.match(await divider.getAttribute('aria-valuetext') ?? '', /^input on 0 %/);

  const canvas = page.locator('#space-canvas');
  await canvas.press('ArrowUp');
  await canvas.press('ArrowLeft');
  const turned = await brightness(page, '#space-canvas');
  assert.ok(correlation(above, turned) < 0.9, 'keys turn it');
  await page.getByRole('button', { name: 'From above' }).click();
  assert.ok(correlation(above, await brightness(page, '#space-canvas')) > 0.99, 'and back');

  const box = await canvas.boundingBox();
  assert.ok(box);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x + 40, y + 10);
  assert.match(await page.locator('#reading').innerText(), /^height 0\.\d+ units$/);
  await page.mouse.down();
  await page.mouse.move(x - 80, y - 60, { steps: 4 });
  await page.mouse.up();
  assert.ok(correlation(above, await brightness(page, '#space-canvas')) < 0.9, 'the mouse turns it');
  await page.getByRole('button', { name: 'From above' }).click();

  await choose(page.getByRole('radio', { name: 'Patches', exact: true }));
  await viewed(page);
  await page.mouse.move(x + 40, y + 12);
  assert.match(await page.locator('#reading').innerText(), /patch \d/);
  assert.ok(correlation(above, await brightness(page, '#space-canvas')) < 0.9, 'in colours');
  await choose(page.getByRole('radio', { name: 'Shaded', exact: true }));

  await divider.press('End');
  for (let i = 0; i < 10; i++) await divider.press('ArrowLeft');
  assert.match(await divider.getAttribute('aria-valuetext') ?? '', /^input on 50 %/);
}, { drawn: true, start: '#example=roof&size=100&noise=0' });

doorTest('a model that is opened first turns, too, once it can be drawn, and meanwhile WebGL is not missed', async (page) => {
  /** @type {(route: import('playwright-core').Route) => void} */
  let hold = () => {};
  /** @type {Promise<import('playwright-core').Route>} */
  const held = new Promise((resolve) => (hold = resolve));
  await page.route(/three[^/]*\.js$/, (route) => hold(route));
  // The page's second takes ten, so that the turn can be seen on a busy machine.
  await page.evaluate(() => {
    const [now, frame] = [performance.now.bind(performance), requestAnimationFrame.bind(window)];
    performance.now = () => now() / 10;
    window.requestAnimationFrame = (callback) => frame(() => callback(performance.now()));
  });
  await openWhole(page, 'box.obj', obj(noisyBox(8, 0.02)));
  assert.equal(await page.locator('#space-missing').isVisible(), false);
  await (await held).continue();
  await page.waitForFunction(() => document.querySelector('canvas#space-canvas:not([width="300"], :not([width]))'));
  const first = (await look(page, '#space-canvas')).hash;
  while ((await look(page, '#space-canvas')).hash === first) await painted(page);
}, { drawn: true, moving: true });

test('a mesh stands on the side that has a foot, whatever axis its file means', () => {
  // A lampshade along z, four legs along y, and a box, which stands on any side.
  const circle = (/** @type {number} */ radius, /** @type {number} */ z) => Array.from({ length: 24 }, (_, i) => [radius * Math.cos(i * Math.PI / 12), radius * Math.sin(i * Math.PI / 12), z]);
  const shade = [...circle(3, 0), ...circle(2, 4)].flat();
  const legs = [...[[-2, 0, -3], [2, 0, -3], [-2, 0, 3], [2, 0, 3]], ...circle(3, 0).map(([x, y]) => [x, y + 5, 4])].flat();
  const box = noisyBox(2, 0).points.flat();
  assert.deepEqual([shade, legs, box].map((one) => [standsRather(one, 2, 1), standsRather(one, 1, 2)]), [[true, false], [false, true], [false, false]]);
});

doorTest('a model that lies on its back is stood up, and laid down again', async (page) => {
  await openWhole(page, 'box.obj', obj(noisyBox(4, 0)));
  await page.waitForFunction(() => document.querySelector('canvas#space-canvas:not([width="300"], :not([width]))'));
  const turn = page.getByRole('button', { name: 'Quarter turn' });
  const alike = [];
  const lying = await brightness(page, '#space-canvas');
  for (let i = 0; i < 2; i++) {
    await turn.click();
    alike.push(correlation(lying, await brightness(page, '#space-canvas')));
  }
  assert.ok(alike[0] < 0.9 && alike[1] > 0.99, alike.join());
}, { drawn: true });

pageTest('without WebGL that is said, and the rest works', async (page) => {
  assert.match(await page.locator('#space-missing').innerText(), /no WebGL/);
  assert.equal(await page.locator('#space-canvas').isVisible(), false);
  await choose(page.getByRole('radio', { name: 'Laid flat', exact: true }));
  await page.locator('#result-picture').waitFor();
});

sharedTest('an answer that takes long can be done without, and asked for again; then it lies flat', async (page) => {
  // In one go, for the answer may be there in a moment.
  const cancelled = await page.evaluate(() => {
    const radio = /** @type {HTMLInputElement} */ (document.querySelector('input[name="view"][value="sheet"]'));
    radio.checked = true;
    radio.dispatchEvent(new Event('change', { bubbles: true }));
    const waiting = /** @type {HTMLElement} */ (document.querySelector('#waiting'));
    const seen = !waiting.hidden && /Preparing this view/.test(waiting.innerText);
    /** @type {HTMLButtonElement} */ (document.querySelector('#waiting-cancel')).click();
    return seen && waiting.hidden && document.querySelector('#about-view')?.textContent;
  });
  assert.match(String(cancelled), /^Cancelled/);
  const told = await page.evaluateHandle(() => {
    /** @type {string[]} */
    const texts = [];
    const waiting = /** @type {HTMLElement} */ (document.querySelector('#waiting'));
    new MutationObserver(() => texts.push(waiting.querySelector('span')?.textContent ?? '')).observe(waiting, { childList: true, subtree: true, characterData: true });
    return texts;
  });
  await page.getByRole('button', { name: 'Try again' }).click();
  await page.locator('#stage[data-busy="false"]:has(#analysis)').waitFor();
  assert.match((await told.jsonValue()).join(), /Laying it flat, [1-9]\d?\s%/, 'how far it is');
  assert.equal(await page.locator('#divider').isVisible(), false);
  // What is read of the flat sheet: of a cylinder, hardly any strain.
  await page.locator('#result-picture').hover();
  const strain = await page.locator('#reading').innerText();
  assert.match(strain, /^strain [+−]?([\d.]+|[\d.]+\S*10\S+)\s%$/);
  assert.ok(Math.abs(parsed(strain.replace('strain', ''))) < 1, strain);
  await page.mouse.move(2, 2);
  assert.equal((await page.locator('#reading').innerText()).trim(), '', 'nothing beside it');
}, { drawn: true, start: '#example=cylinder&size=200&noise=0.02' });
