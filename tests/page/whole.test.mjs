/** Meshes solved whole, without a view. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { noisyBox, offBox, randomNumbers, SIDES } from './support/box.mjs';
import { obj } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { choose, doorTest, dropAll, figure, look, open, openFromOneSide, openSheets, openWhole, painted, reported, saveAs, settled, sharedDoorTest, sheetsDrawn, solvedWhole, typeLambda, workBy } from './support/page.mjs';
import { parsePng, png } from './support/photos.mjs';

/** @typedef {import('playwright-core').Page} Page */

const box = noisyBox(8, 0.02);
const [a, b, c] = SIDES;
const area = 2 * (a * b + b * c + c * a);

/** @param {Page} page @param {string} [way] */
async function solve(page, way = 'Whole mesh') {
  await choose(page.getByRole('radio', { name: way, exact: true }));
  await solvedWhole(page);
}

/** @param {Page} page @param {string} view */
async function view(page, view) {
  await choose(page.locator(`input[name="view"][value="${view}"]`));
  await solvedWhole(page);
}

/** @param {Page} page @param {string} name */
const told = (page, name) => figure(page, '#about-view', name).innerText();

/** The lengths of the tube, and its radius. */
const TUBE = { length: 3, radius: 1 };
/** Where the viewer looks at first. */
const OBLIQUE = [-0.5, -0.45, -0.75];

/** An open tube about the axis x, whose vertices are off by noise. @param {number} around @param {number} noise */
function noisyTube(around, noise) {
  const random = randomNumbers();
  const rings = Math.round((around * TUBE.length) / (2 * Math.PI * TUBE.radius));
  /** @type {[number, number, number][]} */
  const points = [];
  /** @type {[number, number, number][]} */
  const triangles = [];
  for (let j = 0; j <= rings; j++) {
    for (let i = 0; i < around; i++) {
      const angle = (2 * Math.PI * i) / around;
      const r = TUBE.radius + noise * random();
      points.push([(TUBE.length * j) / rings, r * Math.cos(angle), r * Math.sin(angle)]);
      if (j === rings) continue;
      const [a, b] = [j * around + i, j * around + ((i + 1) % around)];
      triangles.push([a, b, a + around], [b, b + around, a + around]);
    }
  }
  return { points, triangles };
}

/**
 * Of what is drawn in the colour of rulings: how many pixels, and at what angle to the right most of it runs, up counting up.
 * @param {Page} page
 */
async function drawnRulings(page) {
  const { width, height, data } = parsePng(await page.locator('#space-canvas').screenshot());
  /** @param {number} row @param {number} col */
  const orange = (row, col) => {
    const [r, g, b] = data.subarray(4 * (row * width + col));
    return Math.abs(r - 232) + Math.abs(g - 89) + Math.abs(b - 12) < 60;
  };
  /** @type {[number, number][]} */
  const seen = [];
  for (let row = 0; row < height; row++) for (let col = 0; col < width; col++) if (orange(row, col)) seen.push([col, -row]);
  // Seen along the lines, they are on the fewest pixels.
  let [best, angle] = [0, 0];
  for (let turned = 0; turned < Math.PI; turned += 0.005) {
    /** @type {Map<number, number>} */
    const bins = new Map();
    for (const [x, y] of seen) {
      const aside = Math.round(y * Math.cos(turned) - x * Math.sin(turned));
      bins.set(aside, (bins.get(aside) ?? 0) + 1);
    }
    const sum = [...bins.values()].reduce((total, n) => total + n * n, 0);
    if (sum > best) [best, angle] = [sum, turned];
  }
  return { pixels: seen.length, angle };
}

/** The vertices and triangles of an OBJ. @param {Buffer} bytes */
function parseObj(bytes) {
  const lines = bytes.toString().split('\n').map((line) => line.split(/\s+/));
  return {
    points: lines.filter(([kind]) => kind === 'v').map(([, ...numbers]) => numbers.slice(0, 3).map(Number)),
    triangles: lines.filter(([kind]) => kind === 'f').map(([, ...corners]) => corners.slice(0, 3).map((corner) => Number.parseInt(corner) - 1)),
  };
}

/** @param {readonly (readonly number[])[]} points */
const rms = (points) => Math.sqrt(points.reduce((sum, point) => sum + offBox(point) ** 2, 0) / points.length);

/** @param {Page} page */
async function canvasPixels(page) {
  const shot = parsePng(await page.locator('#space').screenshot());
  /** Mean difference of neighbours within a part of the picture. @param {number} from @param {number} to */
  return (from, to) => {
    let [sum, pairs] = [0, 0];
    for (let row = Math.floor(0.45 * shot.height); row < 0.6 * shot.height; row++) {
      for (let col = Math.floor(from * shot.width); col < to * shot.width; col++) {
        const at = 4 * (row * shot.width + col);
        sum += Math.abs(shot.data[at] - shot.data[at + 4]);
        pairs++;
      }
    }
    return sum / pairs;
  };
}

doorTest('a closed mesh is solved whole, shown before and after, laid flat and saved', async (page) => {
  await openFromOneSide(page, 'box.obj', obj(box));
  const hint = await page.locator('#whole-hint').innerText();
  const hidden = parsed(/([\d.]+)\s% of the surface is hidden/.exec(hint)?.[1] ?? '');
  // From above all but one side, though some of the upright ones may be seen at the rim.
  assert.ok(hidden > 50 && hidden <= 100 * (1 - (a * b) / area) + 1, hint);
  // Who cuts this side out is told so, too.
  await page.locator('#end-sheets').click();
  await page.locator('#save-dialog').getByText(hint).waitFor();
  await page.keyboard.press('Escape');
  await solve(page);
  assert.match(await page.locator('#verdict').innerText(), /^Done: the whole mesh/);
  assert.match(await page.locator('#verdict-detail').innerText(), /of \d+ steps is proven within/);
  assert.equal(await page.locator('#certificate').isVisible(), false, 'no heights');
  assert.equal(await page.locator('#gap').isVisible(), false, 'nor their settings');
  assert.ok(await page.locator('#lambda').isVisible(), 'but for λ');
  assert.equal(await told(page, 'Border'), 'none: it is closed');
  const [before, after] = (await told(page, 'Volume')).split('→').map(parsed);
  assert.ok(Math.abs(before / (a * b * c) - 1) < 0.02 && Math.abs(after / (a * b * c) - 1) < 0.03, `${before} → ${after}`);

  // Before on one side of the divider, after on the other.
  const divider = page.getByRole('slider', { name: 'Divider between input and result' }).and(page.locator('#divider'));
  await divider.press('End');
  const rough = (await canvasPixels(page))(0.35, 0.65);
  await divider.press('Home');
  const smooth = (await canvasPixels(page))(0.35, 0.65);
  assert.ok(smooth < rough / 2, `${smooth} against ${rough}`);
  const seen = parsePng(await page.locator('#space-canvas').screenshot());
  await page.locator('#space-canvas').press('ArrowLeft');
  assert.notDeepEqual(parsePng(await page.locator('#space-canvas').screenshot()).data, seen.data, 'keys turn it');

  await page.locator('#end-file').click();
  const { points, triangles } = parseObj((await saveAs(page, 'OBJ')).bytes);
  assert.equal(triangles.length, box.triangles.length);
  assert.ok(rms(points) < 0.5 * rms(box.points), `off by ${rms(points)}, before by ${rms(box.points)}`);
  for (const [format, begin] of [['PLY', 'ply'], ['GLB', 'glTF']]) {
    await page.locator('#end-file').click();
    assert.equal((await saveAs(page, format)).bytes.toString('latin1', 0, begin.length), begin);
  }

  await view(page, 'gaussian');
  const [noisy, flat] = (await told(page, 'Median')).split('→').map(parsed);
  assert.ok(flat < noisy / 10, `${noisy} → ${flat}`);
  await view(page, 'patches');
  assert.deepEqual([await told(page, 'Patches'), await told(page, 'Creases')], ['6', '12']);
  await view(page, 'sheet');
  assert.ok((await look(page, '#result-picture')).covered > 0.1);
  await page.locator('#result-picture').hover();
  const [, strain = ''] = /^strain \+?(−?[\d.]+)\s%$/.exec(await page.locator('#reading').innerText()) ?? [];
  assert.ok(Math.abs(parsed(strain)) < 3, `that of the triangle under the pointer: ${strain} %`);
  await openSheets(page);
  assert.match(await page.locator('.sheets .said').innerText(), /sheet.*fold/);
  // Metal does not come in pages.
  await workBy(page, '.preview[aria-busy="true"]', () => page.getByLabel('Pieces that fit one page').uncheck());
  /** @param {string} name */
  const ofSheets = (name) => figure(page, '.sheets', name).textContent().then(String);
  const [card, folds] = [parsed(await ofSheets('Area')), parsed(await ofSheets('To fold'))];
  await page.getByLabel('Thickness, mm').waitFor({ state: 'hidden' });
  await page.getByLabel('Material').selectOption('metal');
  await page.getByLabel('Thickness, mm').fill('2');
  await page.locator('.sheets .figures dd', { hasText: 'cm²' }).filter({ hasNotText: await ofSheets('Area') }).waitFor({ state: 'attached' });
  await sheetsDrawn(page);
  // Of metal a bend by 90° takes a strip less: the setback on both sides, less the arc of its neutral line.
  const strip = 2 * (2 + 2) - ((2 + 0.44 * 2) * Math.PI) / 2;
  const less = card - parsed(await ofSheets('Area'));
  assert.ok(Math.abs(less / (10 * folds * strip) - 1) < 0.15, `${less} cm² less, for folds of ${folds} m`);
  assert.equal(await page.getByLabel('Tabs to glue').isVisible(), false);
  assert.match((await saveAs(page, 'SVG')).bytes.toString(), /<svg[^]*<title>\s*box-developable\s*<\/title>/);

  // And back.
  await choose(page.getByRole('radio', { name: 'From one side', exact: true }));
  await page.locator('[data-whole]').waitFor({ state: 'detached' });
  await settled(page);
}, { drawn: true });

sharedDoorTest('a whole solve tells how far it is and can be done without; what is no surface is said', async (page) => {
  await openFromOneSide(page, 'box.obj', obj(noisyBox(14, 0.01)));
  const cancelled = await page.evaluate(() => {
    const radio = /** @type {HTMLInputElement} */ (document.querySelector('input[name="mesh-way"][value="whole"]'));
    radio.checked = true;
    radio.dispatchEvent(new Event('change', { bubbles: true }));
    const waiting = /** @type {HTMLElement} */ (document.querySelector('#running'));
    const seen = !waiting.hidden && /Solving/.test(waiting.innerText) && waiting.querySelector('progress') !== null;
    /** @type {HTMLButtonElement} */ (document.querySelector('#running-cancel')).click();
    return seen && waiting.hidden && document.querySelector('#verdict')?.textContent;
  });
  assert.equal(cancelled, 'Cancelled.');
  assert.ok(await page.locator('#end-file').isDisabled());
  const progress = page.waitForFunction(() => /Solving, \d+ iterations/.test(document.querySelector('#running:not([hidden]) span')?.textContent ?? ''));
  await page.getByRole('button', { name: 'Solve', exact: true }).click();
  await progress;
  await solvedWhole(page);
  assert.match(await page.locator('#verdict').innerText(), /^Done: the whole mesh/);

  // Cancelled, the next solve leaves the surface before.
  await page.evaluate(() => {
    const field = /** @type {HTMLInputElement} */ (document.querySelector('#lambda-value'));
    field.value = '1e7';
    field.dispatchEvent(new Event('change'));
    /** @type {HTMLButtonElement} */ (document.querySelector('#running-cancel')).click();
  });
  await page.locator('#verdict-detail', { hasText: 'You see the surface from before' }).waitFor();
  assert.ok(await page.locator('#end-file').isEnabled());
  await solvedWhole(page);
  // One that is begun beside its sheets brings these back, and another file closes them.
  const dialog = page.locator('#save-dialog:has([aria-busy="false"] img) #save-now:enabled');
  await page.locator('#end-sheets').click();
  await dialog.waitFor();
  await actAtOnce(page, ['#sheet-detail', '3'], ['#cutting-cancel']);
  await dialog.waitFor();
  assert.equal(await page.locator('#running').isVisible(), false);

  // Three triangles at one edge, of which no vertex is inside: without noise they stay, and there is nothing to be smoothed.
  const fan = { points: [[0, 0, 0], [1, 0, 0], [0, 1, 0.2], [0, -1, 0.1], [0, 0.2, 1]], triangles: [[0, 1, 2], [1, 0, 3], [0, 1, 4]] };
  await open(page, 'fan.obj', obj(/** @type {any} */ (fan)));
  assert.equal(await dialog.isVisible(), false);
  await page.locator('#verdict-detail', { hasText: 'no noise' }).waitFor();
  await typeLambda(page, '1e7');
  await page.locator('#verdict', { hasText: 'cannot be solved as a whole' }).waitFor();
  assert.match(await page.locator('#verdict-detail').innerText(), /inside/);
});

/** Acts before anything can be solved in between, and tells what is shown right then. @param {Page} page @param {...[selector: string, value?: string]} acts */
async function actAtOnce(page, ...acts) {
  return page.evaluate((acts) => {
    for (const [selector, value] of acts) {
      const control = /** @type {HTMLInputElement} */ (document.querySelector(selector));
      if (value === undefined) control.click();
      else {
        control.value = value;
        control.dispatchEvent(new Event('change'));
      }
    }
    const [about, report, running, stage, part] = ['#about-view', '#whole-report', '#running', '#stage', '#page'].map((one) => /** @type {HTMLElement} */ (document.querySelector(one)));
    return { about: about.textContent, isReported: !report.hidden, isRunning: !running.hidden, busy: stage.dataset.busy, phase: part.dataset.phase };
  }, acts);
}
const WHOLE = '[name="mesh-way"][value="whole"]';

doorTest('one side and the whole mesh show nothing of each other', async (page) => {
  await openFromOneSide(page, 'box.obj', obj(box));
  const caption = await page.locator('#result-caption').innerText();
  await page.locator('#divider').press('Home');
  await actAtOnce(page, [WHOLE], ['#running-cancel']);
  await page.locator('#verdict', { hasText: 'Cancelled.' }).waitFor();
  const unsolved = await look(page, '#space-canvas');
  await page.getByRole('button', { name: 'Solve', exact: true }).click();
  await solvedWhole(page);
  assert.notEqual(await page.locator('#result-caption').innerText(), caption);
  await page.locator('#divider').press('End');
  const input = await look(page, '#space-canvas');
  assert.ok(Math.abs(unsolved.roughness / input.roughness - 1) < 0.02 && Math.abs(unsolved.covered - input.covered) < 0.01, `${JSON.stringify(unsolved)}, not ${JSON.stringify(input)}`);
  await choose(page.getByRole('radio', { name: 'From one side', exact: true }));
  assert.equal(await page.locator('#result-caption').innerText(), caption);
}, { drawn: true });

sharedDoorTest('another λ ends a view that is being prepared, and a whole solve that of one side', async (page) => {
  await openWhole(page, 'box.obj', obj(box));
  const { about, isReported } = await actAtOnce(page, ['[name="view"][value="patches"]'], ['#lambda-value', '1e6']);
  assert.deepEqual([about, isReported], ['Appears when a run has ended.', false]);
  await solvedWhole(page);
  assert.equal(await page.getByRole('alert').isVisible(), false);
  assert.ok(parsed(await told(page, 'Patches')) > 0);
  assert.equal(await page.locator('#result-caption').innerText(), 'λ = 1e6');
  const { busy } = await actAtOnce(page, ['#lambda-value', '1e7'], ['#running-cancel']);
  assert.equal(busy, 'true', 'with the view of the result from before');
  await solvedWhole(page);

  await choose(page.getByRole('radio', { name: 'From one side', exact: true }));
  await settled(page);
  const { phase, isRunning } = await actAtOnce(page, ['#lambda-value', '1e5'], [WHOLE]);
  assert.deepEqual([phase, isRunning], ['idle', true], 'the progress of the whole solve');
  await choose(page.getByRole('radio', { name: 'From one side', exact: true }));
  await settled(page);
  assert.equal(parsed(await reported(page, 'λ')), 1e5);
});

doorTest('rulings of a whole mesh are drawn on its result only, along the axis of a tube', async (page) => {
  await openWhole(page, 'tube.obj', obj(noisyTube(60, 0.01)));
  const divider = page.locator('#divider');
  await divider.press('Home');
  assert.equal((await drawnRulings(page)).pixels, 0);
  await view(page, 'rulings');
  assert.ok(parsed(await told(page, 'Lines')) >= 8);
  assert.ok(parsed(await told(page, 'Median deviation from straight')) < 3);
  const longest = parsed(await told(page, 'Longest'));
  // From ring to ring, but for the ends, of whose vertices no neighbourhood tells a direction.
  assert.ok(longest > 0.8 * TUBE.length && longest < TUBE.length + 0.05, `${longest}`);
  const { pixels, angle } = await drawnRulings(page);
  assert.ok(pixels > 300, `${pixels}`);
  // The axis as it is seen from there, with y upwards.
  const towards = OBLIQUE.map((x) => -x / Math.hypot(...OBLIQUE));
  const level = Math.hypot(towards[0], towards[2]);
  const axis = [towards[2] / level, (-towards[0] * towards[1]) / level];
  const off = Math.abs(Math.sin(angle - Math.atan2(axis[1], axis[0])));
  assert.ok(off < 0.02, `${off}`);
  await divider.press('End');
  assert.equal((await drawnRulings(page)).pixels, 0, 'none on the input');
  await divider.press('Home');
  await view(page, 'gaussian');
  assert.equal((await drawnRulings(page)).pixels, 0);
}, { drawn: true });

/** Root mean square of how far places are off the tube. @param {readonly (readonly number[])[]} points */
const offTube = (points) => Math.sqrt(points.reduce((sum, [, y, z]) => sum + (Math.hypot(y, z) - TUBE.radius) ** 2, 0) / points.length);

sharedDoorTest('a whole mesh is solved with the λ that is chosen, which stands in the address, and Back undoes it', async (page) => {
  const tube = noisyTube(40, 0.02);
  await openFromOneSide(page, 'tube.obj', obj(tube));
  await page.waitForURL(/file=\d+$/);
  const saved = async () => {
    await page.locator('#end-file').click();
    return offTube(parseObj((await saveAs(page, 'OBJ')).bytes).points);
  };
  /** @param {() => Promise<unknown>} act @param {RegExp} address */
  const solvedBy = async (act, address) => {
    await workBy(page, '#stage[data-busy="true"]', act);
    await page.waitForURL(address);
  };
  const pressed = () => page.locator('#lambda-auto').getAttribute('aria-pressed');
  const field = page.getByLabel('λ as a number');

  await solvedBy(() => choose(page.getByRole('radio', { name: 'Whole mesh', exact: true })), /whole=1$/);
  const hint = await page.locator('#lambda-hint').innerText();
  // Evenly distributed, up to 0.02 to either side.
  const longest = Math.max(...[0, 1, 2].map((k) => Math.max(...tube.points.map((point) => point[k])) - Math.min(...tube.points.map((point) => point[k]))));
  const [sigma, share] = (/Noise along the normals: ([\d.]+), ([\d.]+)\s%/.exec(hint) ?? []).slice(1).map(parsed);
  assert.ok(Math.abs((share / 100) * longest / sigma - 1) < 0.02, hint);
  assert.ok(Math.abs(sigma / (0.02 / Math.sqrt(3)) - 1) < 0.2, hint);
  const auto = parsed(await told(page, 'λ'));
  assert.ok(Math.abs(Number(await field.inputValue()) / auto - 1) < 0.05);
  const smooth = await saved();
  assert.ok(smooth < 0.5 * offTube(tube.points), `${smooth}`);

  await solvedBy(async () => {
    await field.fill('1e9');
    await field.press('Tab');
  }, /lambda=1e9&whole=1$/);
  assert.equal(parsed(await told(page, 'λ')), 1e9);
  const rough = await saved();
  assert.ok(rough > 0.9 * offTube(tube.points), `it keeps its noise: ${rough}`);
  await view(page, 'rulings');
  await page.waitForURL(/lambda=1e9&whole=1&view=rulings$/);

  await solvedBy(() => page.goBack(), /whole=1$/);
  assert.deepEqual([await pressed(), parsed(await told(page, 'λ'))], ['true', auto]);
  await page.goBack();
  await page.locator('[data-whole]').waitFor({ state: 'detached' });
  assert.ok(await page.getByRole('radio', { name: 'From one side', exact: true }).isChecked());
  await solvedBy(() => page.goForward(), /whole=1$/);
  await solvedBy(() => page.goForward(), /view=rulings$/);
  await page.reload();
  await solvedWhole(page);
  await page.locator('#about-view .figures dt', { hasText: 'Longest' }).waitFor();
  assert.equal(await field.inputValue(), '1e9');

  // As seen, heights follow the λ that was chosen meanwhile.
  await solvedBy(() => typeLambda(page, '1e6'), /lambda=1e6&whole=1&view=rulings$/);
  await choose(page.getByRole('radio', { name: 'From one side', exact: true }));
  await page.waitForURL(/lambda=1e6&view=rulings$/);
  await settled(page);
  assert.equal(parsed(await reported(page, 'λ')), 1e6);
});

doorTest('where a whole mesh is under the pointer, how far it was moved, and what the view knows there', async (page) => {
  await openWhole(page, 'tube.obj', obj(noisyTube(60, 0.01)));
  await page.locator('#divider').press('Home');
  const canvas = page.locator('#space-canvas');
  const { width, height } = /** @type {{ width: number, height: number }} */ (await canvas.boundingBox());
  /** @param {number} x @param {number} y in shares of the canvas */
  const pointAt = async (x, y) => {
    await page.mouse.move(0, 0);
    await page.locator('#reading', { hasNotText: /./ }).waitFor({ state: 'attached' });
    await canvas.hover({ position: { x: x * width, y: y * height } });
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    return page.locator('#reading').innerText();
  };
  const towards = OBLIQUE.map((x) => -x / Math.hypot(...OBLIQUE));
  const level = Math.hypot(towards[0], towards[2]);
  const right = [towards[2] / level, 0, -towards[0] / level];
  const up = [0, 1, 2].map((k) => towards[(k + 1) % 3] * right[(k + 2) % 3] - towards[(k + 2) % 3] * right[(k + 1) % 3]);
  // The tube fills four fifths of the canvas, across or up.
  const [across, high] = [right, up].map(([x]) => TUBE.length * Math.abs(x) + 2 * TUBE.radius * Math.sqrt(1 - x * x));
  const pixel = Math.max(across / (0.8 * width), high / (0.8 * height));
  for (const [x, y] of [[0.5, 0.5], [0.42, 0.56]]) {
    const aside = [(x - 0.5) * width * pixel, (0.5 - y) * height * pixel];
    const line = [TUBE.length / 2, 0, 0].map((middle, k) => middle + aside[0] * right[k] + aside[1] * up[k]);
    // Where that line of sight comes to the tube first.
    const [a, b, c] = [towards[1] ** 2 + towards[2] ** 2, line[1] * towards[1] + line[2] * towards[2], line[1] ** 2 + line[2] ** 2 - TUBE.radius ** 2];
    const far = (-b + Math.sqrt(b * b - a * c)) / a;
    const expected = line.map((value, k) => value + far * towards[k]);
    const shown = await pointAt(x, y);
    const [, ...xyz] = (/^x (\S+), y (\S+), z (\S+) units · moved by (\S+)$/.exec(shown) ?? []).map(parsed);
    expected.forEach((value, k) => assert.ok(Math.abs(xyz[k] - value) < 0.02, `${shown}, and not ${expected}`));
    assert.ok(xyz[3] > 0 && xyz[3] < 0.02, shown);
  }
  assert.equal(await pointAt(0.03, 0.5), '', 'beside it');
  await view(page, 'gaussian');
  const curved = /· K (\S+)/.exec(await pointAt(0.5, 0.5));
  assert.ok(curved && Math.abs(parsed(curved[1])) < 0.1, String(curved));
  await page.locator('#divider').press('End');
  const rough = /· K (\S+)/.exec(await pointAt(0.5, 0.5));
  assert.ok(rough && Math.abs(parsed(rough[1])) > 10 * Math.abs(parsed(/** @type {RegExpExecArray} */ (curved)[1])), `${rough} against ${curved}`);
  await page.locator('#divider').press('Home');
  await view(page, 'patches');
  assert.match(await pointAt(0.5, 0.5), /moved by \S+ · patch 1$/);
  // Where it turns first, it is not where it will be.
}, { drawn: true });

sharedDoorTest('sheets of a model without a unit are in millimetres, and the headline says their size and pages', async (page) => {
  // A house of 60 × 40 × 50, as from any CAD program.
  const points = /** @type {[number, number, number][]} */ ([
    [0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0], [0, 0, 30], [60, 0, 30], [60, 40, 30], [0, 40, 30], [0, 20, 50], [60, 20, 50]]);
  const triangles = /** @type {[number, number, number][]} */ ([
    [0, 3, 2], [0, 2, 1], [0, 1, 5], [0, 5, 4], [2, 3, 7], [2, 7, 6], [1, 2, 6], [1, 6, 5], [5, 6, 9], [3, 0, 4], [3, 4, 7], [7, 4, 8],
    [4, 5, 9], [4, 9, 8], [6, 7, 8], [6, 8, 9]]);
  await openWhole(page, 'house.obj', obj({ points, triangles }));
  // The second click of a double click does not close the dialog.
  await page.locator('#end-sheets').dblclick();
  const title = page.locator('#save-title');
  await title.filter({ hasText: /: 60 mm, 1 page, \d+ joints$/ }).waitFor();
  const warning = page.locator('.sheets .guess');
  assert.equal(await warning.isVisible(), false);
  await page.getByLabel('Longer side when finished, mm').fill('600');
  await title.filter({ hasText: /: 600 mm, \d\d pages, / }).waitFor();
  assert.match(await warning.innerText(), /\d\d pages\. Is the unit of the file right\?/);
  // A small one keeps its size, a large one has none that paper can have, and no unit is said to lead to what is chosen for it.
  const unit = page.locator('#sheet-unit');
  for (const [name, factor, size, value] of /** @type {const} */ ([['small', 1 / 3, 20, 'mm'], ['large', 100, 180, 'none']])) {
    await page.keyboard.press('Escape');
    const scaled = points.map((point) => /** @type {[number, number, number]} */ (point.map((x) => factor * x)));
    await openWhole(page, `${name}.obj`, obj({ points: scaled, triangles }));
    await page.locator('#end-sheets').click();
    await title.filter({ hasText: new RegExp(`: ${size} mm, `) }).waitFor();
    assert.equal(await unit.inputValue(), value);
  }
  await unit.selectOption('inch');
  assert.equal(await page.getByLabel('Longer side when finished, mm').inputValue(), '152400');
  await page.locator('#sheet-side-wrong', { hasText: /^This must be a number from 10 to 5000/ }).waitFor();
});

doorTest('a model of card has its textures printed on its sheets, and one of metal has none', async (page) => {
  // A pyramid whose sides all show the middle of the picture.
  const text = `mtllib pyramid.mtl
usemtl card
v 0 0 0\nv 60 0 0\nv 60 60 0\nv 0 60 0\nv 30 30 50
vt 0.2 0.2\nvt 0.8 0.2\nvt 0.5 0.8
f 1/1 2/2 5/3\nf 2/1 3/2 5/3\nf 3/1 4/2 5/3\nf 4/1 1/2 5/3\nf 1/1 3/2 2/3\nf 1/1 4/2 3/3
`;
  const picture = await readFile(new URL('../data/meshes/sheet.png', import.meta.url));
  await dropAll(page, { 'pyramid.obj': Buffer.from(text), 'pyramid.mtl': Buffer.from('newmtl card\nmap_Kd sheet.png\n'), 'sheet.png': picture });
  const preview = page.locator('.sheets .preview[aria-busy="false"] img');
  const isPrinted = async () => (await saveAs(page, 'PDF')).bytes.includes('/DCTDecode');
  await page.locator('#end-sheets').click();
  await preview.waitFor();
  assert.ok(await isPrinted());
  await page.locator('#end-sheets').click();
  await preview.waitFor();
  const before = await preview.getAttribute('src');
  await page.getByLabel('Material').selectOption({ label: 'sheet metal' });
  await preview.and(page.locator(`:not([src="${before}"])`)).waitFor();
  assert.ok(!await isPrinted());
});

doorTest('a model is shown with its textures, each on its own faces', async (page) => {
  // Two sides of a pyramid face the viewer, who looks along (-0.5, -0.45, -0.75); one is red, all others are blue.
  const text = `mtllib pyramid.mtl
v 0 0 0\nv 60 0 0\nv 60 0 60\nv 0 0 60\nv 30 50 30
vt 0.2 0.2\nvt 0.8 0.2\nvt 0.5 0.8
usemtl red\nf 4/1 3/2 5/3
usemtl blue\nf 3/1 2/2 5/3\nf 2/1 1/2 5/3\nf 1/1 4/2 5/3\nf 1/1 2/2 3/3\nf 1/1 3/2 4/3
`;
  /** @param {number[]} colour */
  const filled = (colour) => png({ width: 8, height: 8, data: Uint8ClampedArray.from({ length: 256 }, (_, i) => [...colour, 255][i % 4]) });
  await dropAll(page, {
    'pyramid.obj': Buffer.from(text), 'pyramid.mtl': Buffer.from('newmtl red\nmap_Kd red.png\nnewmtl blue\nmap_Kd blue.png\n'),
    'red.png': filled([255, 0, 0]), 'blue.png': filled([0, 0, 255]),
  });
  await solvedWhole(page);
  /** Places of the middle of the pixels in a colour, as shares of the picture's width. @param {0 | 2} channel */
  const middleOf = async (channel) => {
    await painted(page);
    const { width, data } = parsePng(await page.locator('#space-canvas').screenshot());
    const found = [];
    for (let i = 0; i < data.length; i += 4) if (data[i + channel] > 2 * data[i + 2 - channel] + 20 && data[i + channel] > 2 * data[i + 1] + 20) found.push(((i / 4) % width) / width);
    return found.length > 0.01 * width * width ? found.reduce((sum, x) => sum + x, 0) / found.length : NaN;
  };
  assert.ok(await page.getByRole('radio', { name: 'Photo' }).isChecked(), 'it comes first');
  const [red, blue] = [await middleOf(0), await middleOf(2)];
  assert.ok(red < 0.5 && blue > 0.5, `red at ${red}, blue at ${blue}`);
  await view(page, 'shaded');
  assert.ok(Number.isNaN(await middleOf(0)) && Number.isNaN(await middleOf(2)));
}, { drawn: true });

doorTest('what is found in a model without noise is shown on all of it, with its creases', async (page) => {
  await openWhole(page, 'box.obj', obj(noisyBox(3, 0)));
  await view(page, 'patches');
  assert.equal(await page.locator('#divider').isVisible(), false);
  await painted(page);
  const { width, height, data } = parsePng(await page.locator('#space-canvas').screenshot());
  const [coloured, dark] = [[0, 0], [0, 0]];
  for (let i = 0; i < width * height; i++) {
    const channels = [...data.subarray(4 * i, 4 * i + 3)];
    const half = i % width < width / 2 ? 0 : 1;
    if (Math.max(...channels) - Math.min(...channels) > 40) coloured[half]++;
    if (Math.max(...channels) < 70) dark[half]++;
  }
  assert.ok(Math.min(...coloured) > 0.02 * width * height && Math.min(...dark) > 100, `${coloured}, ${dark}`);
}, { drawn: true });
