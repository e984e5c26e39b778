/** Edges of flat faces that are cut or folded by a click in the drawing. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { dispose, pattern } from '../../pkg/index.js';
import { sheetsInWords } from '../../www/pattern.js';
import { meshFitSummary } from '../../www/views/mesh-fit.js';
import { rulings } from '../../www/views/rulings.js';
import { edgeAt, parsePairs, togglePair } from '../../www/sheet-edges.js';
import { cuboid } from './support/box.mjs';
import { obj } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { doorTest, figure, openSheets, openWhole, pageTest, solvedWhole, workBy } from './support/page.mjs';

/** A box of 60 × 40 × 20: its faces by number, the largest first, come in opposite pairs. */
const { points, triangles } = cuboid([60, 40, 20]);
const box = { positions: Float64Array.from(points.flat()), triangles: Uint32Array.from(triangles.flat()) };
const opposite = ['1-2', '3-4', '5-6'];

/** @param {[number, number][]} line @returns {[number, number]} */
const middleOf = (line) => [(line[0][0] + line[line.length - 1][0]) / 2, (line[0][1] + line[line.length - 1][1]) / 2];

/** The pairs of pieces at all folds and all cuts of a drawing. @param {Awaited<ReturnType<typeof pattern>>} drawing */
function edgesOf(drawing) {
  const places = drawing.sheets.flatMap(({ folds, labels }) => [...folds.map(({ points: line }) => middleOf(line)), ...labels.filter(({ kind }) => kind === 'seam').map(({ place }) => place)]);
  const edges = places.map((place) => edgeAt(drawing, place));
  /** @param {boolean} isFold */
  const pairs = (isFold) => [...new Set(edges.filter((edge) => edge?.isFold === isFold).map((edge) => String(edge?.pair.join('-'))))].sort();
  return { folds: pairs(true), cuts: pairs(false) };
}

test('each edge of a box is found in its drawing, as a fold or a cut, and changes places with another when it is cut', async () => {
  const drawing = await pattern(box, { size: 60 });
  const { folds, cuts } = edgesOf(drawing);
  assert.deepEqual([folds.length, cuts.length], [5, 7]);
  // A box has twelve edges, none of them between opposite faces.
  assert.equal(new Set([...folds, ...cuts]).size, 12);
  assert.ok([...folds, ...cuts].every((pair) => !opposite.includes(pair)), `${folds} | ${cuts}`);
  const [pair] = parsePairs(folds[0]) ?? [];
  const cut = edgesOf(await pattern(box, { size: 60, cut: [pair] }));
  assert.ok(cut.cuts.includes(folds[0]) && cut.folds.length === 5, `${cut.folds} | ${cut.cuts}`);
  assert.equal(edgeAt(drawing, [-500, -500]), null);
  dispose();
});

test('pairs are read from a text, and put into it and out again', () => {
  assert.deepEqual(parsePairs(' 7 - 1, 2–3;'), [[1, 7], [2, 3]]);
  assert.deepEqual([parsePairs(''), parsePairs('1-7, x'), parsePairs('1')], [[], null, null]);
  assert.equal(togglePair('1-7', [2, 3]), '1-7, 2-3');
  assert.equal(togglePair('1-7, 2-3', [1, 7]), '2-3');
});

test('what of a surface is on no sheet is said, and which cuts have no tab or letter', () => {
  const summary = { sheets: 2, seams: 3, folds: 0, slits: 0, strain: 0, mismatch: 0.02, untabbed: 0, unlettered: 0 };
  const said = (/** @type {object} */ more) => sheetsInWords(/** @type {any} */ ({ summary: { ...summary, ...more } }));
  assert.equal(said({}), '2 sheets, to be joined along 3 cuts.');
  assert.equal(said({ unlettered: 2 }), '2 sheets, to be joined along 3 cuts. 2 cuts have no room for a letter.');
  assert.equal(said({ mismatch: 0.031 }).replaceAll('\u00a0', ' '), '2 sheets, to be joined along 3 cuts. Joints will not fit: the two sides of one differ in length by 3.1 %.');
  assert.match(said({ missing: { vertices: 4, area: 1200, steps: 1, stepArea: 300 }, untabbed: 1 }), /15 cm² of the surface.* are on no sheet\. One cut has no room for a tab\.$/);
});

test('where there are no rulings, it is said why', () => {
  assert.deepEqual(rulings([], 'mm'), { said: 'No rulings are drawn: in a flat face every straight line is one.' });
});

test('a shape that a solve has lost is called lost', () => {
  const report = { passes: [], flipped: [0, 0], entangled: [], repairs: { turned: 0, degenerate: 0, repeated: 0, branched: 0 } };
  const said = (/** @type {number} */ area, changed = {}) => meshFitSummary(/** @type {any} */ ({ report: { ...report, ...changed, area: [200, area] } })).replaceAll('\u00a0', ' ');
  assert.deepEqual([said(190), ...['gap', 'noNoise'].map((stopReason) => /folded over/.test(said(190, { flipped: [1, 1], stopReason })))], ['', true, false]);
  assert.equal(said(6), 'The shape is lost: 3 % of its area is left. Take a larger λ.');
});

pageTest('less detail makes simpler pieces while their sheets are shown', async (page) => {
  const [side, written] = [page.getByLabel('Longer side when finished, mm'), page.locator('#save-size')];
  await page.locator('#end-sheets').click();
  await written.filter({ hasText: /-sheets\.pdf, / }).waitFor();
  await side.fill('150');
  await page.locator('#save-title', { hasText: '150 mm' }).waitFor();
  await page.getByLabel('Pieces: simpler').press('Home');
  await written.filter({ hasText: /-1e3-sheets\.pdf, / }).waitFor();
  assert.equal(await side.inputValue(), '150');
  assert.match(await page.locator('#result-caption').innerText(), /1e3/);
  // However much is said, it has room.
  const hidden = await page.locator('.sheets-options .said').evaluate((said) => {
    said.textContent = 'Many words. '.repeat(60);
    return said.scrollHeight - said.clientHeight;
  });
  assert.equal(hidden, 0);
});

doorTest('a fold that is clicked in the drawing is cut', async (page) => {
  await openWhole(page, 'box.obj', obj({ points, triangles }));
  const image = await openSheets(page);
  const [toCut, toJoin] = [page.getByLabel('Cut between pieces'), page.getByLabel('Fold between pieces')];
  const address = await image.getAttribute('src');
  const drawing = await pattern(box, { size: 60, tabs: 6, stock: 'letter' });
  dispose();
  const shown = await image.boundingBox();
  assert.ok(shown);
  const [x, y] = middleOf(drawing.sheets[0].folds[0].points);
  /** @param {{ width: number, height: number }} drawing @param {[number, number]} place @returns {[number, number]} */
  const onScreen = ({ width, height }, [x, y]) => [shown.x + (x / width) * shown.width, shown.y + (1 - y / height) * shown.height];
  const [note, mark] = [page.locator('.edges [role="status"]'), page.locator('.preview path')];
  await page.mouse.move(...onScreen(drawing, [x, y]));
  await note.filter({ hasText: /^Fold between pieces \d and \d: click to cut it\.$/ }).waitFor();
  assert.match(await mark.getAttribute('d') ?? '', /^M/, 'it is marked');
  await page.mouse.click(...onScreen(drawing, [x, y]));
  await page.locator(`.preview[aria-busy="false"] img:not([src="${address}"])`).waitFor();
  const [pair] = parsePairs(await toCut.inputValue()) ?? [];
  assert.deepEqual([pair, await toJoin.inputValue()], [edgeAt(drawing, [x, y])?.pair, '']);
  assert.equal(await note.innerText(), `Pieces ${pair?.join(' and ')} are cut apart now.`);
  // Undone and done again.
  for (const [act, wanted] of /** @type {const} */ ([[() => page.locator('.edges').getByRole('button', { name: 'Undo' }).click(), ''], [() => page.locator('#save-title').press('Control+Shift+z'), String(pair?.join('-'))]])) {
    await workBy(page, '.preview[aria-busy="true"]', act);
    assert.equal(await toCut.inputValue(), wanted);
  }
  // Three faces about a corner of the box cannot all be folded to each other.
  await page.locator('.edges summary').click();
  await workBy(page, '.preview[aria-busy="true"]', () => toCut.fill(''));
  await workBy(page, '.preview[aria-busy="true"]', () => toJoin.fill('1-3, 1-5'));
  const joined = await pattern(box, { size: 60, tabs: 6, stock: 'letter', join: [[1, 3], [1, 5]] });
  dispose();
  const cut = joined.sheets.flatMap(({ labels }) => labels).find(({ place }) => String(edgeAt(joined, place)?.pair) === '3,5' && !edgeAt(joined, place)?.isFold);
  assert.ok(cut);
  Object.assign(shown, await image.boundingBox());
  await page.mouse.click(...onScreen(joined, cut.place));
  await note.filter({ hasText: /^Pieces 3 and 5 stay cut apart: / }).waitFor();
  assert.equal(await toJoin.inputValue(), '1-3, 1-5');
  await workBy(page, '.preview[aria-busy="true"]', () => toJoin.fill('1-3, 1-5, 3-5'));
  await page.locator('#sheet-join-wrong', { hasText: /^With all these folds/ }).waitFor();
  await toJoin.fill('');
  await page.locator('#save-now:enabled').waitFor();
  // Of a drawing of 5 m, too, one sees the lines.
  await workBy(page, '.preview[aria-busy="true"]', () => page.getByLabel('Longer side when finished').fill('2000'));
  const inked = await image.evaluate((/** @type {HTMLImageElement} */ picture) => {
    const canvas = Object.assign(document.createElement('canvas'), { width: picture.clientWidth, height: picture.clientHeight });
    const context = canvas.getContext('2d');
    context?.drawImage(picture, 0, 0, canvas.width, canvas.height);
    const data = context?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
    return Array.from({ length: canvas.width * canvas.height }, (_, i) => data[4 * i + 3] > 128 && data[4 * i] + data[4 * i + 1] + data[4 * i + 2] < 600).filter(Boolean).length;
  });
  assert.ok(inked > shown.width, `${inked} pixels of lines`);
  // A file that is still being written cannot be saved either.
  await page.locator('#save-now:enabled').waitFor();
  await toCut.fill('1-');
  await toCut.press('Tab');
  assert.equal(await toCut.getAttribute('aria-invalid'), 'true');
  // What was cut before is not saved in its place, and what is wrong stands at the field alone.
  await page.locator('#save-now:disabled').waitFor();
  assert.equal(await page.locator('#save-dialog footer').innerText(), 'Save');
  await page.locator('#save-title', { hasText: /^Cut-out sheets$/ }).waitFor();
});

doorTest('a solid of sheet metal is cut as the blank that it is bent from', async (page) => {
  // An angle of two legs, 2 mm thick, with an inner radius of 3 mm: its section from the outside in, and 50 mm of it.
  const [thickness, inner, width, legs, steps] = [2, 3, 50, [40, 30], 12];
  const arc = (/** @type {number} */ radius) => Array.from({ length: steps + 1 }, (_, i) => -Math.PI / 2 * (1 + i / steps)).map((angle) => [thickness + inner + radius * Math.cos(angle), thickness + inner + radius * Math.sin(angle)]);
  const outside = [[legs[0], 0], ...arc(inner + thickness), [0, legs[1]]];
  const section = [...outside, ...[[legs[0], thickness], ...arc(inner), [thickness, legs[1]]].reverse()];
  const [count, half] = [section.length, outside.length];
  const triangles = section.flatMap((_, i) => {
    const j = (i + 1) % count;
    return /** @type {[number, number, number][]} */ ([[i, j, count + j], [i, count + j, count + i]]);
  });
  for (let i = 0; i + 1 < half; i++) {
    const [a, b, c, d] = [i, i + 1, count - 2 - i, count - 1 - i];
    triangles.push([a, d, c], [a, c, b], [count + a, count + c, count + d], [count + a, count + b, count + c]);
  }
  const points = [0, width].flatMap((y) => section.map(([x, z]) => /** @type {[number, number, number]} */ ([x, y, z])));
  await openWhole(page, 'angle.obj', obj({ points, triangles }));
  await openSheets(page);
  await page.getByLabel('Material').selectOption('metal');
  await page.getByText('2 mm thick: this is the blank').waitFor();
  await page.locator('.sheets .said', { hasText: /^One sheet, with one fold\.$/ }).waitFor();
  assert.equal(await page.getByLabel('Thickness, mm').isVisible(), false);
  const area = width * (legs[0] + legs[1] - 2 * (thickness + inner) + (Math.PI / 2) * (inner + 0.44 * thickness));
  const told = await figure(page, '.sheets', 'Area').textContent();
  assert.ok(Math.abs(100 * parsed(String(told)) / area - 1) < 0.005, `${told} for ${area} mm²`);

  // While it is cut again, too, its thickness is its own.
  const field = page.locator('.field', { has: page.locator('#sheet-thickness') });
  const shown = await field.evaluateHandle((node) => {
    const shown = { times: 0 };
    new MutationObserver(() => (shown.times += Number(!(/** @type {HTMLElement} */ (node).hidden)))).observe(node, { attributes: true });
    return shown;
  });
  await workBy(page, '.preview[aria-busy="true"]', () => page.getByLabel('K-factor').fill('0.4'));
  assert.equal((await shown.jsonValue()).times, 0);
});

doorTest('a sheet that takes several pages is made to fit one', async (page) => {
  await openWhole(page, 'box.obj', obj({ points, triangles }));
  await page.locator('#end-sheets').click();
  const [title, fit] = [page.locator('#save-title'), page.getByRole('button', { name: /^Each sheet on one page: / })];
  await title.filter({ hasText: /60 mm, 1 page,/ }).waitFor();
  assert.equal(await fit.isVisible(), false);
  await page.getByLabel('Pieces that fit one page').uncheck();
  await page.getByLabel('Longer side when finished').fill('300');
  await fit.waitFor();
  assert.match(await page.locator('.sheets .said').innerText(), /^One sheet/);
  await page.getByLabel('Pieces that fit one page').check();
  await page.locator('.sheets .said', { hasText: /^6 sheets, / }).waitFor();
  await page.getByLabel('Longer side when finished').fill('150');
  await page.locator('.sheets .said', { hasText: /^\d sheets that each fit a page, / }).waitFor();
  await page.getByLabel('Longer side when finished').fill('300');
  await page.getByLabel('Pieces that fit one page').uncheck();
  await page.locator('.sheets .said', { hasText: /^One sheet/ }).waitFor();
  await fit.click();
  await title.filter({ hasText: /, 1 page,/ }).filter({ hasNotText: '300 mm' }).waitFor();
  await fit.waitFor({ state: 'hidden' });
  const side = Number(await page.getByLabel('Longer side when finished').inputValue());
  assert.ok(side > 60 && side < 150, `${side}`);
});

doorTest('flat faces stand for a shape, as many as are wanted, and can be cut apart', async (page) => {
  const [rings, sectors] = [8, 12];
  const turn = (/** @type {number} */ k, /** @type {number} */ n) => [Math.cos((2 * Math.PI * k) / n), Math.sin((2 * Math.PI * k) / n)];
  const points = Array.from({ length: rings * sectors }, (_, i) => {
    const [[x, y], [far, up]] = [turn(i % sectors, sectors), turn(Math.floor(i / sectors), rings)];
    return /** @type {const} */ ([x * (40 + 15 * far), y * (40 + 15 * far), 15 * up]);
  });
  const vertex = (/** @type {number} */ ring, /** @type {number} */ sector) => (ring % rings) * sectors + (sector % sectors);
  const triangles = points.flatMap((_, i) => {
    const [ring, sector] = [Math.floor(i / sectors), i % sectors];
    const [a, b, c, d] = [vertex(ring, sector), vertex(ring, sector + 1), vertex(ring + 1, sector + 1), vertex(ring + 1, sector)];
    return /** @type {const} */ ([[a, b, c], [a, c, d]]);
  });
  await openWhole(page, 'ring.obj', obj({ points, triangles }));
  await openSheets(page);
  assert.doesNotMatch(await page.locator('.sheets .said').innerText(), /flat faces/);
  await page.getByLabel('Flat faces at most').fill('60');
  await page.locator('.sheets .said', { hasText: /Built of 60 flat faces, \d.* mm from the shape\.$/ }).waitFor();
  assert.ok(await page.locator('.sheets .edges').isVisible());
});

doorTest('the size and the cuts of a model stay with it, and what no piece has is said at the field', async (page) => {
  const [side, toCut, wrong] = [page.getByLabel('Longer side when finished'), page.getByLabel('Cut between pieces'), page.locator('#sheet-cut-wrong')];
  /** @param {[string, string]} wanted */
  const shows = async (...wanted) => {
    await openSheets(page);
    assert.deepEqual([await side.inputValue(), await toCut.inputValue()], wanted);
    assert.equal(await page.evaluate(() => document.activeElement?.id), 'save-title', 'the dialog is read from its heading');
  };
  await openWhole(page, 'box.obj', obj({ points, triangles }));
  await shows('60', '');
  await page.locator('.edges summary').click();
  for (const [pair, words] of [['1-99', 'There is no piece 99.'], ['1-1', 'Piece 1 has no edge with itself.'], ['1-2', 'Pieces 1 and 2 have no edge in common.']]) {
    await toCut.fill(pair);
    await wrong.filter({ hasText: words }).waitFor();
    assert.equal(await page.locator('.sheets .said').innerText(), '');
  }
  await toCut.fill('1-3');
  await side.fill('90');
  await page.locator('#save-title', { hasText: '90 mm' }).waitFor();
  await page.getByRole('button', { name: 'Close' }).click();
  await shows('90', '1-3');
  await page.waitForURL(/file=\d/);
  await page.reload();
  await solvedWhole(page);
  await shows('90', '1-3');
  await page.getByRole('button', { name: 'Close' }).click();
  await openWhole(page, 'plate.obj', obj({ points: points.slice(0, 4), triangles: triangles.slice(0, 2) }));
  await shows('60', '');
  // Of a plate nothing is folded or joined.
  assert.equal(await page.locator('#save-title').innerText(), 'Cut-out sheets: 60 mm, 1 page');
  assert.equal(await page.locator('.sheets').getByText(/letter|fold/).filter({ visible: true }).count(), 0);
});

doorTest('the picture of the sheets stays in view beside the fields, above the formats and Save, and can be enlarged', async (page) => {
  await openWhole(page, 'box.obj', obj({ points, triangles }));
  const image = await openSheets(page);
  await page.locator('#save-now:enabled').waitFor();
  await page.locator('.sheets-options').evaluate((box) => (box.scrollTop = box.scrollHeight));
  const [picture, kerf, format, save] = await Promise.all([image, page.getByLabel('Kerf'), page.getByRole('radio', { name: /^DXF / }), page.locator('#save-now')].map((one) => one.boundingBox()));
  assert.ok(picture && kerf && format && save);
  assert.ok(picture.y > 0 && kerf.y > 0 && picture.y + picture.height <= format.y && kerf.y < format.y && format.y < save.y && save.y < format.y + 110 && save.y < 800, JSON.stringify({ picture, kerf, format, save }));
  await page.locator('#writing').evaluate((/** @type {HTMLElement} */ bar) => (bar.hidden = false));
  assert.deepEqual([await image.boundingBox(), await page.getByRole('radio', { name: /^DXF / }).boundingBox()], [picture, format], 'the bar of writing moves nothing');
  await page.locator('#writing').evaluate((/** @type {HTMLElement} */ bar) => (bar.hidden = true));
  await workBy(page, '.preview[aria-busy="true"]', () => page.getByRole('button', { name: 'Enlarge the picture' }).click());
  assert.ok(Math.abs(((await image.boundingBox())?.width ?? 0) / picture.width - 3) < 0.2);
}, { size: { width: 1280, height: 800 } });

doorTest('what is chosen is there on the next visit, and a kerf makes sheets larger by its width', async (page) => {
  await openWhole(page, 'box.obj', obj({ points, triangles }));
  const image = page.locator('.preview[aria-busy="false"] img');
  const drawn = async () => {
    const told = await figure(page, '.sheets', 'Drawing').textContent();
    return String(told).split('×').map(parsed);
  };
  await page.locator('#end-sheets').click();
  await image.waitFor();
  await workBy(page, '.preview[aria-busy="true"]', () => page.getByLabel('Tabs to glue').uncheck());
  const before = await drawn();
  await workBy(page, '.preview[aria-busy="true"]', () => page.getByLabel('Kerf of a laser or saw, mm').fill('2'));
  const after = await drawn();
  // Half of it on each side.
  after.forEach((side, k) => assert.ok(Math.abs(side - before[k] - 2) < 0.02 * side, `${before} → ${after}`));
  await page.getByLabel('Paper', { exact: true }).selectOption('letter');
  await page.getByRole('radio', { name: /^SVG / }).check();
  await page.locator('#save-now:enabled').waitFor();
  await page.waitForURL(/file=\d/);
  await page.reload();
  await solvedWhole(page);
  await page.locator('#end-sheets').click();
  await image.waitFor();
  assert.deepEqual([await page.getByLabel('Kerf of a laser or saw, mm').inputValue(), await page.getByLabel('Paper', { exact: true }).inputValue(), await page.getByLabel('Tabs to glue').isChecked()], ['2', 'letter', false]);
  assert.ok(await page.getByRole('radio', { name: /^SVG / }).isChecked());
  assert.deepEqual(await drawn(), after);
});
