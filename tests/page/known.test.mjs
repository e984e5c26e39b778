/** More than heights: occlusions; other energies; a slider that restarts. */
import assert from 'node:assert/strict';
import { deviation } from '../js/support/shapes.mjs';
import { grid, npy, parseNpy } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { open, reported, runBy, save, sharedDoorTest, sharedTest, typeLambda } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */

const [WIDTH, HEIGHT] = [48, 36];
/** @param {number} col @param {number} row */
const slope = (col, row) => 20 + 0.3 * col + 0.5 * row;

/** @param {Page} page */
const run = (page) => runBy(page, () => page.getByRole('button', { name: 'Solve', exact: true }).click());
/** @param {Page} page */
const result = async (page) => parseNpy((await save(page, 'NPY')).bytes).values;
/** @param {Page} page */
const names = (page) => page.locator('#report-table tr:not(.group) th').allInnerTexts();

sharedDoorTest('where it jumps it is torn', async (page) => {
  const step = grid(WIDTH, HEIGHT, (col, row) => slope(col, row) + (col > 20 ? 15 : 0));
  await open(page, 'step.npy', npy(WIDTH, step));
  // So small that the jump is rounded where nothing tears.
  await runBy(page, () => typeLambda(page, '1e4'));
  await page.getByLabel('Tear where it jumps').check();
  const field = page.getByLabel('Smallest jump');
  await field.fill('150');
  await field.press('Tab');
  await run(page);
  assert.ok(parsed(await reported(page, 'Torn')) > 40);
  // The pixels at the jump itself are between vertices on either side.
  const away = (/** @type {number[]} */ values) => values.filter((_, i) => Math.abs((i % WIDTH) - 20.5) > 2);
  const torn = deviation(away(await result(page)), away(step));
  await field.fill('-1');
  await field.press('Tab');
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  await runBy(page, () => page.getByLabel('Tear where it jumps').uncheck());
  const smoothed = deviation(away(await result(page)), away(step));
  assert.ok(torn < smoothed / 2, `${torn} against ${smoothed}`);
}, { drawn: true });

sharedTest('another energy is told of', async (page) => {
  await runBy(page, () => page.locator('#energy').selectOption('frobenius'));
  assert.ok((await names(page)).includes('Bending') && !(await names(page)).includes('Nuclear norms'));
  assert.match(await page.locator('#energy-hint').innerText(), /Frobenius/);
  await runBy(page, () => page.locator('#energy').selectOption('nuclear'));
  assert.ok((await names(page)).includes('Nuclear norms'));
});

sharedTest('the slider restarts the solver while it is dragged', async (page) => {
  const cold = parsed(await reported(page, 'Iterations'));
  // To the middle of the slider.
  await runBy(page, () => typeLambda(page, '1e6'));
  const box = await page.locator('#lambda').boundingBox();
  assert.ok(box);
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + box.width / 2, y);
  await page.mouse.down();
  await runBy(page, () => page.mouse.move(box.x + box.width * 0.53, y, { steps: 3 }));
  const dragged = parsed(await reported(page, 'λ'));
  assert.ok(dragged > 1e6 && dragged < 1e7, `λ is ${dragged}, with the button still down`);
  assert.ok(parsed(await reported(page, 'Iterations')) <= cold);
  await page.mouse.up();
});

sharedTest('λ by the noise, and what came of it, beside the slider', async (page) => {
  const button = page.locator('#lambda-auto');
  // By itself.
  assert.equal(await button.getAttribute('aria-pressed'), 'true');
  assert.equal(await page.locator('#energy').inputValue(), 'huber');
  const lambda = parsed(await reported(page, 'λ'));
  const hint = await page.locator('#lambda-hint').innerText();
  assert.match(hint, /^Chosen automatically \(\d+ trial solves\)\. Noise: [\d.]+, [\d.]+\s% of the range of the heights\./);
  // Two digits of it, where the slider goes on from.
  const field = Number(await page.locator('#lambda-value').inputValue());
  assert.ok(Math.abs(field / lambda - 1) < 0.06, `${field} and ${lambda}`);
  assert.ok(parsed(await reported(page, 'Noise, σ')) > 0);
  await runBy(page, () => typeLambda(page, '1e7'));
  // Undone and done again, from wherever no text is typed.
  await runBy(page, () => page.locator('#energy').press('Control+z'));
  assert.equal(await button.getAttribute('aria-pressed'), 'true');
  await runBy(page, () => page.locator('#energy').press('Control+Shift+z'));
  assert.equal(await button.getAttribute('aria-pressed'), 'false');
  assert.equal(parsed(await reported(page, 'λ')), 1e7);
  assert.equal(await page.locator('#energy').inputValue(), 'huber', 'λ changes λ alone');
  await runBy(page, () => page.locator('#energy').selectOption('nuclear'));
  await runBy(page, () => button.click());
  // λ by the noise changes λ alone.
  assert.equal(await page.locator('#energy').inputValue(), 'nuclear');
  await runBy(page, () => page.locator('#energy').selectOption('huber'));
  assert.equal(parsed(await reported(page, 'λ')), lambda);
  // Without noise there is nothing to go by, and the words say so.
  await runBy(page, () => page.locator('#noise').selectOption('0'));
  assert.match(await page.locator('#lambda-hint').innerText(), /^The input has no noise/);
});
