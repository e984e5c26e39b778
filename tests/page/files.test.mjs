/** Files in, by drop and by dialog, sound and broken; files out. */
import assert from 'node:assert/strict';
import { read, writeImage } from '../../pkg/index.js';
import { grid, npy, parseNpy, png16, ramp } from './support/files.mjs';
import { colouredPicture } from './support/photos.mjs';
import { choose, doorTest, drop, dropAll, enterPages, open, reported, runBy, save, settled, sharedDoorTest, sharedTest } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */

const [WIDTH, HEIGHT] = [48, 36];
/** A plane is developable, and the solver must leave it alone: what goes in must come out. */
const plane = grid(WIDTH, HEIGHT, (col, row) => 2000 + 30 * col + 50 * row);

/** @param {Page} page */
const run = (page) => runBy(page, () => page.getByRole('button', { name: 'Solve', exact: true }).click());

/**
 * @param {number[]} found
 * @param {number[]} expected
 * @param {number} tolerance
 */
function assertClose(found, expected, tolerance) {
  assert.equal(found.length, expected.length);
  const worst = Math.max(...found.map((value, i) => Math.abs(value - expected[i])));
  assert.ok(worst <= tolerance, `off by ${worst}`);
}

sharedDoorTest('a dropped NPY is shown, solved at once, and comes back as an NPY', async (page) => {
  await open(page, 'slope.npy', npy(WIDTH, plane));
  await page.locator('#input-caption', { hasText: `${WIDTH} × ${HEIGHT}` }).waitFor();
  assert.ok(await page.locator('#space-after').isVisible());
  await run(page);
  const { name, bytes } = await save(page, 'NPY');
  assert.match(name, /^slope.*\.npy$/);
  const { rows, cols, values } = parseNpy(bytes);
  assert.deepEqual([rows, cols], [HEIGHT, WIDTH]);
  assertClose(values, plane, 1e-3 * (Math.max(...plane) - Math.min(...plane)));
});

sharedDoorTest('a dropped 16-bit PNG takes the scale that is given', async (page) => {
  await open(page, 'slope.png', png16(WIDTH, plane));
  await page.locator('#file-name', { hasText: 'PNG' }).waitFor();
  assert.match(await page.locator('#file-name').innerText(), /16/);
  const [pixelSize, heightScale] = [0.5, 0.01];
  // Each is solved at once.
  for (const [label, value] of /** @type {const} */ ([['Pixel size', pixelSize], ['Height scale', heightScale]])) {
    const field = page.getByLabel(label);
    await runBy(page, () => field.fill(String(value)).then(() => field.blur()));
  }
  const expected = plane.map((value) => value * heightScale);
  const { values } = parseNpy((await save(page, 'NPY')).bytes);
  assertClose(values, expected, 1e-3 * (Math.max(...expected) - Math.min(...expected)));
});

sharedDoorTest('a GeoTIFF lies where it lay on the map', async (page) => {
  const georeference = { transformation: /** @type {[number, number, number, number, number, number]} */ ([2, 0, 4e5, 0, -2, 5.4e6]), keys: [1, 1, 0, 1, 3072, 0, 1, 32633], doubles: [], text: '' };
  await open(page, 'map.tif', Buffer.from(await writeImage({ width: WIDTH, height: HEIGHT, data: plane, georeference }, { format: 'tiff' })));
  await run(page);
  assert.deepEqual((await read((await save(page, 'TIFF')).bytes)).georeference, georeference);
});

sharedDoorTest('holes stay holes', async (page) => {
  const hole = (/** @type {number} */ col, /** @type {number} */ row) => Math.hypot(col - 24, row - 18) < 6;
  const pierced = plane.map((value, i) => (hole(i % WIDTH, Math.floor(i / WIDTH)) ? NaN : value));
  await open(page, 'pierced.npy', npy(WIDTH, pierced));
  await run(page);
  const { values } = parseNpy((await save(page, 'NPY')).bytes);
  assert.deepEqual(values.map(Number.isNaN), pierced.map(Number.isNaN));
});

sharedDoorTest('zeros far from all heights are no data, unless none is', async (page) => {
  const framed = plane.map((value, i) => (i % WIDTH < 8 ? 0 : 5000 + value));
  await open(page, 'framed.npy', npy(WIDTH, framed));
  await run(page);
  const { values } = parseNpy((await save(page, 'NPY')).bytes);
  assert.deepEqual(values.map(Number.isNaN), framed.map((value) => value === 0));
  const field = page.getByLabel('Number that means no data');
  await runBy(page, () => field.fill('none').then(() => field.blur()));
  assert.ok(parseNpy((await save(page, 'NPY')).bytes).values.every(Number.isFinite));
  await page.waitForURL(/noData=none/);
});

sharedDoorTest('a value that means no data is given by hand, and stands in the address', async (page) => {
  const marked = plane.map((value, i) => (i % WIDTH < 8 ? -7 : value));
  await open(page, 'marked.npy', npy(WIDTH, marked));
  const field = page.getByLabel('Number that means no data');
  await runBy(page, () => field.fill('-7').then(() => field.blur()));
  const { values } = parseNpy((await save(page, 'NPY')).bytes);
  assert.deepEqual(values.map(Number.isNaN), marked.map((value) => value === -7));
  await page.waitForURL(/noData=-7/);
});

sharedDoorTest('heights along one line are refused with the reason', async (page) => {
  await open(page, 'line.npy', npy(WIDTH, plane.map((value, i) => (i < WIDTH ? value : NaN))));
  await run(page);
  assert.match(await page.getByRole('alert').innerText(), /too few heights beside each other/);
  assert.match(await page.locator('#verdict').innerText(), /not solved/);
});

doorTest('a file, a mesh’s other side and a file to be saved can be done without: their workers end, and what was there stays', async (page) => {
  await open(page, 'ramp.obj', ramp);
  await settled(page);
  await choose(page.getByRole('radio', { name: 'From one side', exact: true }));
  await settled(page);
  await page.evaluate(() => {
    const { postMessage, terminate } = Worker.prototype;
    const held = { on: false, ended: 0 };
    Object.assign(window, { held });
    /** Those that are never told what to do. @type {WeakSet<Worker>} */
    const waiting = new WeakSet();
    Worker.prototype.postMessage = function (/** @type {any[]} */ ...message) {
      if (held.on) waiting.add(this);
      // @ts-expect-error one signature of several
      else postMessage.apply(this, message);
    };
    Worker.prototype.terminate = function () {
      if (waiting.delete(this)) held.ended++;
      terminate.call(this);
    };
  });
  /** @param {boolean} on */
  const hold = (on) => page.evaluate((value) => void (/** @type {any} */ (window).held.on = value), on);
  const ended = () => page.evaluate(() => /** @type {any} */ (window).held.ended);
  const before = await page.locator('#input-caption').innerText();
  const place = await page.locator('#picture').boundingBox();
  const ways = /** @type {const} */ ([
    ['opening', /Reading the file/, () => drop(page, 'slope.npy', npy(WIDTH, plane))],
    ['opening', /Looking at it from there/, () => choose(page.getByRole('radio', { name: '+x', exact: true }))],
    ['writing', /Writing the file/, () => page.locator('#end-file').click()],
  ]);
  for (const [i, [panel, words, act]] of ways.entries()) {
    await hold(true);
    await act();
    await page.locator(`#${panel}`, { hasText: words }).waitFor();
    if (i === 0) {
      const opening = page.getByRole('group', { name: 'Opening a file' });
      assert.deepEqual([await opening.getByRole('button', { name: 'Cancel' }).count(), await opening.locator('progress:indeterminate').count()], [1, 1], 'nothing tells how long it takes');
      assert.deepEqual(await page.locator('#picture').boundingBox(), place, 'its bar moves nothing');
    }
    const gone = await page.locator(`#${panel}-cancel`).evaluate((/** @type {HTMLButtonElement} */ button) => {
      button.click();
      return button.parentElement?.hidden;
    });
    assert.ok(gone, 'at once');
    assert.equal(await ended(), i + 1, 'nobody goes on with it');
    await hold(false);
    assert.equal(await page.locator('#input-caption').innerText(), before);
  }
  assert.match(await page.locator('#save-size').innerText(), /Cancelled/);
  await page.getByRole('button', { name: 'Write the file' }).click();
  await page.locator('#save-size', { hasText: /obj, .*MB/ }).waitFor();
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#notice').isVisible(), false, 'nothing went wrong');
  await open(page, 'slope.npy', npy(WIDTH, plane));
  assert.match(await page.locator('#input-caption').innerText(), /^slope/);
  assert.equal(await page.locator('#opening').isVisible(), false);
});

sharedTest('the file button opens a file', async (page) => {
  const [chooser] = await Promise.all([
    page.waitForEvent('filechooser'),
    page.getByRole('button', { name: /^Open/ }).click(),
  ]);
  await chooser.setFiles({ name: 'slope.npy', mimeType: '', buffer: npy(WIDTH, plane) });
});

sharedTest('a file of the wrong kind is named, and the part of the page that takes it is one click away', async (page) => {
  const alert = page.getByRole('alert');
  for (const [name, content, says] of /** @type {const} */ ([
    ['letter.docx', 'PK\x03\x04 word/', /“letter.docx” could not be read: document of an office program: save it as PDF, and the PDF's pages as pictures/],
    ['notes.txt', 'Dear Anna', /“notes.txt” has no heights/], ['part.step', 'ISO-10303-21;', /save it as a mesh/], ['clip.mp4', '\0\0\0\x18ftypisom', /film: save one of its pictures/],
    ['text.png', 'Dear Anna', /“text\.png” could not be read: text: it is of no format that is read; heights are read from PNG/], ['notes.docx', 'PK\x03\x04', /archive: it is packed: unpack it first/],
  ])) {
    await drop(page, name, Buffer.from(content));
    await alert.filter({ hasText: says }).waitFor();
  }
});

sharedDoorTest('what the name of a file does not tell, its contents do', async (page) => {
  const rows = Array.from({ length: HEIGHT }, (_, row) => Array.from({ length: WIDTH }, (_, col) => plane[row * WIDTH + col]));
  /** Words on the page, after a file is dropped. @param {string} name @param {string} text @param {string} place @param {string | RegExp} says */
  const said = async (name, text, place, says) => {
    await drop(page, name, Buffer.from(text));
    await page.locator(place, { hasText: says }).waitFor({ state: 'attached' });
  };
  // Nothing is passed over without a word.
  await said('camera.json', '{"fx":5,"fy":5,"cx":2,"cy":2}', '#notice-text', /“camera\.json” has no heights.* If it is a camera, open it together with its depths/);
  await said('table.csv', rows.map((row) => row.join(',')).join('\n'), '#input-caption', `table, ${WIDTH} × ${HEIGHT}`);
  await said('notes.csv', 'a,b\nc,d\n', '#notice-text', /“notes\.csv” has no heights/);
  await said('matrix.txt', rows.map((row) => row.join(' ')).join('\n'), '#input-caption', `matrix, ${WIDTH} × ${HEIGHT}`);
  await said('part.STL.txt', 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 60 0 0\nvertex 0 60 0\nendloop\nendfacet\nendsolid a\n', '#mesh-name', 'part.STL (STL)');
  await settled(page);
});

sharedTest('the kind of a file chooses the part of the page, and what does not belong to it is named', async (page) => {
  const alert = page.getByRole('alert');
  // What cannot be opened leaves the first screen as it is, and is named with the way out.
  await page.getByRole('link', { name: 'developable' }).click();
  await dropAll(page, { 'IMG_6.heic': Buffer.from('\0\0\0\x18ftypheic\0\0\0\0heicmif1', 'latin1') });
  await alert.filter({ hasText: /“IMG_6\.heic” could not be opened: HEIC: save it as JPEG/ }).waitFor();
  assert.ok(await page.locator('#home').isVisible());
  // A photo on the first screen, beside something that cannot be read.
  await dropAll(page, { 'IMG_7.png': colouredPicture, 'letter.docx': Buffer.from('PK\x03\x04') });
  await page.locator('#page-caption', { hasText: 'IMG_7' }).waitFor();
  assert.ok(await page.locator('#page-side').isVisible());
  await alert.filter({ hasText: /Left out: “letter\.docx”\. With photos of pages go only photos/ }).waitFor();
  assert.equal(await page.locator('#notice').getAttribute('data-kind'), 'note');
  // It is in colour.
  assert.doesNotMatch(await alert.innerText(), /Taken for|Heights/);
  // A photo that cannot be read does not keep the next one from being opened, and is named.
  await dropAll(page, { 'IMG_8.heic': Buffer.from('\0\0\0\x18ftypheic\0\0\0\0heicmif1', 'latin1'), 'IMG_9.png': colouredPicture });
  await page.locator('#page-caption', { hasText: 'IMG_9' }).waitFor();
  await alert.filter({ hasText: '“IMG_8.heic” could not be opened' }).waitFor();
  // A mesh with another one and a photo that it does not name.
  await dropAll(page, { 'ramp.obj': ramp, 'other.obj': ramp, 'IMG_7.png': colouredPicture });
  await page.locator('#input-caption', { hasText: 'ramp' }).waitFor({ state: 'attached' });
  await settled(page);
  assert.match(await alert.innerText(), /^Left out: “other\.obj”, “IMG_7\.png”\. With a model go only the textures and materials that it names\./);
  await alert.getByRole('button', { name: 'Open these instead' }).click();
  await page.locator('#input-caption', { hasText: 'other' }).waitFor({ state: 'attached' });
  await settled(page);
  // What a depth camera writes is a picture, too.
  await enterPages(page);
  await page.locator('#page-caption', { hasText: 'curled' }).waitFor();
  await drop(page, 'scan.png', png16(WIDTH, plane));
  await page.locator('#input-caption', { hasText: 'scan' }).waitFor();
  await settled(page);
  assert.match(await alert.innerText(), /^Taken for heights\./);
});

sharedDoorTest('a photo with more pixels than the package reads is reduced without a question', async (page) => {
  await enterPages(page);
  await page.locator('#page-caption', { hasText: 'curled' }).waitFor();
  // 5000 × 4400 pixels of one grey.
  await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(5000, 4400);
    const context = /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext('2d'));
    context.fillStyle = '#777';
    context.fillRect(0, 0, 5000, 4400);
    const files = new DataTransfer();
    files.items.add(new File([await canvas.convertToBlob({ type: 'image/png' })], 'large.png'));
    const input = /** @type {HTMLInputElement} */ (document.querySelector('#file'));
    input.files = files.files;
    input.dispatchEvent(new Event('change', { bubbles: true }));
  });
  await page.locator('#page-caption', { hasText: /large, .* × / }).waitFor();
  assert.equal(await page.getByRole('alert').isVisible(), false);
});

/** @type {{ what: string, name: string, bytes: Buffer, says: RegExp }[]} */
const broken = [
  { what: 'a truncated PNG', name: 'scan.png', bytes: png16(WIDTH, plane).subarray(0, 90), says: /cut short|end|truncated|incomplete/i },
  { what: 'a text called .npy', name: 'notes.npy', bytes: Buffer.from('heights: see the other file\n'), says: /PNG|NPY|format/ },
  { what: 'an NPY of NaN only', name: 'void.npy', bytes: npy(WIDTH, plane.map(() => NaN)), says: /NaN|no data/ },
  { what: 'a single row of pixels', name: 'line.npy', bytes: npy(WIDTH, plane.slice(0, WIDTH)), says: /at least 3 × 3/ },
  { what: 'an empty file', name: 'nothing.png', bytes: Buffer.alloc(0), says: /empty|PNG|NPY|no bytes/i },
];

sharedTest('what cannot be read gets a message each, and the previous result stays', async (page) => {
  const shown = async () => ({
    verdict: await page.locator('#verdict').innerText(),
    gap: await reported(page, 'Gap'),
    result: await page.locator('#result-caption').innerText(),
  });
  await page.locator('#page[data-phase="idle"]').waitFor();
  const before = await shown();
  // Wherever the page is scrolled to.
  await page.evaluate(() => window.scrollTo(0, document.documentElement.scrollHeight));
  for (const { what, name, bytes, says } of broken) {
    await drop(page, name, bytes);
    // The message of the file before gives way to this one.
    const alert = page.getByRole('alert').filter({ hasText: name });
    const message = await alert.innerText();
    const { top, bottom } = await alert.evaluate((element) => element.getBoundingClientRect());
    assert.ok(top >= 0 && bottom <= (page.viewportSize()?.height ?? 0), `${what}: the message is from ${top} to ${bottom}`);
    assert.match(message, says, what);
    assert.deepEqual(await shown(), before, what);
    assert.ok(await page.locator('#end-file').isEnabled(), what);
  }
});

sharedTest('the bar of writing does not move the formats away from under the pointer', async (page) => {
  await page.locator('#end-file').click();
  await page.locator('#save-dialog[open]').waitFor();
  const tops = await page.locator('#save-formats').evaluate((formats) => {
    const bar = /** @type {HTMLElement} */ (document.getElementById('writing'));
    return [true, false].map((hidden) => {
      bar.hidden = hidden;
      return formats.getBoundingClientRect().top;
    });
  });
  assert.equal(tops[0], tops[1]);
});
