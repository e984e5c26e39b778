/** Designs: pins dragged in space, and the surface after them. */
import assert from 'node:assert/strict';
import { constraintsOf, curvePlaces, designInput, START_DESIGNS } from '../../www/design.js';
import { test } from 'node:test';
import { parsed } from './support/numbers.mjs';
import { pageTest, runBy, save, settled } from './support/page.mjs';

test('curves pass through their pins, and straight ones are straight', () => {
  const pins = [0, 0.3, 0.6, 1].map((x) => ({ x, y: 0.5 - 0.2 * x, z: 2 * x - 1 }));
  const places = curvePlaces(pins, 10);
  for (const pin of pins) {
    assert.ok(places.some(({ x, y, z }) => Math.hypot(x - pin.x, y - pin.y, z - pin.z) < 1e-12), JSON.stringify(pin));
  }
  for (const { x, y, z } of places) assert.ok(Math.hypot(y - (0.5 - 0.2 * x), z - (2 * x - 1)) < 1e-12);
});

test('what is held is where it was drawn, the edge too where it is clamped', () => {
  const { width, height } = designInput();
  const data = constraintsOf({ pins: [{ x: 0.25, y: 1, z: 0.5 }], curves: [], clamped: false });
  assert.deepEqual([...data].flatMap((z, i) => (Number.isNaN(z) ? [] : [[i, z]])), [[Math.round(0.25 * (width - 1)), 0.5 * width]]);
  const clamped = constraintsOf({ pins: [], curves: [], clamped: true });
  const held = clamped.reduce((sum, z) => sum + (z === 0 ? 1 : 0), 0);
  assert.equal(held, 2 * (width + height) - 4);
  for (const start of Object.values(START_DESIGNS)) assert.ok(constraintsOf(start).some((z) => !Number.isNaN(z)));
});

pageTest('a pin is dragged up, the surface follows, and Undo takes it back', async (page) => {
  await runBy(page, () => page.locator('input[value="design"]').check());
  await runBy(page, () => page.getByRole('button', { name: 'Tent' }).click());
  const pin = page.getByRole('slider', { name: 'Pin 1', exact: true });
  const start = Number(await pin.getAttribute('aria-valuenow'));
  await page.evaluate(() => {
    const label = /** @type {HTMLElement} */ (document.querySelector('#result-mark'));
    const seen = { previews: 0 };
    Object.assign(window, { seen });
    new MutationObserver(() => (seen.previews += Number(label.textContent === 'preview'))).observe(label, { childList: true });
  });
  const box = await pin.boundingBox();
  assert.ok(box);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let up = 4; up <= 60; up += 4) {
    await page.mouse.move(x, y - up);
    // Until a picture has followed, now and then.
    if (up % 20 === 0) await page.waitForFunction((least) => /** @type {any} */ (window).seen.previews >= least, up / 20);
  }
  await page.mouse.up();
  await settled(page);
  const now = Number(await pin.getAttribute('aria-valuenow'));
  assert.ok(now > start + 0.05, `${start} → ${now}`);
  assert.match(await page.locator('#certificate').innerText(), /^Proven/);

  // What is saved passes through the pin.
  const { bytes } = await save(page, 'NPY');
  const side = designInput().width;
  const values = new Float64Array(bytes.buffer.slice(bytes.byteOffset + bytes.length - 8 * side * side, bytes.byteOffset + bytes.length));
  const middle = values[Math.round(0.5 * (side - 1)) * side + Math.round(0.5 * (side - 1))];
  // The vertex that is held is up to half a pixel from the pixel, on a slope of less than 2.
  assert.ok(Math.abs(middle - now * side) < 2, `${middle} for ${now * side}`);

  await runBy(page, () => page.getByRole('button', { name: 'Undo', exact: true }).click());
  assert.equal(Number(await pin.getAttribute('aria-valuenow')), start);

  // Along the ground it stays under the pointer, with exaggerated heights too.
  await page.locator('#exaggeration').fill('2');
  await page.locator('#space-canvas').scrollIntoViewIfNeeded();
  await pin.scrollIntoViewIfNeeded();
  const held = await pin.boundingBox();
  assert.ok(held);
  await page.keyboard.down('Shift');
  await page.mouse.move(held.x + held.width / 2, held.y + held.height / 2);
  await page.mouse.down();
  await page.mouse.move(held.x + held.width / 2 + 12, held.y + held.height / 2);
  const moved = await pin.boundingBox();
  await page.mouse.up();
  await page.keyboard.up('Shift');
  await settled(page);
  assert.ok(moved && Math.hypot(moved.x - held.x - 12, moved.y - held.y) < 2, JSON.stringify({ held, moved }));

  await runBy(page, () => pin.press('ArrowDown'));
  assert.ok(Number(await pin.getAttribute('aria-valuenow')) < start, 'by keyboard, too');
  const pins = await page.locator('.knob').count();
  await page.getByRole('button', { name: 'Add a curve' }).focus();
  await runBy(page, () => page.keyboard.press('Enter'));
  assert.ok(await page.locator('.knob').count() > pins);
  await runBy(page, () => pin.press('Delete'));
  assert.equal(await page.getByRole('slider', { name: 'Pin 1', exact: true }).count(), 0);
  const rest = await page.locator('.knob').count();
  await page.locator('.knob').last().focus();
  await runBy(page, () => page.getByRole('button', { name: 'Remove pin' }).click());
  assert.equal(await page.locator('.knob').count(), rest - 1, 'by a finger, too');
  await runBy(page, () => page.getByRole('button', { name: 'Canopy' }).click());
  const before = parsed(await page.locator('#input-legend').innerText().then((text) => text.replace('held at ', '')));
  await runBy(page, () => page.getByLabel('Fix border at height 0').check());
  const after = parsed(await page.locator('#input-legend').innerText().then((text) => text.replace('held at ', '')));
  assert.ok(after > before);
}, { drawn: true });
