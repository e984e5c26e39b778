/** Flat images in files of their true size: directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { refuses, succeeds, temporaryFolder } from './support/command.mjs';
import { readPdfPicture, readPdfWords } from './support/drawings.mjs';
import { error } from './support/error.mjs';
import { depthCamera, depths, photo as taken, photoCamera } from './support/phone.mjs';
import { photoOf } from './support/shapes.mjs';

after(() => developable.dispose());
await Promise.all([direct.init(), direct.load('files', 'images', 'meshes', 'unroll')]);

const [width, height] = [90, 70];
/** Red from left to right, green from top to bottom; its lower third is transparent. */
const picture = photoOf(width, height, (x, y) => [2 * x, 3 * y, 40, y < 48 ? 255 : 0]);

/** What a PNG's pHYs chunk states, in pixels per millimetre. @param {Uint8Array} file */
function pngDensity(file) {
  const bytes = Buffer.from(file);
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at)) {
    if (bytes.toString('latin1', at + 4, at + 8) !== 'pHYs') continue;
    assert.deepEqual([bytes.readUInt32BE(at + 8), bytes[at + 16]], [bytes.readUInt32BE(at + 12), 1]);
    return bytes.readUInt32BE(at + 8) / 1000;
  }
  return undefined;
}

/** What a JPEG's JFIF segment states, likewise. @param {Uint8Array} file */
function jpegDensity(file) {
  const bytes = Buffer.from(file);
  assert.equal(bytes.toString('latin1', 6, 10), 'JFIF');
  const [unit, across, down] = [bytes[13], bytes.readUInt16BE(14), bytes.readUInt16BE(16)];
  assert.equal(across, down);
  return { 1: across / 25.4, 2: across / 10 }[unit];
}

/** How far colours are from those of the picture on white. @param {{ data: ArrayLike<number> }} found @param {number} channels */
function off({ data }, channels) {
  let sum = 0;
  for (let i = 0; i < width * height; i += 1) {
    for (let k = 0; k < 3; k += 1) {
      const wanted = picture.data[4 * i + 3] === 255 ? picture.data[4 * i + k] : 255;
      sum += (data[channels * i + k] - wanted) ** 2;
    }
  }
  return Math.sqrt(sum / (3 * width * height));
}

test('a PDF page is as large as what it shows', async () => {
  const file = direct.writePhoto(picture, { format: 'pdf', dotsPerMillimetre: 2 });
  const found = await readPdfPicture(file);
  assert.equal(found.pages, 1);
  assert.ok(Math.abs(found.size[0] - 45) < 1e-3 && Math.abs(found.size[1] - 35) < 1e-3, String(found.size));
  // The picture covers it all.
  assert.deepEqual(found.matrix.map((/** @type {number} */ value) => Math.round(value)), [45, 0, 0, 35, 0, 0]);
  assert.deepEqual([found.width, found.height], [width, height]);
  assert.ok(off(found, found.data.length / width / height) < 4);
});

test('a book has a page for each picture, which is as large as fits and in the middle', async () => {
  const jpeg = direct.writePhoto(picture, { format: 'jpeg' });
  const data = picture.data.map((value, i) => (i % 4 === 3 || value > 90 ? 255 : value > 45 ? 255 : 0)).map((_, i, all) => (i % 4 === 3 ? 255 : all[i - (i % 4)]));
  const png = direct.writePhoto({ width, height, data });
  const pages = /** @type {const} */ ([{ picture: jpeg, size: [180, 200] }, { picture: png, size: [90, 70] }]);
  const book = direct.writeBook(pages);
  assert.deepEqual(await developable.writeBook(pages), book);
  const first = await readPdfPicture(book);
  assert.equal(first.pages, 2);
  assert.deepEqual(first.matrix.map(Math.round), [180, 0, 0, 140, 0, 30]);
  const second = await readPdfPicture(direct.writeBook([pages[1]]));
  assert.deepEqual([second.width, second.height, second.size.map(Math.round)], [width, height, [90, 70]]);
  for (const [given, message] of /** @type {[unknown, RegExp][]} */ ([
    [[{ picture: jpeg, size: [0, 200] }], /size of page 1/], [[{ picture: jpeg, size: 4 }], /size of page 1/], [jpeg, /list/], [[{ picture: 'a', size: [9, 9] }], /bytes/],
  ])) {
    assert.throws(() => direct.writeBook(/** @type {any} */ (given)), error('INPUT', message));
  }
  assert.doesNotMatch(Buffer.from(book).toString('latin1'), /\/Title/);
  for (const titled of [direct.writeBook(pages, { title: 'A letter' }), await developable.writeBook(pages, { title: 'A letter' }), direct.writePhoto(picture, { format: 'pdf', dotsPerMillimetre: 2, title: 'A letter' })]) {
    const text = Buffer.from(titled).toString('latin1');
    const [, info] = /\/Info (\d+) 0 R/.exec(text) ?? [];
    assert.match(text, new RegExp(`\\n${info} 0 obj\\n<<\\s*/Title \\(A letter\\)`));
  }
  assert.throws(() => direct.writeBook([]), error('EMPTY', /book/));
  assert.throws(() => direct.writeBook([{ picture: new Uint8Array([1, 2]), size: [9, 9] }]), error('UNSUPPORTED', /JPEG or PNG/));
});

test('words of a page lie over its picture, in all scripts', async () => {
  const jpeg = direct.writePhoto(picture, { format: 'jpeg' });
  // A word of each script, one with a character beyond 16 bits, and one that hangs over the edge by less than a pixel.
  const texts = ['naïve', 'ψυχή', 'Привет', '日本語', '𝒳𝒴', '(a\\b)', 'שלום', 'edge'];
  const words = texts.map((text, i) => ({ text, box: /** @type {const} */ ([3 + i, 8.5 * i + (i === 7 ? 4 : 1), 30 + 5 * i, 7]) }));
  const blank = { text: ' \n', box: /** @type {const} */ ([0, 0, 0, 0]) };
  const pages = [{ picture: jpeg, size: /** @type {const} */ ([90, 70]) }, { picture: jpeg, size: /** @type {const} */ ([180, 200]), words: [blank, ...words, blank] }];
  const book = direct.writeBook(pages);
  assert.deepEqual(await developable.writeBook(pages), book);
  assert.deepEqual(await readPdfWords(book, 1), []);
  const found = await readPdfWords(book, 2);
  assert.deepEqual(found.map(({ text }) => text), texts);
  // On this page a pixel is 2 mm, and the picture begins 30 mm below the top.
  for (const [i, { box: [left, top, wide, high] }] of found.entries()) {
    const pixels = [left / 2, (top - 30) / 2, wide / 2, high / 2];
    assert.ok(pixels.every((side, k) => Math.abs(side - words[i].box[k]) < 0.01), `${texts[i]}: ${pixels}`);
  }
  const file = Buffer.from(book);
  assert.ok(file.indexOf(jpeg) > 0 && file.indexOf(jpeg) < file.lastIndexOf(jpeg));
  const line = ['two', 'words'].map((text, i) => ({ text, box: /** @type {const} */ ([5 + 30 * i, 20, 25, 10]) }));
  const together = await readPdfWords(direct.writeBook([{ ...pages[0], words: line }]), 1);
  assert.equal(together.map((word) => word.text).join(' '), 'two words');
  for (const [given, code, message] of /** @type {[unknown, string, RegExp][]} */ ([
    [[words[0], { text: 'a', box: [80, 0, 12, 9] }], 'UNSUPPORTED', /word 2 of page 1 .*within its picture of 90 × 70 pixels/],
    [[{ text: 'a', box: [0, 0, 0, 9] }], 'UNSUPPORTED', /word 1 of page 1/],
    [[{ text: 'a', box: [0, 0, 9, NaN] }], 'INPUT', /box of word 1 of page 1/],
    [[{ text: 'a', box: [0, 0, 9] }], 'INPUT', /box of word 1 of page 1/],
    [[{ text: 5, box: [0, 0, 9, 9] }], 'INPUT', /text of word 1 of page 1/],
    ['words', 'INPUT', /words of page 1 must be a list/],
  ])) {
    assert.throws(() => direct.writeBook(/** @type {any} */ ([{ ...pages[0], words: given }])), error(code, message));
  }
});

test('JPEG and PNG state the resolution that is known', async () => {
  const jpeg = direct.writePhoto({ ...picture, resolution: 8000, unit: 'm' }, { format: 'jpeg' });
  assert.ok(Math.abs(Number(jpegDensity(jpeg)) - 8) < 1e-9);
  assert.ok(off(direct.readPhoto(jpeg), 4) < 4);
  const small = await developable.writePhoto(picture, { format: 'jpeg', quality: 30 });
  assert.ok(small.length < 0.7 * jpeg.length, `${small.length} ${jpeg.length}`);
  assert.equal(jpegDensity(small), undefined);
  const png = await developable.writePhoto({ ...picture, resolution: 11.811, unit: 'mm' });
  assert.equal(pngDensity(png), 11.811);
  assert.deepEqual(direct.readPhoto(png).data, picture.data);
  // What is said counts more than what the picture says; nothing is known of the width of some page.
  assert.equal(pngDensity(direct.writePhoto({ ...picture, resolution: 5, unit: 'mm' }, { dotsPerMillimetre: 3 })), 3);
  assert.equal(pngDensity(direct.writePhoto({ ...picture, resolution: 5, unit: 'page' })), undefined);
  assert.equal(pngDensity(direct.writePhoto(picture)), undefined);
});

test('what cannot be written is refused', async () => {
  const write = (/** @type {object} */ options, given = picture) => () => direct.writePhoto(given, options);
  assert.throws(write({ format: 'pdf' }), error('INPUT', /true size.*dotsPerMillimetre/));
  assert.throws(write({ format: 'pdf' }, { ...picture, ...{ resolution: 2, unit: 'page' } }), error('INPUT', /true size/));
  assert.throws(write({ format: 'pdf', dotsPerMillimetre: 0.001 }), error('UNSUPPORTED', /5\.08 m/));
  assert.throws(write({ format: 'tiff' }), error('OPTION', /format/));
  assert.throws(write({ quality: 101, format: 'jpeg' }), error('OPTION', /quality.*1 to 100/));
  assert.throws(write({ quality: 3000, format: 'jpeg' }), error('OPTION', /quality.*1 to 100/));
  assert.throws(write({ dotsPerMillimetre: 0 }), error('OPTION', /dotsPerMillimetre/));
  await assert.rejects(developable.writePhoto(picture, { format: 'pdf' }), error('INPUT', /true size/));
  assert.throws(() => direct.fit({ width: 3, height: 3, data: new Float32Array(9), unit: /** @type {any} */ ('ft') }), error('INPUT', /unit/));
});

test('the unit goes from depths to the flat page', async () => {
  const { width: cols, height: rows, ...numbers } = depthCamera;
  const mesh = direct.backProject(depths(), { ...numbers, unit: 'm' });
  const seen = direct.sampleMesh(mesh, { view: 'best-fit' });
  const surface = await developable.fit(seen, { lambda: 'big' });
  assert.deepEqual([mesh.unit, seen.unit, surface.unit, mesh.camera?.width, 'unit' in Object(mesh.camera)], ['m', 'm', 'm', cols, false]);
  assert.equal(rows, mesh.camera?.height);
  const flat = await developable.dewarp(surface, taken(photoCamera));
  assert.equal(flat.unit, 'm');
  const { size } = await readPdfPicture(await developable.writePhoto(flat, { format: 'pdf' }));
  // The sheet ends up to two pixels of the depths within the page: 210 by 297 mm, at 0.43 m and f = 205.
  for (const [k, side] of [210, 297].entries()) assert.ok(size[k] < side + 1 && size[k] > side - 12, String(size));
  const image = direct.fit({ width: 20, height: 20, data: new Float32Array(400), unit: 'mm', pixelSize: 2 });
  assert.equal(image.unit, 'mm');
  const plane = direct.dewarp(image, picture);
  assert.equal(plane.unit, 'mm');
  assert.equal(direct.dewarp({ width: 20, height: 20, data: new Float32Array(400) }, picture).unit, undefined);
});

test('the command writes pages in true size', async () => {
  const folder = await temporaryFolder();
  const { width: cols, height: rows } = depthCamera;
  const { data } = depths();
  const coarse = taken(photoCamera);
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(coarse));
  await writeFile(join(folder, 'depth.exr'), direct.writeImage({ width: cols, height: rows, data }, { format: 'exr' }));
  await writeFile(join(folder, 'camera.json'), JSON.stringify({ fx: 205, fy: 205, cx: 126, cy: 97, width: 256, height: 192 }));
  const common = ['--texture', 'photo.png', '--lambda', 'big', '--view', 'best-fit'];
  const fromDepth = ['dewarp', 'depth.exr', '--intrinsics', 'camera.json', ...common];
  const command = (/** @type {string[]} */ ...args) => succeeds(folder, args);
  await command(...fromDepth, '-o', 'page.pdf', '--quality', '80');
  const { size, width: wide, height: tall } = await readPdfPicture(await readFile(join(folder, 'page.pdf')));
  for (const [k, side] of [210, 297].entries()) assert.ok(size[k] < side + 1 && size[k] > side - 12, String(size));
  await command(...fromDepth, '-o', 'page.JPG');
  const jpeg = await readFile(join(folder, 'page.JPG'));
  const flat = direct.readPhoto(jpeg);
  assert.deepEqual([flat.width, flat.height], [wide, tall]);
  // To whole pixels per inch or centimetre.
  assert.ok(Math.abs(Number(jpegDensity(jpeg)) / (wide / size[0]) - 1) < 0.01);
  await command(...fromDepth, '-o', 'page.png', '--unit', 'mm', '--dots', '2000');
  assert.equal(pngDensity(await readFile(join(folder, 'page.png'))), 2000);

  // Heights in whatever unit, and with one.
  await writeFile(join(folder, 'heights.npy'), direct.writeImage({ width: 64, height: 48, data: new Float32Array(64 * 48) }));
  const fromHeights = ['dewarp', 'heights.npy', '--texture', 'photo.png', '-o', 'page.pdf'];
  await refuses(folder, [[fromHeights, /--unit mm/]]);
  await command(...fromHeights, '--pixel-size', '2.5', '--unit', 'mm');
  const page = await readPdfPicture(await readFile(join(folder, 'page.pdf')));
  // But for the last cells of the lattice, which is a hexagonal one.
  assert.ok(page.size[0] > 155 && page.size[0] <= 160 && page.size[1] > 112 && page.size[1] <= 120, String(page.size));
  await refuses(folder, [
    [[...fromHeights, '--pixel-size', '2.5', '--unit', 'm'], /unit of the lengths/, 3],
    [[...fromHeights, '--unit', 'inch'], /--unit must be mm or m/],
  ]);

  // By its edges.
  const line = (/** @type {number} */ y) => [[200, y], [500, y], [800, y]];
  await writeFile(join(folder, 'edges.json'), JSON.stringify({ top: line(100), bottom: line(948.5) }));
  const edges = ['dewarp', 'photo.png', '--edges', 'edges.json', '--focal-length', '1000', '-o'];
  await command(...edges, 'edges.pdf', '--page', 'a4');
  const a4 = await readPdfPicture(await readFile(join(folder, 'edges.pdf')));
  assert.ok(Math.abs(a4.size[0] - 210) < 1 && Math.abs(a4.size[1] - 297) < 1, String(a4.size));
  // Without a format it is on A4, as large as fits.
  await command(...edges, 'edges.pdf');
  assert.deepEqual((await readPdfPicture(await readFile(join(folder, 'edges.pdf')))).size.map(Math.round), [210, 297]);
  await command(...edges, 'edges.jpeg');
  assert.equal(jpegDensity(await readFile(join(folder, 'edges.jpeg'))), undefined);
});
