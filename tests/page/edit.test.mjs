/** Brush and lasso. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { applyEdit, pixelsAlong, pixelsInside, undoEdit } from '../../www/height-edits.js';
import { pageTest, reported, runBy } from './support/page.mjs';
import { parsed } from './support/numbers.mjs';

/** @typedef {import('../../www/session.js').Input} Input */

test('a brush means the pixels beside its line, a lasso those it goes around', () => {
  const size = { width: 60, height: 50 };
  const disk = pixelsAlong(size, [[30, 25]], 10);
  assert.ok(Math.abs(disk.length / (Math.PI * 100) - 1) < 0.05, `${disk.length}`);
  const bar = pixelsAlong(size, [[10, 25], [50, 25]], 5);
  assert.ok(Math.abs(bar.length / (40 * 10 + Math.PI * 25) - 1) < 0.05, `${bar.length}`);
  assert.equal(pixelsAlong(size, [[-50, -50]], 5).length, 0);
  const triangle = pixelsInside(size, [[10, 10], [50, 10], [10, 40]]);
  assert.ok(Math.abs(triangle.length / 600 - 1) < 0.05, `${triangle.length}`);
  assert.equal(pixelsInside(size, [[10, 10], [50, 10], [10, 40]], true).length, 60 * 50 - triangle.length);
  // A line that crosses itself goes around two parts.
  const bow = pixelsInside(size, [[10, 10], [50, 40], [50, 10], [10, 40]]);
  assert.ok(bow.includes(25 * 60 + 15) && bow.includes(25 * 60 + 45) && !bow.includes(12 * 60 + 30));
});

test('what is done to pixels can be taken back', () => {
  const input = /** @type {Input} */ ({ name: '', width: 3, height: 1, data: Float64Array.of(1, 2, NaN), pixelSize: 1, heightScale: 1 });
  const pixels = Uint32Array.of(1, 2);
  const out = applyEdit(input, pixels, 'out', () => 0);
  assert.deepEqual(out.change.data, Float64Array.of(1, NaN, NaN));
  assert.deepEqual(undoEdit({ ...input, ...out.change }, out.undo).data, input.data);
  const doubt = applyEdit(input, pixels, 'doubt', () => 0);
  assert.ok(doubt.change.confidence?.[0] === 1 && doubt.change.confidence[1] < 0.5);
  assert.equal(undoEdit({ ...input, ...doubt.change }, doubt.undo).confidence, undefined);
  const twice = applyEdit({ ...input, ...doubt.change }, Uint32Array.of(0), 'doubt', () => 0);
  assert.deepEqual(undoEdit({ ...input, ...twice.change }, twice.undo).confidence, doubt.change.confidence);
  assert.deepEqual(applyEdit(input, pixels, 'hold', (pixel) => 10 * pixel).change.constraints, Float64Array.of(NaN, 10, 20));
});

pageTest('heights are taken out, trusted less, held and cropped by hand, and all is undone', async (page) => {
  await runBy(page, () => page.locator('#size').selectOption('100'));
  await page.getByRole('button', { name: 'From above' }).click();
  const whole = parsed(await reported(page, 'Interior'));
  const box = await page.locator('#space-canvas').boundingBox();
  assert.ok(box);
  const side = Math.min(box.width, box.height);
  /** Over places of the square, in shares of its side from its middle. @param {[number, number][]} places */
  const stroke = async (...places) => {
    const at = ([x, y] = [0, 0]) => /** @type {const} */ ([box.x + box.width / 2 + x * side, box.y + box.height / 2 + y * side]);
    await page.mouse.move(...at(places[0]));
    await page.mouse.down();
    for (const place of places.slice(1)) await page.mouse.move(...at(place), { steps: 3 });
    await page.mouse.up();
  };
  await page.locator('#drag').selectOption('out');
  await runBy(page, () => stroke([-0.3, -0.3], [0.1, -0.3]));
  assert.ok(parsed(await reported(page, 'Interior')) < whole - 200, 'taken out');
  await page.locator('#drag').selectOption('doubt');
  await runBy(page, () => stroke([-0.3, 0.3], [0.3, 0.3]));
  assert.match(await page.locator('#input-legend').innerText(), /little or no confidence at \d+ pixels/);
  await page.locator('#drag').selectOption('hold');
  await page.locator('#edit-shape').selectOption('lasso');
  await runBy(page, () => stroke([0.2, -0.1], [0.35, -0.1], [0.35, 0.1], [0.2, 0.1]));
  assert.match(await page.locator('#input-legend').innerText(), /held at \d+ pixels/);
  await page.locator('#drag').selectOption('crop');
  await runBy(page, () => stroke([-0.2, -0.2], [0.2, -0.2], [0.2, 0.4], [-0.2, 0.4]));
  assert.ok(parsed(await reported(page, 'Interior')) < 0.4 * whole, 'cropped');
  for (let i = 0; i < 4; i++) await runBy(page, () => page.locator('#edit-undo').click());
  assert.equal(parsed(await reported(page, 'Interior')), whole);
  assert.equal((await page.locator('#input-legend').innerText()).trim(), '');
  // By keyboard, at the middle.
  await page.locator('#drag').selectOption('out');
  await page.locator('#edit-shape').selectOption('brush');
  await runBy(page, () => page.locator('#space-canvas').press('Enter'));
  assert.ok(parsed(await reported(page, 'Interior')) < whole);
  await runBy(page, () => page.keyboard.press('Control+z'));
  assert.equal(parsed(await reported(page, 'Interior')), whole);
}, { drawn: true });
