/** The same input at five λ. */
import assert from 'node:assert/strict';
import { parsed } from './support/numbers.mjs';
import { look, reported, runBy, sharedTest } from './support/page.mjs';

sharedTest('five λ side by side are smoother the smaller λ is, and a click takes one', async (page) => {
  const open = page.getByRole('button', { name: 'Compare five values' });
  await open.click();
  const strip = page.getByRole('group', { name: 'The same input at five λ' });
  await page.locator('#strip[aria-busy="false"]').waitFor();
  const choices = strip.getByRole('button');
  const texts = await choices.allInnerTexts();
  assert.deepEqual(texts.map((text) => text.split('\n')[0].trim()), ['1e4', '1e5', '1e6', '1e7', '1e8'].map((lambda) => `λ = ${lambda}`));
  // The larger λ, the closer to the input.
  const off = texts.map((text) => parsed(/([\d.]+)\s% from the input/.exec(text)?.[1] ?? ''));
  assert.ok(off.every((value, i) => value > 0 && (i === 0 || value < off[i - 1])), texts.join('; '));

  // What is followed more closely has more of the noise.
  const pictures = [];
  for (let i = 1; i <= 5; i++) pictures.push(await look(page, `.strip-one:nth-child(${i}) canvas`));
  for (const [i, { covered, roughness }] of pictures.entries()) {
    assert.ok(covered > 0.5, `the picture ${i + 1} is there`);
    if (i > 0) assert.ok(roughness > pictures[i - 1].roughness, pictures.map((one) => one.roughness).join(', '));
  }

  await runBy(page, () => strip.getByRole('button', { name: 'λ = 1e5' }).click());
  assert.equal(parsed(await reported(page, 'λ')), 1e5);
  assert.equal(await page.locator('#lambda-value').inputValue(), '1e5');
  assert.deepEqual(await choices.evaluateAll((all) => all.map((one) => one.getAttribute('aria-pressed'))), ['false', 'true', 'false', 'false', 'false']);
  // Another input has other pictures.
  await runBy(page, () => page.locator('#example').selectOption('cone'));
  await page.locator('#strip[aria-busy="false"]').waitFor();
  assert.notEqual((await look(page, '.strip-one:nth-child(3) canvas')).hash, pictures[2].hash);
  await open.click();
  assert.equal(await strip.isVisible(), false);
}, { start: '#example=roof&size=100' });
