/** Views of the result, against what is known of the examples' shapes. */
import assert from 'node:assert/strict';
import { grid, npy, png16 } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { choose, downloaded, look, open, pageTest, painted, runBy, save, saveAs, settled, sharedDoorTest, sharedTest } from './support/page.mjs';
import { parsePng } from './support/photos.mjs';

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
  await page.locator('#stage[data-busy="false"]:has(#analysis)').waitFor({ state: 'attached' });
  await painted(page);
}

/**
 * The text beside a name below the views.
 * @param {Page} page
 * @param {string | RegExp} name
 */
async function told(page, name) {
  const figure = page.locator('#about-view .figures div').filter({ has: page.locator('dt', { hasText: name }) });
  return (await figure.locator('dd').innerText()).trim();
}

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

sharedTest('noise has curvature everywhere, the result next to none, on one scale', async (page) => {
  await example(page, 'cylinder');
  await view(page, 'Curvature K');
  const [before, after] = (await told(page, 'Median |K|')).split('→').map(parsed);
  assert.ok(after < before / 1000, `${before} → ${after}`);
  const [all, few] = (await told(page, '|K| above 1')).split('→').map(parsed);
  assert.ok(all > 95 && few < 20, `${all} % → ${few} %`);
});

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

/** Heights of the roof's parts: a vault along each axis, and a tower. */
const arc = (/** @type {number} */ offset, /** @type {number} */ radius) =>
  Math.sqrt(radius ** 2 - offset ** 2) - Math.sqrt(radius ** 2 - 0.25);
/** @type {((x: number, y: number) => number)[]} */
const parts = [(_, y) => arc(y, 0.7), (x) => arc(x, 0.65), (x, y) => 0.45 - 1.3 * Math.hypot(x, y)];

sharedTest('the roof has the patches that it was made of, with their areas', async (page) => {
  await example(page, 'roof', { noise: '0' });
  await view(page, 'Patches');
  assert.equal(await told(page, 'Patches'), '5', 'a tower, and two vaults in two pieces each');
  assert.equal(await told(page, 'Creases'), '8');
  // By the surface's area element over a fine grid.
  const areas = [0, 0, 0];
  const [n, step] = [500, 1e-6];
  for (const [x, y] of points(n)) {
    const heights = parts.map((part) => part(x, y));
    const top = heights.indexOf(Math.max(...heights));
    const slopes = [parts[top](x + step, y) - heights[top], parts[top](x, y + step) - heights[top]].map((d) => d / step);
    areas[top] += Math.hypot(1, ...slopes) / n ** 2;
  }
  const expected = [areas[0] / 2, areas[0] / 2, areas[1] / 2, areas[1] / 2, areas[2]].sort((a, b) => b - a);
  const total = expected.reduce((sum, area) => sum + area);
  assert.ok(Math.abs(parsed(await told(page, 'Area')) / total - 1) < 0.05);
  const found = (await page.locator('#about-view .key').allInnerTexts()).map((text) => parsed(text.split(':')[1]) / 100);
  assert.equal(found.length, 5);
  found.forEach((share, i) => assert.ok(Math.abs((share * total) / expected[i] - 1) < 0.08, `${found} against ${expected}`));
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

sharedTest('the cylinder laid flat is as large as it is bent', async (page) => {
  await example(page, 'cylinder', { noise: '0' });
  // Without the shrinking of curvature that comes with a smaller λ.
  await runBy(page, async () => {
    await page.getByLabel('λ as a number').fill('1e9');
    await page.getByLabel('λ as a number').press('Tab');
  });
  await view(page, 'Laid flat');
  // Flat places of the border's points, turned as little as possible from where they are seen.
  const along = (/** @type {number[]} */ [x, y]) => COS * x + SIN * y;
  const flat = (/** @type {number[]} */ point) => {
    const [s, t] = [along(point), RADIUS * Math.asin(across(point) / RADIUS)];
    return [COS * s - SIN * t, SIN * s + COS * t];
  };
  let [dot, cross] = [0, 0];
  for (const point of points(100)) {
    const [x, y] = flat(point);
    dot += x * point[0] + y * point[1];
    cross += point[0] * y - point[1] * x;
  }
  const [c, s] = [dot / Math.hypot(dot, cross), cross / Math.hypot(dot, cross)];
  // The lattice's vertices lie between the centres of the outermost pixels.
  const [side, edge] = [1 / 200, 0.5 - 0.5 / 200 + 1e-9];
  const ends = [Infinity, -Infinity, Infinity, -Infinity];
  for (let row = 0, y = edge; y > -edge; y = edge - ++row * side * Math.sqrt(0.75)) {
    for (let col = 0; col <= 200; col++) {
      const x = (col - 0.5 * (row % 2)) * side - edge;
      if (Math.abs(x) > edge) continue;
      const [fx, fy] = flat([x, y]);
      [c * fx + s * fy, c * fy - s * fx].forEach((at, k) => {
        ends[2 * k] = Math.min(ends[2 * k], at);
        ends[2 * k + 1] = Math.max(ends[2 * k + 1], at);
      });
    }
  }
  const expected = [ends[1] - ends[0], ends[3] - ends[2]];
  const found = (await told(page, 'Sheet size')).split('×').map(parsed);
  found.forEach((side, k) => assert.ok(Math.abs(side / expected[k] - 1) < 0.005, `${found} against ${expected}`));
  assert.match(await page.locator('#about-view .said').innerText(), /^Laid flat/);
  assert.ok(parsed(await told(page, 'RMS strain')) < 0.1);
  assert.equal(await told(page, 'Flipped triangles'), '0');
  assert.equal(await told(page, 'Overlaps'), 'none');
  assert.ok((await look(page, '#result-picture')).covered > 0.2);
    assert.match(await page.locator('#result-picture').getAttribute('aria-label') ?? '', /laid flat/);
  await view(page, 'Shaded');
  assert.equal(await page.locator('#result-picture').isVisible(), false);
});

sharedTest('what cannot be laid flat whole is laid flat in pieces, which are saved as sheets to cut out', async (page) => {
  await example(page, 'roof', { size: '100' });
  await view(page, 'Laid flat');
  assert.match(await page.locator('#about-view .said').innerText(), /In one piece it would stretch.*sheets.*cuts/);
  assert.ok(parsed(await told(page, 'Largest strain')) <= 1);
  assert.ok((await look(page, '#result-picture')).covered > 0.2);

  await page.locator('#end-sheets').click();
  await page.locator('.preview[aria-busy="false"] img').waitFor();
  const figure = (/** @type {string} */ name) => page.locator('.sheets .figures div').filter({ has: page.locator('dt', { hasText: name }) }).locator('dd');
  const [wide] = (await figure('Drawing').textContent() ?? '').split('×').map(parsed);
  const svg = await saveAs(page, 'SVG');
  assert.match(svg.bytes.toString(), /^(<\?xml[^>]*>\s*)?<svg/);
  assert.ok(Math.abs(Number(/width="([\d.]+)mm"/.exec(svg.bytes.toString())?.[1]) / wide - 1) < 0.01, 'in true size');

  // Twice as large takes about four times the paper.
  await page.locator('#end-sheets').click();
  await page.locator('.preview[aria-busy="false"] img').waitFor();
  const pages = async () => parsed(await figure('Pages').textContent() ?? '');
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
  await figure('Drawing').filter({ hasNotText: String(Math.round(wide)) }).waitFor({ state: 'attached' });
  assert.ok(await pages() > 2 * before, `${await pages()} pages instead of ${before}`);
  await page.getByLabel('Paper', { exact: true }).selectOption('a4');
  await page.locator('#save-formats').getByRole('radio', { name: /^PDF / }).check();
  await page.locator('#save-size', { hasText: /pdf, / }).waitFor();
  const saveBox = await page.locator('#save-now').boundingBox();
  assert.ok(saveBox && saveBox.y + saveBox.height <= 900, `Save is in view, at ${saveBox?.y}`);
  const pdf = await downloaded(page, () => page.locator('#save-now').click());
  assert.equal(pdf.bytes.toString('latin1', 0, 5), '%PDF-');
  // The dialog stays, and so does the size: the next format is of the same.
  assert.match(await page.locator('#save-size').innerText(), /^Saved .*pdf/);
  const again = await saveAs(page, 'SVG');
  const twice = Number(/width="([\d.]+)mm"/.exec(again.bytes.toString())?.[1]);
  await page.locator('#end-sheets').click();
  await page.locator('.preview[aria-busy="false"] img').waitFor();
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
  await page.locator('.preview[aria-busy="false"] img').waitFor();
  assert.equal(await page.locator('#cutting').isVisible(), false);
  assert.match((await saveAs(page, 'DXF')).bytes.toString(), /SECTION/);
});

sharedTest('how sheets are put together is saved as a numbered picture and as a model that moves', async (page) => {
  await example(page, 'roof', { size: '100' });
  const offered = async () => {
    await page.locator('#end-sheets').click();
    await page.locator('.preview[aria-busy="false"] img').waitFor();
    return parsed(await page.locator('.sheets-options .said').innerText());
  };
  const sheets = await offered();
  assert.ok(sheets > 1);
  const { width, height, data } = parsePng((await saveAs(page, 'PNG')).bytes);
  assert.equal(Math.max(width, height), 2000);
  // Every sheet has a colour of its own, darker where it is turned from the light.
  const counts = new Map();
  for (let i = 0; i < data.length; i += 4) {
    const most = Math.max(data[i], data[i + 1], data[i + 2], 1);
    const hue = [0, 1, 2].map((k) => Math.round((12 * data[i + k]) / most)).join();
    counts.set(hue, (counts.get(hue) ?? 0) + 1);
  }
  const large = [...counts.values()].filter((amount) => amount > 0.02 * width * height);
  assert.equal(large.length, sheets + 1, 'sheets, and white around them');

  await offered();
  const { bytes } = await saveAs(page, 'GLB');
  assert.equal(bytes.toString('latin1', 0, 4), 'glTF');
  const { animations, meshes } = JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)));
  assert.equal(animations[0].name, 'Assembly');
  assert.ok(meshes.length >= sheets, `${meshes.length} meshes of ${sheets} sheets`);
}, { drawn: true });

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
  await page.keyboard.press('ArrowRight');
  await page.locator('#stage[data-busy="false"]:has(#analysis) .bar').waitFor();
  assert.ok(await page.getByRole('radio', { name: 'Curvature K' }).isChecked());
});
