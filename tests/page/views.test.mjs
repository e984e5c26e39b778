/** Views of the result, against what is known of the examples' shapes. */
import assert from 'node:assert/strict';
import { grid, npy } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { choose, downloaded, figure, look, open, openSheets, pageTest, painted, runBy, saveAs, settled, sharedDoorTest, sharedTest, sheetsDrawn, viewed } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */

/**
 * @param {Page} page
 * @param {string} name
 */
async function view(page, name) {
  const radio = page.getByRole('radio', { name: new RegExp(`^${name}(,|$)`) });
  // What is for specialists is in the drawer.
  if (!(await radio.isVisible())) await page.locator('#report-open').click();
  await choose(radio);
  await viewed(page);
  await painted(page);
}

/**
 * The text beside a name below the views.
 * @param {Page} page
 * @param {string | RegExp} name
 */
const told = async (page, name) => (await figure(page, '#about-view', name).innerText()).trim();

/**
 * @param {Page} page
 * @param {string} example
 * @param {{ size?: string, noise?: string }} [options]
 */
async function example(page, example, { size = '200', noise = '0.02' } = {}) {
  await runBy(page, () => page.evaluate((address) => void (location.hash = address), `#example=${example}&size=${size}&noise=${noise}`));
}

/** @param {Page} page */
const ticks = async (page) => (await page.locator('#about-view .ticks span').allInnerTexts()).map(parsed);

/** @param {number[]} values */
const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/** Points over the square that the examples lie over. @param {number} n */
const points = (n) => grid(n, n, (col, row) => row * n + col)
  .map((i) => [((i % n) + 0.5) / n - 0.5, (Math.floor(i / n) + 0.5) / n - 0.5]);

/** The cylinder example: its radius, and its axis 25° from x. */
const RADIUS = 0.85;
const [SIN, COS] = [Math.sin((25 * Math.PI) / 180), Math.cos((25 * Math.PI) / 180)];
/** @param {number[]} point */
const across = ([x, y]) => COS * y - SIN * x;

sharedTest('curvatures of the cylinder: one bend as the radius says, none of the other', async (page) => {
  await example(page, 'cylinder', { noise: '0' });
  const plain = [await look(page, 'input'), await look(page, 'result')].map(({ hash }) => hash);
  await view(page, 'Curvature κ₂');
  const bends = points(60).map((point) => RADIUS ** 2 / (RADIUS ** 2 - across(point) ** 2) ** 1.5);
  const [kappa1] = (await told(page, 'κ₁')).split('→').map(parsed);
  assert.ok(Math.abs(kappa1 / median(bends) - 1) < 0.03, `${kappa1} against ${median(bends)}`);
  const [before, after] = (await told(page, 'κ₂')).split('→').map(parsed);
  // The input's is what resampling it to the lattice leaves.
  assert.ok(before < 0.03 / RADIUS && after < 0.01 / RADIUS, `${before} → ${after}`);
  assert.match(await page.locator('#about-view figcaption').innerText(), /κ₂.*1\/unit; figures: input → result$/);
  const seen = [await look(page, 'input'), await look(page, 'result')].map(({ hash }) => hash);
  assert.ok(seen[0] !== plain[0] && seen[1] !== plain[1], 'both are coloured');

  await view(page, 'Curvature K');
  assert.match(await page.locator('#about-view figcaption').innerText(), /K in 1\/unit²; figures: input → result$/);
  const values = await ticks(page);
  assert.ok(values.every((value, i) => value === -values[values.length - 1 - i]), 'symmetric');
  assert.ok(values.includes(0) && values.length >= 3);
  assert.ok(parsed((await told(page, 'Median |K|')).split('→')[1]) < 0.02 / RADIUS ** 2);
  await view(page, 'Shaded');
  assert.equal((await look(page, 'result')).hash, plain[1]);
  assert.equal(await page.locator('#analysis').isVisible(), false);
}, { drawn: true });

sharedDoorTest('curvatures are in the units of the file', async (page) => {
  // A cap of a sphere, whose curvatures are the same everywhere, in pixels that are not of side 1.
  const [radius, side, pixels] = [40, 0.5, 61];
  const cap = grid(pixels, pixels, (col, row) => Math.sqrt(radius ** 2 - (side * (col - 30)) ** 2 - (side * (row - 30)) ** 2));
  await open(page, 'cap.npy', npy(pixels, cap));
  // Each is solved at once.
  for (const [label, value] of /** @type {const} */ ([['Pixel size', String(side)], ['Height scale', '1']])) {
    const field = page.getByLabel(label);
    if (await field.inputValue() === value) continue;
    await runBy(page, () => field.fill(value).then(() => field.blur()));
  }
  await view(page, 'Curvature K');
  const [gauss] = (await told(page, 'Median |K|')).split('→').map(parsed);
  // Resampling to the lattice roughens the heights: it is the unit that matters here.
  assert.ok(gauss * radius ** 2 > 0.7 && gauss * radius ** 2 < 1.5, `${gauss}`);
  await view(page, 'Curvature κ₂');
  const [bend] = (await told(page, 'Median |κ₂|')).split('→').map(parsed);
  assert.ok(bend * radius > 0.7 && bend * radius < 1.5, `${bend}`);
});

sharedTest('rulings are drawn over the result only', async (page) => {
  await example(page, 'cylinder', { noise: '0' });
  const plain = [await look(page, 'input'), await look(page, 'result')].map(({ hash }) => hash);
  await view(page, 'Rulings');
  const seen = [await look(page, 'input'), await look(page, 'result')].map(({ hash }) => hash);
  assert.ok(seen[0] === plain[0] && seen[1] !== plain[1]);
  assert.ok(parsed(await told(page, 'Lines')) > 10);
  assert.ok(parsed(await told(page, 'Median deviation from straight')) < 3);
  // Along the axis, from side to side.
  const longest = parsed(await told(page, 'Longest'));
  assert.ok(longest > 0.9 && longest < 1 / COS + 0.01, `${longest}`);
}, { drawn: true });

sharedTest('what cannot be laid flat whole is laid flat in pieces, which are saved as sheets to cut out', async (page) => {
  await example(page, 'roof', { size: '100' });
  await view(page, 'Laid flat');
  assert.match(await page.locator('#about-view .said').innerText(), /In one piece it would stretch.*sheets.*cuts/);
  assert.ok(parsed(await told(page, 'Largest strain')) <= 1);
  assert.ok((await look(page, '#result-picture')).covered > 0.2);

  await openSheets(page);
  const [wide] = (await figure(page, '.sheets', 'Drawing').textContent() ?? '').split('×').map(parsed);
  const svg = await saveAs(page, 'SVG');
  assert.match(svg.bytes.toString(), /^(<\?xml[^>]*>\s*)?<svg/);
  assert.ok(Math.abs(Number(/width="([\d.]+)mm"/.exec(svg.bytes.toString())?.[1]) / wide - 1) < 0.01, 'in true size');

  // Twice as large takes about four times the paper.
  await openSheets(page);
  const pages = async () => parsed(await figure(page, '.sheets', 'Pages').textContent() ?? '');
  const before = await pages();
  const side = page.getByLabel('Longer side when finished');
  const doubled = 2 * Number(await side.inputValue());
  // What cannot be is refused in its place, and nothing of another size can be saved.
  for (const wrong of ['0', '-5']) {
    await side.fill(wrong);
    await page.locator('#sheet-side-wrong', { hasText: /^This must be a number from 10 to 5000/ }).waitFor();
    assert.ok(await page.locator('#save-now').isDisabled());
  }
  await side.fill(String(doubled));
  await figure(page, '.sheets', 'Drawing').filter({ hasNotText: String(Math.round(wide)) }).waitFor({ state: 'attached' });
  assert.ok(await pages() > 2 * before, `${await pages()} pages instead of ${before}`);
  // From the change on, what was drawn before cannot be saved.
  assert.ok(await page.getByLabel('Paper', { exact: true }).evaluate((/** @type {HTMLSelectElement} */ paper) => {
    paper.value = 'a4';
    paper.dispatchEvent(new Event('input', { bubbles: true }));
    return /** @type {HTMLButtonElement} */ (document.querySelector('#save-now')).disabled;
  }));
  await page.locator('#save-formats').getByRole('radio', { name: /^PDF / }).check();
  await page.locator('#save-size', { hasText: /pdf, / }).waitFor();
  const saveBox = await page.locator('#save-now').boundingBox();
  assert.ok(saveBox && saveBox.y + saveBox.height <= 900, `Save is in view, at ${saveBox?.y}`);
  const pdf = await downloaded(page, () => page.locator('#save-now').click());
  assert.equal(pdf.bytes.toString('latin1', 0, 5), '%PDF-');
  // The dialog stays, and so does the size: the next format is of the same.
  await page.locator('#save-size', { hasText: /^Saved .*pdf/ }).waitFor();
  const again = await saveAs(page, 'SVG');
  const twice = Number(/width="([\d.]+)mm"/.exec(again.bytes.toString())?.[1]);
  await openSheets(page);
  assert.equal(Number(await side.inputValue()), doubled, 'kept from save to save');
  assert.ok(twice > 1.8 * wide, `${twice} mm`);
  // Done without, as soon as it has begun, and asked for again.
  await page.evaluate(() => {
    const cutting = /** @type {HTMLElement} */ (document.querySelector('#cutting'));
    new MutationObserver((_, observer) => {
      if (cutting.hidden) return;
      observer.disconnect();
      /** @type {HTMLButtonElement} */ (document.querySelector('#cutting-cancel')).click();
    }).observe(cutting, { attributes: true });
  });
  await page.getByLabel('Tab depth').fill('4.5');
  await page.locator('.sheets-options .said', { hasText: 'Cancelled' }).waitFor();
  await page.getByRole('button', { name: 'Cut the sheets' }).click();
  await sheetsDrawn(page);
  assert.equal(await page.locator('#cutting').isVisible(), false);
  assert.match((await saveAs(page, 'DXF')).bytes.toString(), /SECTION/);
});

sharedTest('another result takes the place of an answer that is still being worked out', async (page) => {
  await choose(page.getByRole('radio', { name: 'Laid flat', exact: true }));
  // Not waited for: the answer is about something that is gone.
  await runBy(page, () => page.locator('#example').selectOption('cylinder'));
  await page.locator('#stage[data-busy="false"]:has(#analysis)').waitFor();
  assert.match(await page.locator('#about-view .said').innerText(), /^Laid flat/);
  assert.equal(await page.locator('#notice').isVisible(), false);
}, { start: '#example=roof&size=200' });

sharedTest('a view that is left and chosen again at once is worked out anew', async (page) => {
  await page.evaluate(() => {
    for (const view of ['rulings', 'shaded', 'rulings']) /** @type {HTMLInputElement} */ (document.querySelector(`input[name="view"][value="${view}"]`)).click();
  });
  await page.locator('#about-view .figures dt', { hasText: 'Longest' }).waitFor();
  assert.equal(await page.getByRole('alert').isVisible(), false);
});

pageTest('a view that cannot be worked out says so, and the surface stays', async (page) => {
  // Where the file is damaged, the copy in a module would do.
  await page.route('**/inline/unroll.js', (route) => route.fulfill({ contentType: 'text/javascript', body: "throw new Error('damaged')" }));
  await page.route('**/unroll_bg.wasm', (route) => route.fulfill({ contentType: 'application/wasm', body: 'nothing' }));
  // The headline has asked for the pieces, and so has loaded the sound file.
  await page.reload();
  await settled(page);
  await view(page, 'Laid flat');
  await page.getByRole('alert').filter({ hasText: 'could not be worked out' }).waitFor();
  assert.equal(await page.locator('#result-picture').isVisible(), false);
  await page.unrouteAll();
  await view(page, 'Rulings');
  assert.ok(parsed(await told(page, 'Lines')) > 10, 'it can be tried again');
}, { sources: true });

sharedTest('the views can be switched by keyboard', async (page) => {
  await page.getByRole('radio', { name: 'Shaded', exact: true }).focus();
  for (let i = 0; i < 3; i++) await page.keyboard.press('ArrowRight');
  await page.locator('#stage[data-busy="false"]:has(#analysis) .bar').waitFor();
  assert.ok(await page.getByRole('radio', { name: 'Curvature K' }).isChecked());
});
