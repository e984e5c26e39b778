/** The gallery, and what is shown as an address: shared, gone back to, and reloaded. */
import assert from 'node:assert/strict';
import { addressOf, stateOf } from '../../www/address.js';
import { CARDS } from '../../www/gallery/cards.js';
import { test } from 'node:test';
import { grid, npy } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { colouredPicture } from './support/photos.mjs';
import { drop, enterPages, open, pageTest, reported, runBy, settled, typeLambda } from './support/page.mjs';

const defaults = /** @type {const} */ ({ lambda: 1e6, gap: 0.01, coarsening: 1, energy: 'nuclear', occlusionThreshold: undefined });

test('an address says what it was made of, and what it does not know is left', () => {
  const states = [
    { card: 'fig-8', settings: { lambda: 1e5 } },
    { example: { name: 'cone', size: 200, noise: 0 }, settings: { energy: /** @type {const} */ ('huber'), lambda: /** @type {const} */ ('auto') }, view: 'patches' },
    { file: 4, settings: { lambda: 1e7 }, whole: true, view: 'rulings' },
    { linked: { name: 'a b.stl', data: 'a_-b' }, settings: {} }, { file: 5, settings: {}, photo: true }, { settings: {}, unkept: true },
    { file: 3, stored: { pixelSize: 0.25, heightScale: -1e-3, noData: -7 }, settings: { occlusionThreshold: 4e4, gap: 1e-4 } },
  ];
  for (const state of states) {
    const found = stateOf(addressOf(state, defaults));
    assert.deepEqual(JSON.parse(JSON.stringify(found)), state);
  }
  assert.deepEqual(stateOf('#lambda=-3&energy=none&gap=x&view=constructor&schedule=1').settings, {});
  assert.equal(stateOf('#view=constructor').view, undefined);
});

test('the gallery has a card for each figure of the paper that it tells, with an address of its own', () => {
  const figures = CARDS.flatMap(({ figure }) => figure?.match(/\d+/g) ?? []).map(Number);
  for (const figure of [4, 5, 6, 8, 9, 10, 11, 20, 21, 22, 23, 25]) assert.ok(figures.includes(figure), `Fig. ${figure}`);
  assert.equal(new Set(CARDS.map(({ id }) => id)).size, CARDS.length);
  for (const { id, input, words, look } of CARDS) {
    assert.ok(words.split('. ').length >= 2 && look.length > 10, id);
    const made = input?.(60, 0);
    if (!made) continue;
    assert.equal(made.data.length, made.width * made.height, id);
    assert.ok(made.data.some(Number.isFinite) && !made.data.some((z) => Math.abs(z) === Infinity), id);
  }
});

pageTest('a link holds a small file with its settings, and says when it is not whole', async (page) => {
  await open(page, 'a slope.npy', npy(48, grid(48, 36, (col, row) => 0.1 * col + 0.15 * row)));
  await runBy(page, () => typeLambda(page, '2e5'));
  const link = await page.evaluate(() => new Promise((resolve) => {
    Object.defineProperty(navigator, 'clipboard', { value: { writeText: async (/** @type {string} */ text) => resolve(text) } });
    document.getElementById('share')?.click();
  }));
  await page.getByRole('button', { name: 'Copied, with the file' }).waitFor();
  // As on another machine.
  await page.evaluate(() => indexedDB.deleteDatabase('developable'));
  await page.goto(String(link));
  await page.reload();
  await page.locator('#file-name', { hasText: 'a slope' }).waitFor();
  await settled(page);
  assert.equal(parsed(await reported(page, 'λ')), 2e5);
  await page.goto(String(link).slice(0, -40));
  await page.getByRole('alert').filter({ hasText: 'not whole' }).waitFor();
});

pageTest('settings stand in the address, Back undoes them, and a file is there after a reload', async (page) => {
  await page.waitForURL(/example=roof/);
  await runBy(page, () => typeLambda(page, '1e5'));
  await page.waitForURL(/lambda=1e5/);
  await runBy(page, () => page.goBack().then(() => {}));
  assert.notEqual(parsed(await reported(page, 'λ')), 1e5);
  assert.equal(await page.locator('#lambda-auto').getAttribute('aria-pressed'), 'true');

  await open(page, 'slope.npy', npy(48, grid(48, 36, (col, row) => 0.1 * col + 0.15 * row)));
  await page.waitForURL(/file=\d/);
  await runBy(page, () => page.getByRole('button', { name: 'Steeper' }).click());
  await page.waitForURL(/pixelSize=0\.5/);
  await page.reload();
  await page.locator('#file-name', { hasText: 'slope' }).waitFor();
  await settled(page);
  assert.equal(await page.getByLabel('Pixel size').inputValue(), '0.5');
  assert.equal(await page.locator('#recent').isVisible(), false, 'it is open, and no other was opened before');

  // A photo of a page, too; going back leads to what was there before it.
  await enterPages(page);
  await page.locator('#page-caption', { hasText: 'curled' }).waitFor();
  await drop(page, 'letter.png', colouredPicture);
  await page.waitForURL(/file=\d+&photo=1/);
  await page.reload();
  await page.locator('#page-caption', { hasText: 'letter' }).waitFor();
  await page.goBack();
  await page.locator('#page-caption', { hasText: 'curled' }).waitFor();
  await page.goBack();
  await page.locator('#home').waitFor();
  await page.goBack();
  await page.locator('#file-name', { hasText: 'slope' }).waitFor();
  await settled(page);

  // A view that is chosen at once does not take the place of the input before.
  await page.evaluate(() => void (location.hash = '#example=cone&size=64&noise=0.02'));
  await page.locator('#input-caption', { hasText: 'cone' }).waitFor();
  await page.locator('#recent', { hasText: 'slope.npy' }).waitFor();
  await page.locator('input[name="view"][value="patches"]').evaluate((/** @type {HTMLInputElement} */ radio) => radio.click());
  await settled(page);
  // The size is the nearest that is offered; to say so makes no entry of its own.
  await page.waitForURL(/example=cone&size=100/);
  await page.goBack();
  await page.locator('#file-name', { hasText: 'slope' }).waitFor();
  await settled(page);

  // A card of the gallery by its address, and the same at five λ.
  await page.goto(`${page.url().replace(/#.*/, '')}#fig-8&lambda=1e5`);
  await page.locator('#story-title', { hasText: 'Fig. 8 of the paper)' }).waitFor();
  await settled(page);
  assert.equal(parsed(await reported(page, 'λ')), 1e5);
  await page.locator('#strip[aria-busy="false"]').waitFor();
  // Nothing is said of pieces that cannot be told apart.
  for (const words of await page.locator('.strip-one .muted').allInnerTexts()) assert.match(words, /^[\d.]+\s% from the input$/);
  await runBy(page, () => page.getByRole('button', { name: 'λ = 1e7' }).click());
  assert.equal(parsed(await reported(page, 'λ')), 1e7);
  await page.getByRole('button', { name: /^Gallery/ }).click();
  assert.equal(await page.locator('.card').count(), CARDS.length);
  await runBy(page, () => page.getByRole('button', { name: /Fig\. 11/ }).click());
  await page.waitForURL(/#fig-11$/);
  assert.match(await page.locator('#verdict').innerText(), /^\d+ smooth pieces meet in \d+ creases\.$/);
  assert.match(await page.locator('#verdict-detail').innerText(), /^[\d.]+× less noise \(against the noise-free example\)/);
  assert.equal(await page.locator('#story-turn').isVisible(), false);
  // Those of an address hold, even where they follow a card's.
  await runBy(page, () => page.evaluate(() => void (location.hash = '#example=cone&size=100&noise=0.02&lambda=200000&energy=nuclear')));
  assert.equal(parsed(await reported(page, 'λ')), 2e5);
  assert.equal(await page.getByLabel('Energy').inputValue(), 'nuclear');
  // λ is of its input; the energy is a wish for all.
  await open(page, 'third.npy', npy(48, grid(48, 36, (col) => 2 * col)));
  assert.equal(await page.locator('#lambda-auto').getAttribute('aria-pressed'), 'true');
  assert.equal(await page.getByLabel('Energy').inputValue(), 'nuclear');
  // A rotation as the paper's, of which the result is the same.
  await runBy(page, () => page.evaluate(() => void (location.hash = '#fig-22')));
  for (const angle of ['0', '45']) {
    if (angle !== '0') await runBy(page, () => page.getByLabel('Turned by').selectOption(angle));
    assert.equal(await page.locator('#verdict').innerText(), 'One smooth piece without a crease.', `${angle}°`);
    await page.locator('#stage[data-busy="false"] #about-view', { hasText: /deviation from straight\s*[1-4](\.\d+)?\s%/ }).waitFor();
  }
  // Whatever else is opened ends its story.
  await drop(page, 'other.npy', npy(48, grid(48, 36, (col) => 3 * col)));
  await page.locator('#file-name', { hasText: 'other' }).waitFor();
  await settled(page);
  assert.equal(await page.locator('#story').isVisible(), false);
  // So do the settings that made its point.
  assert.equal(await page.getByLabel('Energy').inputValue(), 'huber');
  assert.equal(await page.locator('#lambda-auto').getAttribute('aria-pressed'), 'true');
}, { start: '#example=roof&size=100' });
