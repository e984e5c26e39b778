/** A photo of a curled page alone: found, dragged, held, made flat and saved. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { unzipSync } from 'fflate';
import { pageCautions, pageErrors } from '../../www/page/messages.js';
import { flattenWholePhoto } from '../../www/page/flatten.js';
import { pictureFiles } from '../../www/page/paper.js';
import { init, load, writeBook } from '../../pkg/direct.js';
import { readPdf, readPdfPicture } from '../js/support/drawings.mjs';
import { parsed } from './support/numbers.mjs';
import { choose, doorTest, drop, dropAll, ended, enterPages, figure, look, painted, saveAs, sharedDoorTest } from './support/page.mjs';
import { camera, dottedPhoto, levelPhoto, LEVEL_WIDTH, misplaced, parsePng, png, seen } from './support/photos.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('./support/photos.mjs').Place} Place */

const photo = dottedPhoto();
/** So like its ground that its outline is doubtful. */
const pale = dottedPhoto({ page: 225, ground: 195 });
/** A small picture of one grey, in which soon no page is found. */
const blank = png({ width: 64, height: 48, data: new Uint8Array(4 * 64 * 48).fill(128) });
/** Dots alone, without any page to be seen. */
const hidden = dottedPhoto({ page: 200, ground: 200 });

/** @param {Page} page */
async function flattened(page) {
  await page.locator('#flat-view[aria-busy="false"]').waitFor({ state: 'attached' });
  await painted(page);
}

/** @param {Page} page @param {string} name @param {Buffer} bytes */
async function openPhoto(page, name, bytes) {
  if (!(await page.locator('#page-side').isVisible())) {
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.locator('[data-open="page"]').click()]);
    await chooser.setFiles({ name, mimeType: 'image/png', buffer: bytes });
  } else await drop(page, name, bytes);
  await page.locator('#page-caption', { hasText: name.replace(/\.\w+$/, '') }).waitFor();
  await flattened(page);
  await page.locator('#page-side details').evaluateAll((all) => all.forEach((details) => details.setAttribute('open', '')));
}

/** @param {Page} page @param {string} name */
const handle = (page, name) => page.getByRole('button', { name: new RegExp(`^${name}`) });

/** Where a handle is, in pixels of the photo. @param {Page} page @param {string} name @returns {Promise<Place>} */
async function placeOf(page, name) {
  const [, x, y] = /at (-?\d+), (-?\d+)$/.exec(await handle(page, name).getAttribute('aria-label') ?? '') ?? [];
  return [Number(x), Number(y)];
}

/** From pixels of a photo to those of the page. @param {Page} page @param {Place} place @param {number} [wide] pixels of the photo from left to right @returns {Promise<Place>} */
async function onPage(page, [x, y], wide = camera.width) {
  const box = await page.locator('#page-photo').boundingBox();
  assert.ok(box);
  return [box.x + ((x + 0.5) / wide) * box.width, box.y + ((y + 0.5) / wide) * box.width];
}

/** @param {Page} page @param {string} name @param {Place} to */
async function drag(page, name, to) {
  await page.locator('#page-photo').scrollIntoViewIfNeeded();
  await handle(page, name).hover();
  await page.mouse.down();
  await page.mouse.move(...await onPage(page, to), { steps: 4 });
  await page.mouse.up();
}

/** @param {Page} page */
async function flatPng(page) {
  const { name, bytes } = await savedPage(page, 'PNG');
  return { name, ...parsePng(bytes) };
}

/** @param {Page} page @param {string} format */
async function savedPage(page, format) {
  await page.getByRole('button', { name: 'Save the flat page…' }).click();
  return saveAs(page, format);
}

/** @param {Page} page @param {string} name */
const told = async (page, name) => String(await figure(page, '#flat-about', name).textContent()).trim();

/** Places of a traced edge: 0 the upper one, 1 the lower one. @param {Page} page @param {number} edge @param {number[]} shares of its length */
function edgePlaces(page, edge, shares) {
  return page.locator('#page-photo path.edge').nth(edge).evaluate((path, shares) => shares.map((share) => {
    const line = /** @type {SVGPathElement} */ (path);
    const { x, y } = line.getPointAtLength(share * line.getTotalLength());
    return [x, y];
  }), shares);
}

const CORNERS = /** @type {const} */ ([['Upper left corner', 0, 0], ['Upper right corner', 1, 0], ['Lower left corner', 0, 1], ['Lower right corner', 1, 1]]);

sharedDoorTest('a page on a dark ground is found, and its dots come out evenly', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  // Before and after, by a divider over the flat page.
  const flatPicture = (await look(page, '#flat-canvas')).hash;
  const divider = page.getByRole('slider', { name: 'Divider between photo and flat page' });
  // At the edge of the picture, which cuts off what lies outside, its handle is whole.
  const handle = await divider.evaluate((one) => one.getBoundingClientRect().left + parseFloat(getComputedStyle(one, '::after').left) - (one.parentElement?.getBoundingClientRect().left ?? NaN));
  assert.ok(handle >= 0, `${handle} pixels`);
  await divider.press('End');
  assert.notEqual((await look(page, '#flat-canvas')).hash, flatPicture);
  await divider.press('Home');
  assert.equal((await look(page, '#flat-canvas')).hash, flatPicture);
  for (const [name, s, t] of CORNERS) {
    const [[x, y], [u, v]] = [await placeOf(page, name), seen(s, t)];
    assert.ok(Math.hypot(x - u, y - v) < 2.5, `${name} at ${x}, ${y}, not at ${u}, ${v}`);
  }
  assert.match(await page.locator('#flat-verdict').innerText(), /^Made flat/);
  assert.ok((await look(page, '#flat-canvas')).covered > 0.2);
  const flat = await flatPng(page);
  assert.equal(flat.name, 'letter-flat.png');
  assert.ok(Math.abs(flat.height / flat.width / (297 / 210) - 1) < 0.016, `${flat.width} × ${flat.height}`);
  const error = misplaced(flat);
  assert.ok(error < 0.003, `dots are off by ${100 * error} % of the width`);
  // What is claimed is about what it is.
  const [likely, bound] = [parsed(await told(page, 'Likely error')), parsed(await told(page, '95 % limit'))];
  assert.ok(likely < bound && bound < 1 && 100 * error < 2 * bound, `${likely}, ${bound}, ${100 * error}`);

  const jpeg = await savedPage(page, 'JPEG');
  assert.equal(jpeg.name, 'letter-flat.jpg');
  assert.deepEqual([...jpeg.bytes.subarray(0, 3)], [0xff, 0xd8, 0xff]);
});

sharedDoorTest('corners are dragged where the outline is doubtful, and edges are traced between them', async (page) => {
  await openPhoto(page, 'pale.png', pale);
  assert.match(await page.locator('#flat-verdict').innerText(), /check|Not reliable/);
  for (const [name, s, t] of CORNERS) {
    const [x, y] = seen(s, t);
    await drag(page, name, [x + 3, y - 2]);
  }
  await flattened(page);
  // The library finds the corners nearby, where the edges between them begin and end.
  for (const [edge, t] of [[0, 0], [1, 1]]) {
    const ends = await edgePlaces(page, edge, [0, 1]);
    [0, 1].forEach((s, k) => {
      const [[x, y], [u, v]] = [ends[k], seen(s, t)];
      assert.ok(Math.hypot(x - u, y - v) < 2.5, `${x}, ${y}, not ${u}, ${v}`);
    });
  }
});

sharedDoorTest('a page that is not found has no flat page, no figure and no file until its corners are placed', async (page) => {
  await openPhoto(page, 'dots.png', hidden);
  const [verdict, detail] = [page.locator('#flat-verdict'), page.locator('#flat-detail')];
  const save = page.locator('#page-save');
  assert.equal(await verdict.innerText(), 'I found no page in this photo. If it shows one, drag the four corners onto it.');
  assert.doesNotMatch(await detail.innerText(), /%/);
  assert.equal(await save.isVisible(), false);
  assert.ok(await save.isDisabled());
  assert.equal(await page.locator('#flat-facts').isVisible(), false);
  assert.deepEqual(await placeOf(page, 'Upper left corner'), [120, 90], 'a quadrilateral to start from');
  const before = await page.locator('#page-photo').boundingBox();
  // A rectangle, which is soon made flat.
  for (const [i, [name, s, t]] of CORNERS.entries()) {
    await drag(page, name, [240 + 320 * s, 60 + 452 * t]);
    if (i === 3) break;
    assert.ok(await save.isDisabled());
    assert.match(await detail.innerText(), /^The flat page appears when the (other \d|last one)/);
    assert.deepEqual(await page.locator('#page-photo').boundingBox(), before, 'nothing moves under the hand');
  }
  await flattened(page);
  assert.ok(await save.isEnabled());
  // Taken back, it is not found again.
  await page.keyboard.press('Control+z');
  await page.locator('#page-side[data-state="unfound"]').waitFor();
  assert.ok(await save.isDisabled());
  // A flatbed's scan shows nothing beside the page.
  await page.getByRole('button', { name: 'Take the whole photo' }).click();
  await flattened(page);
  assert.deepEqual(await placeOf(page, 'Lower right corner'), [799, 599]);
  assert.ok(await save.isEnabled());
  await page.keyboard.press('Control+z');
  await page.locator('#page-side[data-state="unfound"]').waitFor();
});

doorTest('photos that are opened together become one PDF, each with its own outline', async (page) => {
  await enterPages(page);
  await dropAll(page, { 'one.png': levelPhoto, 'two.png': levelPhoto, 'none.png': blank });
  const numbers = page.locator('#book').getByRole('button', { name: /^Photo \d/ });
  await page.locator('#page-caption', { hasText: 'one' }).waitFor();
  await flattened(page);
  assert.equal(await numbers.count(), 3);
  await drag(page, 'Upper left corner', [252, 66]);
  await flattened(page);
  const placed = await placeOf(page, 'Upper left corner');
  // The third one is not found, and cannot be written until it is put right or taken out.
  await numbers.nth(2).click();
  await page.locator('#page-side[data-state="unfound"]').waitFor();
  // The others are saved from there, too.
  await page.getByRole('button', { name: 'Save the flat page…' }).click();
  assert.match(await page.locator('#save-formats').innerText(), /^PDF of all 3 photos that show a page\s+ZIP [^\n]*$/);
  await page.locator('#save-size', { hasText: /one-pages\.pdf, .*\. Without “none\.png”: no page was found there/ }).waitFor();
  await page.locator('#save-dialog').evaluate((dialog) => /** @type {HTMLDialogElement} */ (dialog).close());
  await numbers.nth(1).click();
  await page.locator('#page-caption', { hasText: 'two' }).waitFor();
  await flattened(page);
  assert.equal(await numbers.nth(1).getAttribute('aria-pressed'), 'true');
  assert.notDeepEqual(await placeOf(page, 'Upper left corner'), placed);
  assert.match(await numbers.nth(2).getAttribute('aria-label') ?? '', /not in the PDF/);
  await numbers.nth(2).click();
  await page.locator('#page-side[data-state="unfound"]').waitFor();
  // Removed, brought back, and moved to the front.
  await page.getByRole('button', { name: 'Remove photo' }).click();
  await page.locator('#page-caption', { hasText: 'two' }).waitFor();
  assert.equal(await numbers.count(), 2);
  await page.getByRole('alert').getByRole('button', { name: 'Undo' }).click();
  await page.locator('#page-caption', { hasText: 'none' }).waitFor();
  assert.equal(await numbers.count(), 3);
  await page.getByRole('button', { name: 'Earlier' }).click();
  const second = async () => String(await numbers.nth(1).getAttribute('aria-label'));
  assert.match(await second(), /^Photo 2, none\.png/);
  // One stack for all that is changed: the order is undone, done again, and so is the removal.
  await page.keyboard.press('Control+z');
  assert.match(await second(), /^Photo 2, two\.png/);
  await page.keyboard.press('Control+Shift+z');
  assert.match(await second(), /^Photo 2, none\.png/);
  await numbers.nth(0).click();
  await page.locator('#page-caption', { hasText: 'one' }).waitFor();
  await flattened(page);
  assert.deepEqual(await placeOf(page, 'Upper left corner'), placed, 'as it was left');
  const { name, bytes } = await savedPage(page, 'PDF');
  assert.equal(name, 'one-pages.pdf');
  assert.match(bytes.toString('latin1'), /\/Title \(one\)/);
  await page.locator('#save-dialog').evaluate((dialog) => /** @type {HTMLDialogElement} */ (dialog).close());
  const pages = await readPdf(bytes);
  assert.deepEqual(pages.map(({ size }) => size.map(Math.round)), [[210, 297], [210, 297]]);
  const pictures = unzipSync((await savedPage(page, 'ZIP')).bytes);
  assert.deepEqual(Object.entries(pictures).map(([name, picture]) => [name, picture[0], picture[1]]), [['one-1.jpg', 0xff, 0xd8], ['one-2.jpg', 0xff, 0xd8]]);
  // Another photo is added; all of them are there after a reload, as they were left.
  await drop(page, 'photograph_four.png', levelPhoto);
  await page.locator('#page-caption', { hasText: 'four' }).waitFor();
  assert.equal(await numbers.nth(3).innerText(), '4 …aph_four');
  await flattened(page);
  assert.equal(await numbers.count(), 4);
  await page.waitForURL(/file=\d+&photo=1/);
  // Format and light are each photo's own; one that was not looked at yet begins with the light that was chosen last.
  const [format, light] = [page.getByLabel('Page format'), page.getByLabel('Light on the paper')];
  await format.selectOption('letter');
  await light.selectOption('ink');
  await page.keyboard.press('Control+z');
  assert.deepEqual([await format.inputValue(), await light.inputValue()], ['letter', 'even']);
  // What is changed is stored at once, though its flat page is never computed.
  await page.evaluate(() => void (Worker.prototype.postMessage = () => {}));
  await page.keyboard.press('Control+Shift+z');
  /** Waits until something is stored. @param {string} name of the store @param {string} wanted of its entries as JSON */
  const stored = (name, wanted) => page.waitForFunction(([name, wanted]) => new Promise((resolve) => {
    const opening = indexedDB.open('developable');
    opening.onsuccess = () => {
      const all = opening.result.transaction(name).objectStore(name).getAll();
      all.onsuccess = () => resolve(JSON.stringify(all.result.map(({ states, files }) => states?.[3]?.known.light ?? files?.length)).includes(wanted));
      opening.result.close();
    };
  }), [name, wanted]);
  await stored('outlines', 'ink');
  await page.reload();
  await page.locator('#page-caption', { hasText: 'four' }).waitFor();
  await flattened(page);
  assert.equal(await numbers.count(), 4);
  assert.deepEqual([await format.inputValue(), await light.inputValue()], ['letter', 'ink']);
  await numbers.nth(0).click();
  await page.locator('#page-caption', { hasText: 'one' }).waitFor();
  await flattened(page);
  assert.deepEqual([await format.inputValue(), await light.inputValue()], ['', 'even']);
  await page.getByRole('button', { name: 'Looks like A4: use it' }).waitFor();
  assert.deepEqual(await placeOf(page, 'Upper left corner'), placed, 'as it was left');
  // One that is removed stays away, though the next one is never read.
  await page.evaluate(() => void (Worker.prototype.postMessage = () => {}));
  await page.getByRole('button', { name: 'Remove photo' }).click();
  await stored('files', '[3]');
  await page.reload();
  await page.locator('#page-caption', { hasText: 'none' }).waitFor();
  assert.equal(await numbers.count(), 3);
});

doorTest('the pages of a PDF are photos of pages, read by what is loaded only then', async (page) => {
  /** @type {string[]} */
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  await init();
  await load('files');
  const pdf = Buffer.from(writeBook([photo, photo].map((picture) => ({ picture, size: [200, 150] }))));
  assert.equal(asked.filter((url) => /pdf-/.test(url)).length, 0);
  await dropAll(page, { 'scan.pdf': pdf });
  await page.locator('#page-caption', { hasText: 'scan-1' }).waitFor();
  await flattened(page);
  assert.deepEqual(asked.filter((url) => /pdf-/.test(url)).map((url) => /pdf-[a-z]+/.exec(url)?.[0]).sort(), ['pdf-client', 'pdf-worker']);
  const numbers = page.locator('#book').getByRole('button', { name: /^Photo \d/ });
  assert.equal(await numbers.count(), 2);
  assert.equal(await page.getByRole('alert').isVisible(), false);
  const flat = await flatPng(page);
  assert.ok(misplaced(flat) < 0.003);
  // With 300 dots to the inch, the photo has three times as many as it had.
  assert.ok(flat.width > 700, `${flat.width} pixels`);
  await page.keyboard.press('Escape');
  await dropAll(page, { 'torn.pdf': pdf.subarray(0, 300) });
  await page.getByRole('alert').filter({ hasText: /The file could not be read: “torn\.pdf” is damaged, or no PDF .* again/ }).waitFor();
  assert.equal(await numbers.count(), 2);
});

doorTest('a photo in HEIC is read by what is loaded only then, as it was held', async (page) => {
  /** @type {string[]} */
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  // pillow-heif has written `photo` so, a quarter turn to the left, with the tag that turns it back.
  const heic = await readFile(new URL('support/dotted.heic', import.meta.url));
  assert.equal(asked.filter((url) => /heif-/.test(url)).length, 0);
  await dropAll(page, { 'IMG_1.HEIC': heic });
  await page.locator('#page-caption', { hasText: 'IMG_1, 800 × 600' }).waitFor();
  await flattened(page);
  assert.deepEqual(asked.filter((url) => /heif-/.test(url)).map((url) => /heif-[a-z]+/.exec(url)?.[0]).sort(), ['heif-client', 'heif-decoder']);
  assert.ok(misplaced(await flatPng(page)) < 0.005);
});

doorTest('the photo gives way to its flat page at first, by a divider that stays at the rim', async (page) => {
  const divider = page.locator('#flat-divider');
  const places = await divider.evaluateHandle((one) => {
    /** @type {number[]} */
    const places = [];
    new MutationObserver(() => one.checkVisibility() && places.push(Number(one.getAttribute('aria-valuenow')))).observe(one, { attributes: true });
    return places;
  });
  await page.getByRole('button', { name: 'Try an example' }).first().click();
  await page.locator('#flat-divider[aria-valuenow="0"]:visible').waitFor();
  const all = await places.jsonValue();
  assert.ok(all.length > 2 && all[0] > 60 && all.every((place, i) => i === 0 || place <= all[i - 1]) && all.at(-1) === 0, all.join());
  // Where it is put later it stays.
  await divider.press('End');
  await page.getByRole('button', { name: 'Rotate page' }).click();
  await flattened(page);
  assert.equal(await divider.getAttribute('aria-valuenow'), '100');
}, { moving: true });

doorTest('text is recognised in the PDF when it is asked for, by what is loaded only then', async (page) => {
  /** @type {string[]} */
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  await page.getByRole('button', { name: 'Try an example' }).first().click();
  await flattened(page);
  const plain = await savedPage(page, 'PDF');
  assert.deepEqual((await readPdf(plain.bytes)).map(({ texts }) => texts), [[]]);
  const isText = (/** @type {string} */ url) => /text-(?:client|core|english|worker)/.test(url);
  assert.equal(asked.filter(isText).length, 0);
  await page.getByRole('button', { name: 'Save the flat page…' }).click();
  await page.getByLabel(/^Searchable: .* English .*MB/).check();
  const { bytes } = await saveAs(page, 'PDF');
  const [{ texts }] = await readPdf(bytes);
  assert.match(texts.join(' '), /On laying paper flat .*What bends like paper can be laid flat again without a stretch or a tear/);
  assert.equal(asked.filter(isText).length, 4);
});

doorTest('paper is white, or as it was photographed, or the page is black and white', async (page) => {
  await openPhoto(page, 'letter.png', levelPhoto);
  const paper = async () => {
    const { bytes } = await savedPage(page, 'PNG');
    await page.locator('#save-dialog').evaluate((dialog) => /** @type {HTMLDialogElement} */ (dialog).close());
    return bytes;
  };
  // The number of bits of each channel, and the kind of colours: 2 is red, green and blue, 0 grey.
  const kind = (/** @type {Uint8Array} */ bytes) => [bytes[24], bytes[25]];
  const light = page.locator('#page-light');
  const even = await paper();
  await light.selectOption('keep');
  await flattened(page);
  const kept = await paper();
  await light.selectOption('ink');
  await flattened(page);
  const ink = await paper();
  assert.deepEqual([even, kept, ink].map(kind), [[8, 2], [8, 2], [1, 0]]);
  assert.ok(Buffer.compare(even, kept) !== 0);
  // What is chosen last is where the next photo begins, in the tabs of other tests too.
  await light.selectOption('even');
  await flattened(page);
});

test('cautions and doubts about a flat page are said in sentences', () => {
  const told = pageCautions({ outside: ['upper left'], weak: ['lower', 'right'] });
  assert.deepEqual(told, [
    'The upper left corner is outside the photo.', 'The lower and right edges are hard to see.',
  ]);
  const doubts = /** @type {const} */ ([
    ['largeError', 13, /^The photo leaves the bend uncertain\. /], ['hiddenPart', 13, /^A part of the page hides another part\. /],
    ['crumpled', 13, /^The page is crumpled\. /], ['spread', 13, /^This may be an open book/],
  ]);
  for (const [doubt, linesFound, words] of doubts) {
    const report = /** @type {import('../../pkg/types.js').PageReport} */ ({ verdict: 'doubtful', doubt, error: 1.8, errorBound: 4.4, lines: 0, linesFound });
    assert.match(pageErrors(report), words);
    assert.doesNotMatch(pageErrors(report), /off by/);
    assert.match(pageErrors(report, 210), /off by about 4 mm\. Correct the outline/);
  }
});

test('a file is made by the page that is shown, and no page is searched for it again', async () => {
  /** @type {unknown[]} */
  const asked = [];
  const worker = /** @type {any} */ ({ flattenPhoto: async (/** @type {unknown[]} */ ...given) => asked.push(given) });
  const photo = { width: 4000, height: 3000, data: new Uint8ClampedArray(4), reduced: { width: 1280, height: 960 }, film35: 26 };
  const shown = /** @type {any} */ ({ size: [1, 1.4], unit: 'page', warp: {} });
  await flattenWholePhoto(worker, /** @type {any} */ ({ photo, options: { light: 'keep', ink: false, focalLength: 3000 } }), shown);
  const { width, height, data } = photo;
  assert.deepEqual(asked, [[{ width, height, data }, shown, { light: 'keep', ink: false }]]);
});

test('a wide page of any proportions lies on wide paper, and an upright one on upright paper', async () => {
  const worker = /** @type {any} */ ({ writePhoto: async () => new Uint8Array(1) });
  const flat = /** @type {any} */ ({ width: 6, height: 4, resolution: 2, data: new Uint8ClampedArray(96) });
  for (const [pages, quarters, size] of /** @type {const} */ ([[1, 0, [297, 210]], [1, 1, [210, 297]], [2, 0, [210, 297]]])) {
    assert.deepEqual((await pictureFiles(worker, flat, pages, quarters, [210, 297], {})).map((one) => one.size), Array(pages).fill(size));
  }
});

sharedDoorTest('a file of all pixels has the proportions of the flat page that is shown', async (page) => {
  const { width, height, data } = parsePng(photo);
  // Three times as fine as the photo, which is then reduced for what is shown.
  const fine = new Uint8Array(4 * 9 * width * height);
  for (let i = 0; i < 9 * width * height; i++) {
    const at = 4 * (Math.floor(i / (9 * width)) * width + Math.floor((i % (3 * width)) / 3));
    fine.set(data.subarray(at, at + 4), 4 * i);
  }
  await openPhoto(page, 'fine.png', png({ width: 3 * width, height: 3 * height, data: fine }));
  const shown = parsed(await told(page, 'Width to height'));
  const flat = await flatPng(page);
  assert.ok(flat.width > 700, `${flat.width} pixels`);
  assert.ok(Math.abs(flat.width / flat.height / shown - 1) < 0.002, `${flat.width} × ${flat.height} for ${shown}`);
  assert.ok(misplaced(flat) < 0.003);
});

sharedDoorTest('of several pages one is taken, and another by a click', async (page) => {
  const { width, height, data } = parsePng(photo);
  const both = new Uint8Array(8 * width * height);
  for (let row = 0; row < height; row++) {
    for (const k of [0, 1]) both.set(data.subarray(4 * row * width, 4 * (row + 1) * width), 4 * (2 * row + k) * width);
  }
  await openPhoto(page, 'two.png', png({ width: 2 * width, height, data: both }));
  const choices = page.locator('#several').getByRole('button');
  assert.equal(await choices.count(), 2);
  const [before] = await placeOf(page, 'Upper left corner');
  for (const choice of await choices.all()) {
    await choice.click();
    await flattened(page);
    if (Math.abs((await placeOf(page, 'Upper left corner'))[0] - before) > width / 2) return;
  }
  assert.fail('the other page was never taken');
});

sharedDoorTest('a corner outside the photo is named, and stays in the frame', async (page) => {
  const { width, data } = parsePng(photo);
  // The lower edge is just outside.
  const height = 440;
  await openPhoto(page, 'cut.png', png({ width, height, data: data.slice(0, 4 * width * height) }));
  const corner = handle(page, 'Lower left corner');
  await corner.focus();
  while ((await placeOf(page, 'Lower left corner'))[1] < height + 3) await page.keyboard.press('ArrowDown');
  await flattened(page);
  assert.match(await page.locator('#flat-detail').innerText(), /The lower left corner is outside the photo|lower right and lower left corners are outside/);
  const [frame, knob] = await Promise.all([page.locator('.frame:has(> #page-photo)').boundingBox(), corner.boundingBox()]);
  assert.ok(frame && knob && knob.y + knob.height / 2 < frame.y + frame.height, JSON.stringify({ frame, knob }));
});

sharedDoorTest('a corner stays where it is put; starting again can be undone', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  assert.ok(await page.getByRole('button', { name: 'Find the page again' }).isHidden(), 'nothing was changed');
  const wanted = /** @type {Place} */ ([300, 200]);
  await drag(page, 'Upper left corner', wanted);
  await flattened(page);
  const [x, y] = await placeOf(page, 'Upper left corner');
  assert.ok(Math.hypot(x - 300, y - 200) < 2, `${x}, ${y}`);
  assert.doesNotMatch(await page.locator('#flat-verdict').innerText(), /agree/, 'few points, wrongly put');
  await page.getByRole('button', { name: 'Find the page again' }).click();
  await page.getByRole('button', { name: 'Undo' }).click();
  assert.deepEqual(await placeOf(page, 'Upper left corner'), [x, y]);
  await page.getByRole('button', { name: 'Find the page again' }).click();
  await flattened(page);
  const [u, v] = seen(0, 0);
  const again = await placeOf(page, 'Upper left corner');
  assert.ok(Math.hypot(again[0] - u, again[1] - v) < 2.5, `${again}`);
});

sharedDoorTest('edges between corners that are set by hand follow the paper', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  // All four edges are traced anew.
  for (const [name, u, v] of CORNERS) await drag(page, name, seen(u, v));
  await flattened(page);
  assert.doesNotMatch(await page.locator('#flat-detail').innerText(), /hard to see/);
  const [middle] = await edgePlaces(page, 1, [0.5]);
  const [[u, v], [, one], [, other]] = [seen(0.5, 1), seen(0, 1), seen(1, 1)];
  assert.ok(Math.abs((one + other) / 2 - v) > 8 && Math.hypot(middle[0] - u, middle[1] - v) < 5, `${middle} for ${u}, ${v}`);
});

sharedDoorTest('the flat page follows while a corner is dragged, and a magnifier shows what is under it', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  const before = (await look(page, '#flat-canvas')).hash;
  await page.mouse.move(...await onPage(page, await placeOf(page, 'Lower right corner')));
  await page.mouse.down();
  assert.ok((await look(page, '.frame:has(> #page-photo) > .magnifier')).covered > 0.9);
  // Frames go on being drawn while it is worked out.
  const frames = await page.evaluateHandle(() => {
    const counted = { frames: 0, answers: 0 };
    const count = () => {
      counted.frames++;
      requestAnimationFrame(count);
    };
    count();
    new MutationObserver(() => counted.answers++).observe(/** @type {Element} */ (document.querySelector('#flat-canvas')), { attributes: true });
    return counted;
  });
  const [x, y] = seen(0.7, 0.9);
  await page.mouse.move(...await onPage(page, [x, y]), { steps: 8 });
  await flattened(page);
  const { frames: drawn, answers } = await frames.jsonValue();
  assert.ok(answers >= 1 && drawn > answers, `${drawn} frames, ${answers} answers`);
  assert.notEqual((await look(page, '#flat-canvas')).hash, before);
  await page.mouse.up();
  assert.equal(await page.locator('.frame:has(> #page-photo) > .magnifier').isVisible(), false);
});

doorTest('everything on the photo can be done by keyboard', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  const corner = handle(page, 'Upper right corner');
  await corner.focus();
  const [x, y] = await placeOf(page, 'Upper right corner');
  await page.keyboard.press('Shift+ArrowLeft');
  await page.keyboard.press('ArrowDown');
  const [u, v] = await placeOf(page, 'Upper right corner');
  assert.ok(u <= x - 9 && u > x - 60 && v > y && v < y + 6, `${x}, ${y} to ${u}, ${v}`);
  assert.ok(await page.locator('.frame:has(> #page-photo) > .magnifier').isVisible());
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.frame:has(> #page-photo) > .magnifier').isVisible(), false);

  const points = page.getByRole('button', { name: /^Point \d of the lower edge/ });
  assert.equal(await points.count(), 0, 'the edge follows the photo');
  await handle(page, 'Lower left corner').focus();
  await page.getByRole('button', { name: 'Add a point' }).press('Enter');
  assert.equal(await points.count(), 4, 'the others keep its shape');
  await points.first().focus();
  await page.keyboard.press('Delete');
  assert.equal(await points.count(), 3);
  assert.match(await page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? ''), /^Lower left corner/, 'the focus is not lost');
  await page.getByRole('button', { name: 'Add a point' }).press('Enter');
  assert.equal(await points.count(), 4);
  assert.match(await page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? ''), /^Point 1 of the lower edge/);
  await page.getByRole('button', { name: 'Remove the point' }).press('Enter');
  assert.equal(await points.count(), 3);
  await handle(page, 'Lower left corner').press('Delete');
  assert.equal(await handle(page, 'Lower left corner').count(), 1, 'corners stay');
  const undo = page.getByRole('button', { name: 'Undo' });
  await undo.press('Enter');
  assert.equal(await points.count(), 4);
  for (let i = 0; i < 5; i++) await page.keyboard.press('Control+z');
  assert.equal(await undo.getAttribute('aria-disabled'), 'true');
  assert.deepEqual(await placeOf(page, 'Upper right corner'), [x, y]);
});

sharedDoorTest('an edge is pulled into a further point', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  await page.locator('#point-add').evaluate((box) => box.closest('details')?.setAttribute('open', ''));
  const from = await onPage(page, seen(0.4, 0));
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0], from[1] + 30, { steps: 5 });
  const points = page.getByRole('button', { name: /^Point \d of the upper edge/ });
  assert.equal(await points.count(), 4);
  await page.mouse.up();
  await flattened(page);
  assert.match(await page.locator('#flat-verdict').innerText(), /Not reliable|check it|cannot/, 'it was pulled away from the page');
});

sharedDoorTest('lines of text are found and shown', async (page) => {
  await enterPages(page);
  await page.locator('#page-caption', { hasText: 'curled' }).waitFor();
  await flattened(page);
  await page.locator('#page-side details').evaluateAll((all) => all.forEach((details) => details.setAttribute('open', '')));
  const lines = page.locator('#page-photo path.text:not(.under)');
  const verdict = page.locator('#flat-verdict');
  const count = await lines.count();
  assert.ok(count >= 8, `${count} lines`);
  assert.match(await told(page, 'Lines of text'), new RegExp(`^${count} found, off by`));
  assert.match(await verdict.innerText(), /^Made flat: its edges and lines of text agree/);
});

sharedDoorTest('known: format, what is bent, two pages', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  // The photo does not tell its camera, but the page's perspective does.
  assert.match(await told(page, 'Focal length'), /by the perspective/);
  const found = parsed((await told(page, 'Focal length')).replace(/,.*/, ''));
  assert.ok(Math.abs(found / camera.fx - 1) < 0.05, `${found}`);

  // Its size is not known, but it looks like that of a known paper.
  const proposed = await readPdfPicture((await savedPage(page, 'PDF')).bytes);
  assert.ok(proposed.size.every((side, i) => side <= [210, 297][i] + 0.1) && proposed.size.some((side, i) => side > [209.9, 296.9][i]), `a PDF of ${proposed.size} mm`);
  await page.getByRole('button', { name: 'Looks like A4: use it' }).click();
  assert.equal(await page.getByLabel('Page format').inputValue(), 'a4');
  await flattened(page);
  const { size } = await readPdfPicture((await savedPage(page, 'PDF')).bytes);
  assert.ok(Math.abs(size[0] - 210) < 1.5 && Math.abs(size[1] - 297) < 2, `a PDF of ${size} mm`);
  const [wide, high] = (await told(page, 'Size')).split('×').map(parsed);
  assert.ok(Math.abs(wide - 210) < 1.5 && Math.abs(high - 297) < 2, `${wide} × ${high}`);
  await page.getByLabel('Page format').selectOption('own');
  for (const [label, value] of [['Width in mm', '100'], ['Height in mm', '400']]) {
    await page.getByLabel(label).fill(value);
    await page.getByLabel(label).press('Tab');
  }
  await flattened(page);
  assert.deepEqual((await told(page, 'Size')).split('×').map(parsed), [100, 400]);
  await page.getByLabel('Page format').selectOption('');
  await flattened(page);
  const before = parsed(await told(page, 'Width to height'));
  await page.getByRole('button', { name: 'Rotate page' }).click();
  assert.ok(Math.abs(parsed(await told(page, 'Width to height')) * before - 1) < 0.01, `it lies on its side: ${await told(page, 'Width to height')} after ${before}`);
  await choose(page.getByRole('radio', { name: 'Two pages' }));
  await flattened(page);
  assert.equal(await page.getByRole('button', { name: /end of the gutter/ }).count(), 2);
});

sharedDoorTest('the open book has its gutter where both pages meet', async (page) => {
  await enterPages(page);
  await choose(page.locator('input[value="book"]'));
  await page.locator('#page-caption', { hasText: 'book' }).waitFor();
  await flattened(page);
  assert.ok(await page.getByRole('radio', { name: 'Two pages' }).isChecked());
  assert.match(await page.locator('#flat-verdict').innerText(), /^Made flat: its edges and lines of text agree/);
  // Two upright A4 pages; the ratio is told with three digits.
  const ratio = parsed(await told(page, 'Width to height'));
  assert.ok(Math.abs(ratio / (420 / 297) - 1) < 0.02, `${ratio}`);
  const { pages, size } = await readPdfPicture((await savedPage(page, 'PDF')).bytes);
  assert.equal(pages, 2, 'each page by itself');
  assert.ok(Math.abs(size[0] / size[1] / (210 / 297) - 1) < 0.02 && size[0] < 210.1 && size[1] < 297.1, `${size} mm`);
});

sharedDoorTest('what is no photo gets a message and changes nothing, and what is written can be done without', async (page) => {
  await openPhoto(page, 'letter.png', photo);
  const before = [await page.locator('#page-caption').innerText(), (await look(page, '#flat-canvas')).hash];
  for (const [name, bytes] of /** @type {const} */ ([
    ['notes.jpg', Buffer.from('no picture')],
    ['cut.png', photo.subarray(0, 400)],
    ['none.png', Buffer.alloc(0)],
  ])) {
    await drop(page, name, bytes);
    await page.getByRole('alert').filter({ hasText: name }).waitFor();
    assert.deepEqual([await page.locator('#page-caption').innerText(), (await look(page, '#flat-canvas')).hash], before);
  }
  await page.getByRole('button', { name: 'Dismiss' }).click();
  assert.equal(await page.getByRole('alert').isVisible(), false);

  // What is written can be done without, and asked for again.
  const workers = new Set(page.workers());
  // In one go, for the file may be there in a moment.
  const size = await page.evaluate(async () => {
    /** @type {HTMLButtonElement} */ (document.querySelector('#page-save')).click();
    const writing = /** @type {HTMLElement} */ (document.querySelector('#writing'));
    // What takes no time would not be told of.
    await new Promise((resolve) => {
      new MutationObserver(() => !writing.hidden && resolve(null)).observe(writing, { attributes: true });
      setTimeout(resolve, 1000);
    });
    /** @type {HTMLButtonElement} */ (document.querySelector('#writing-cancel')).click();
    return document.querySelector('#save-size')?.textContent;
  });
  assert.equal(size, 'Cancelled.');
  await ended(page, workers);
  assert.ok(await page.locator('#save-dialog').isVisible());
  assert.equal(await page.locator('#save-size').innerText(), 'Cancelled.');
  assert.ok(await page.locator('#save-now').isDisabled());
  await page.getByRole('button', { name: 'Write the file' }).click();
  const { bytes } = await saveAs(page, 'PNG');
  assert.ok(misplaced(parsePng(bytes)) < 0.003);
});

const phone = { width: 390, height: 844 };

doorTest('on a phone a finger drags, and nothing scrolls', async (page) => {
  await openPhoto(page, 'letter.png', levelPhoto);
  const excess = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  assert.ok(excess <= 0, `${excess} pixels stick out`);
  for (const one of await page.locator('.handle').all()) {
    const box = await one.boundingBox();
    assert.ok(box && box.width >= 44 && box.height >= 44, 'large enough for a finger');
  }
  const low = await page.locator(':is(.masthead, #page-side) :is(button, select):not(.handle):visible').evaluateAll((all) =>
    all.filter((one) => one.getBoundingClientRect().height < 44).map(({ id }) => id));
  assert.deepEqual(low, []);
  const [x, y] = await placeOf(page, 'Lower left corner');
  await page.locator('#page-photo').scrollIntoViewIfNeeded();
  const scrolled = await page.evaluate(() => window.scrollY);
  const touch = await page.context().newCDPSession(page);
  const [fromX, fromY] = await onPage(page, [x, y], LEVEL_WIDTH);
  await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x: fromX + 8, y: fromY + 8 }] });
  for (const k of [1, 2, 3, 4]) {
    await touch.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [{ x: fromX + 8 + 5 * k, y: fromY + 8 - 12 * k }] });
  }
  await painted(page);
  assert.ok(await page.locator('.frame:has(> #page-photo) > .magnifier').isVisible());
  const [u, v] = await placeOf(page, 'Lower left corner');
  const box = await page.locator('#page-photo').boundingBox();
  assert.ok(box);
  const scale = LEVEL_WIDTH / box.width;
  assert.ok(Math.abs(u - x - 20 * scale) < 2 * scale && Math.abs(v - y + 48 * scale) < 2 * scale, `${u - x}, ${v - y}`);
  // The finger rests before it leaves, or Chromium takes the next tap for the end of a fling.
  await page.waitForTimeout(300);
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  assert.equal(await page.evaluate(() => window.scrollY), scrolled);
  const again = page.getByRole('button', { name: 'Find the page again' });
  await again.scrollIntoViewIfNeeded();
  const button = await again.boundingBox();
  assert.ok(button);
  await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x: button.x + button.width / 2, y: button.y + button.height / 2 }] });
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  // Nothing moves under the finger any more.
  await page.getByRole('button', { name: `Lower left corner, at ${x}, ${y}`, exact: true }).waitFor();
  await flattened(page);
  // What one came for is on the first screen.
  const save = await page.evaluate(() => {
    scrollTo(0, 0);
    return document.querySelector('#page-save')?.getBoundingClientRect().bottom ?? Infinity;
  });
  assert.ok(save <= phone.height, `${save}`);
  await page.locator('#page-save').click();
  const small = await page.locator('#save-dialog :is(.format, .format input):visible').evaluateAll((all) =>
    all.map((one) => one.getBoundingClientRect()).filter(({ width, height }) => Math.min(width, height) < 24).length);
  assert.equal(small, 0, 'what a finger chooses');
}, { size: phone, pixels: 2, phone: true });

sharedDoorTest('a photo that is being read can be done without', async (page) => {
  /** Opens a large photo, and gives it up as soon as that is offered. @param {boolean} cancel */
  const open = (cancel) => page.evaluate(async (cancel) => {
    const canvas = new OffscreenCanvas(4000, 3000);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d'));
    for (let i = 0; i < 4000; i++) {
      context.fillStyle = `hsl(${(i * 37) % 360} 60% 50%)`;
      context.fillRect((i * 131) % 4000, (i * 71) % 3000, 90, 60);
    }
    const blob = await canvas.convertToBlob({ type: 'image/png' });
    const files = new DataTransfer();
    files.items.add(new File([blob], 'large.png', { type: 'image/png' }));
    const input = /** @type {HTMLInputElement} */ (document.querySelector('#file'));
    const panel = /** @type {HTMLElement} */ (document.querySelector('#opening'));
    const offered = new Promise((resolve) => new MutationObserver(() => !panel.hidden && resolve(null)).observe(panel, { attributes: true }));
    input.files = files.files;
    input.dispatchEvent(new Event('change', { bubbles: true }));
    await offered;
    if (cancel) /** @type {HTMLButtonElement} */ (document.querySelector('#opening-cancel')).click();
    return panel.hidden;
  }, cancel);
  // What is opened meanwhile is a further page.
  assert.equal(await open(false), false);
  await openPhoto(page, 'letter.png', levelPhoto);
  assert.ok(await page.locator('#page-side').isVisible());
  assert.equal(await page.locator('#book .page-button').count(), 2);
  const caption = page.locator('#page-caption');
  const before = new Set(page.workers());
  assert.equal(await open(true), true);
  await ended(page, before);
  await painted(page);
  assert.match(await caption.innerText(), /letter/);
  assert.equal(await open(false), false);
  await caption.filter({ hasText: 'large' }).waitFor();
  await page.locator('#opening').waitFor({ state: 'hidden' });
});
