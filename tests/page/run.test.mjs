/** Running: to the end, with progress, and not to the end. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { parsed } from './support/numbers.mjs';
import { choose, downloaded, look, pageTest, reported, runBy, settled, sharedTest, typeLambda } from './support/page.mjs';
import { parsePng } from './support/photos.mjs';

/** @typedef {import('playwright-core').Page} Page */

/**
 * Starts a run that is long enough to be interrupted: many vertices, a small λ, and a gap far below the usual one.
 * @param {Page} page
 */
async function startLongRun(page) {
  await page.locator('#size').selectOption('400');
  await page.locator('#input-caption', { hasText: '400 × 400' }).waitFor();
  // Each ends the run before.
  await typeLambda(page, '1e5');
  await page.getByLabel('Proven within').selectOption('0.0001');
  await page.locator('#page[data-phase="running"]').waitFor();
  await page.locator('#running span', { hasText: 'iterations' }).waitFor();
}

sharedTest('the first visit shows a solved example with its certificate', async (page) => {
  const target = Number(await page.getByLabel('Proven within').inputValue());
  const gap = parsed(await reported(page, 'Gap'));
  assert.ok(gap > 0 && gap <= 100 * target, `gap ${gap} %`);
  assert.match(await page.locator('#certificate').innerText(), /^Proven within [\d.]+\s%/);

  const [objective, bound] = [parsed(await reported(page, 'Objective')), parsed(await reported(page, 'Dual bound'))];
  assert.ok(bound <= objective, `${bound} above ${objective}`);
  const terms = parsed(await reported(page, 'Fidelity')) + parsed(await reported(page, 'Bending'));
  assert.ok(Math.abs(terms - objective) < 1e-3 * objective, `${terms} against ${objective}`);

  const saved = await downloaded(page, () => page.locator('#report-save').evaluate((button) => /** @type {HTMLButtonElement} */ (button).click()));
  assert.equal(saved.name, 'roof-report.json');
  const file = JSON.parse(saved.bytes.toString());
  assert.ok(Math.abs(100 * file.gap - gap) <= 0.1 * gap + 0.01, 'the same gap');
  assert.ok(await page.locator('#copy-command').isDisabled() && await page.locator('#copy-code').isEnabled(), 'an example is made by code alone');
  const reason = page.locator('#report-uncopied');
  assert.match(await reason.innerText(), /no command .* not examples/, 'and that is said where the button is');
  await page.locator('#report-open').click();
  const [above, below] = await Promise.all([page.locator('#copy-command'), reason].map((one) => one.boundingBox()));
  assert.ok(above && below && below.y > above.y && below.y < above.y + 3 * above.height, 'beneath it');
  const cited = await page.evaluate(() => {
    const copied = new Promise((resolve) => Object.defineProperty(navigator, 'clipboard', { value: { writeText: async (/** @type {string} */ text) => resolve(text) } }));
    /** @type {HTMLButtonElement} */ (document.querySelector('#copy-citation')).click();
    return /** @type {Promise<string>} */ (copied);
  });
  assert.match(cited, /^@article\{.*doi = \{10\.1145\/3386569\.3392419\}\s\}\s$/s);
  await page.locator('#report-open').click();
  // All that the page shows.
  assert.deepEqual([file.input.name, file.input.size, file.input.noise, file.settings.gap], ['roof', 400, 0.02, target]);
  assert.match(await page.locator('#verdict').innerText(), new RegExp(`^${file.pieces} smooth pieces meet in ${file.creases} creases`));
  assert.ok(file.curvature.result.medianGaussian < file.curvature.input.medianGaussian && file.errors.heights.after < file.errors.heights.before);
  assert.equal(file.version, JSON.parse(await readFile(new URL('../../pkg/package.json', import.meta.url), 'utf8')).version);
  // A quick run may end before any progress is told.
  const { level, iteration, gap: last } = file.convergence.at(-1);
  assert.deepEqual([level, iteration, last], [0, file.iterations, file.gap], 'the convergence ends with the result');
  assert.ok(file.convergence.every((/** @type {{ elapsed: number }} */ { elapsed }, /** @type {number} */ i) => i === 0 || elapsed >= file.convergence[i - 1].elapsed));
  const table = await downloaded(page, () => page.locator('#report-csv').evaluate((button) => /** @type {HTMLButtonElement} */ (button).click()));
  const lines = table.bytes.toString().trimEnd().split('\r\n');
  assert.equal(lines[0], 'quantity,value');
  const figures = new Map(lines.slice(1).map((line) => /** @type {[string, string]} */ (line.split(','))));
  // Numbers as a program reads them, not rounded.
  for (const [path, value] of /** @type {const} */ ([['gap', file.gap], ['objective', file.objective], ['curvature.result.medianGaussian', file.curvature.result.medianGaussian], ['errors.heights.after', file.errors.heights.after]])) {
    assert.equal(Number(figures.get(path)), value, path);
  }
  const picture = await downloaded(page, () => page.getByRole('button', { name: 'Save this view (PNG)' }).click());
  const { width, height, data } = parsePng(picture.bytes);
  const colours = new Set(Array.from({ length: width }, (_, i) => data[4 * (Math.floor(data.length / 8 / width) * width + i)]));
  const shown = await page.locator('#space-canvas').evaluate((canvas) => canvas.clientWidth);
  assert.ok(width === 2 * shown && colours.size > 20, `${colours.size} greys`);
  // What the colours mean goes with the picture.
  await choose(page.getByRole('radio', { name: 'Curvature K' }));
  await page.locator('#stage[data-busy="false"]:has(#analysis) .bar').waitFor();
  const coloured = parsePng((await downloaded(page, () => page.getByRole('button', { name: 'Save this view (PNG)' }).click())).bytes);
  const bar = coloured.data.subarray(4 * width * (height + 2.5 * Math.round(width / 60)));
  const [left, right] = [0.12, 0.88].map((share) => [...bar.subarray(4 * Math.round(share * width))].slice(0, 3));
  assert.ok(left[2] > 1.5 * left[0] && right[0] > 1.5 * right[2], `from blue, ${left}, to red, ${right}`);
  await choose(page.getByRole('radio', { name: 'Shaded', exact: true }));

  const print = await page.pdf({ format: 'A4', printBackground: true });
  assert.equal(print.toString('latin1').match(/\/Type\s*\/Page\b/g)?.length, 1, 'printed, it is one page');
}, { start: '#example=roof', drawn: true });

sharedTest('examples are smoother than their input, and closer to the truth', async (page) => {
  for (const name of ['roof', 'house', 'cone']) {
    if ((await page.locator('#example').inputValue()) !== name) await runBy(page, () => page.locator('#example').selectOption(name));
    const [input, result] = [await look(page, 'input'), await look(page, 'result')];
    assert.ok(input.covered > 0.1, `${name}: the input covers some of its canvas`);
    assert.ok(result.roughness < input.roughness / 2, `${name}: ${result.roughness} against ${input.roughness}`);
    const [before, after] = (await reported(page, 'Heights')).split('→').map(parsed);
    assert.ok(after < before / 2, `${name}: ${after} against ${before}`);
  }
}, { start: '#example=roof&size=200', drawn: true });

pageTest('progress moves the bar', async (page) => {
  await page.evaluate(() => {
    const bar = /** @type {HTMLProgressElement} */ (document.querySelector('#running progress'));
    const [values, far] = [/** @type {(number | null)[]} */ ([]), /** @type {number[]} */ ([])];
    Object.assign(window, { values, far });
    new MutationObserver(() => {
      values.push(bar.hasAttribute('value') ? bar.value : null);
      const [, percent = '0'] = /Within ([\d.]+)/.exec(bar.nextElementSibling?.textContent ?? '') ?? [];
      if (Number(percent) > 5) far.push(bar.value);
    }).observe(bar, { attributes: true });
  });
  await runBy(page, () => page.getByLabel('Proven within').selectOption('0.001'));
  // Where nothing is known of what is left, the bar has no value: so it is at the end, too, when the gap has been reached.
  const values = (await page.evaluate(() => /** @type {any} */ (window).values)).filter((/** @type {number | null} */ value) => value !== null);
  const moved = new Set(values);
  assert.ok(moved.size >= 4, `the bar stood at ${[...moved]}`);
  assert.deepEqual(values, values.toSorted((/** @type {number} */ a, /** @type {number} */ b) => a - b), 'never back');
  assert.ok(values.at(-1) > 0.9, `${values.at(-1)}`);
  const far = await page.evaluate(() => /** @type {any} */ (window).far);
  assert.ok(Math.max(...far) < 0.9, `the bar stood at ${far} while the gap was large`);
}, { start: '#example=roof&size=200' });

sharedTest('cancel is heard at once and keeps the best surface, marked', async (page) => {
  await startLongRun(page);
  const word = await page.evaluate(() => {
    /** @type {HTMLButtonElement} */ (document.querySelector('#running-cancel')).click();
    return document.querySelector('#running span')?.textContent;
  });
  assert.match(String(word), /^Stopping/, 'at once there is a word that it was heard');
  await settled(page);
  assert.match(await page.locator('#certificate').innerText(), /^Cancelled after/);
  assert.equal(await page.locator('#result-mark').innerText(), 'cancelled');
  assert.match(await reported(page, 'Stopped by'), /cancelled/);
  // Nothing was sharpened by then: the report has no other number of creases than the headline.
  assert.equal(await page.locator('#report-table th', { hasText: /crease/i }).count(), 0);
  assert.ok(await page.locator('#end-file').isEnabled(), 'it can be saved');
});

sharedTest('another λ during a run replaces the run', async (page) => {
  await startLongRun(page);
  await typeLambda(page, '1e7');
  await page.getByLabel('Proven within').selectOption('0.1');
  await settled(page);
  assert.match(await page.locator('#certificate').innerText(), /^Proven/);
  assert.equal(parsed(await reported(page, 'λ')), 1e7);
  assert.equal(await page.locator('#result-mark').isVisible(), false);
});

sharedTest('λ can be typed, and a wrong one is refused in place', async (page) => {
  const field = page.getByLabel('λ as a number');
  await runBy(page, async () => {
    await field.fill('2.5e5');
    await field.press('Tab');
  });
  assert.equal(parsed(await reported(page, 'λ')), 2.5e5);
  const before = await page.locator('#verdict').innerText();
  await field.fill('-3');
  await field.press('Tab');
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  // Its fold is opened again.
  await page.locator('#settings-more').evaluate((fold) => /** @type {HTMLDetailsElement} */ (fold).open = false);
  await page.evaluate(() => /** @type {HTMLButtonElement} */ (document.querySelector('#run')).click());
  assert.equal(await page.locator('#page').getAttribute('data-phase'), 'idle', 'nor solved with another one');
  assert.ok(await field.evaluate((input) => input === document.activeElement));
  assert.equal(await page.locator('#verdict').innerText(), before);
});

sharedTest('a λ that is no number is said at its field, a decimal comma or a power is one, and nothing typed is the automatic one', async (page) => {
  const [field, wrong] = [page.getByLabel('λ as a number'), page.locator('#lambda-value-wrong')];
  for (const typed of ['abc', '0', '1e30']) {
    await field.fill(typed);
    await field.press('Tab');
    assert.match(await wrong.innerText(), /^This must be a number from 10⁻¹² to 10¹⁵/);
    assert.equal(await field.getAttribute('aria-invalid'), 'true');
    assert.equal(await page.getByRole('alert').isVisible(), false);
  }
  await runBy(page, () => field.fill('1,5e6').then(() => field.blur()));
  assert.equal(parsed(await reported(page, 'λ')), 1.5e6);
  assert.equal(await field.getAttribute('aria-invalid'), null);
  // As the page itself writes it.
  await runBy(page, () => field.fill('2.5\u202f·\u202f10⁶').then(() => field.blur()));
  assert.equal(parsed(await reported(page, 'λ')), 2.5e6);
  await runBy(page, () => field.fill('').then(() => field.blur()));
  assert.equal(await page.locator('#lambda-auto').getAttribute('aria-pressed'), 'true');
});
