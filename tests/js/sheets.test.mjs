/** Surfaces measured, laid flat, and photos of them made flat; directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { run, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { lattice } from './support/shapes.mjs';

after(() => developable.dispose());

const [width, height, radius] = [80, 60, 50];

/** A page curled about an upright axis, in pixels. */
const page = {
  width,
  height,
  data: Float64Array.from({ length: width * height }, (_, i) =>
    Math.sqrt(radius ** 2 - ((i % width) + 0.5 - width / 2) ** 2)),
};

/** Twice as fine, red from left to right. */
const photo = {
  width: 2 * width,
  height: 2 * height,
  data: Uint8ClampedArray.from({ length: 16 * width * height }, (_, i) =>
    (i % 4 === 0 ? (i / 4) % (2 * width) : i % 4 === 3 ? 255 : 40)),
};

/** Where on the page a place is that is seen at `x`. @param {number} x */
const onPage = (x) => radius * Math.asin((x - width / 2) / radius);

test('they have a wasm of their own', async () => {
  assert.throws(() => direct.unroll(page), error('NOT_INITIALIZED', /load\('unroll'\)/));
  await Promise.all([direct.init(), direct.load('files', 'unroll')]);
});

test('analysis of images and of surfaces', async () => {
  const tube = lattice(60, 80, (x) => Math.sqrt(radius ** 2 - (x - width / 2) ** 2));
  const { summary, gaussian, kappa1, rows, cols } = direct.analyze(tube);
  assert.equal(gaussian.length, rows * cols);
  assert.ok(summary.medianGaussian < 1e-3 && summary.medianKappa2 < 1e-3, JSON.stringify(summary));
  // At the crown the curvature is one over the radius.
  const crown = kappa1[Math.floor(rows / 2) * cols + width / 2];
  assert.ok(Math.abs(crown * radius + 1) < 0.01, String(crown));
  const surface = direct.fit(page, { lambda: 'big' });
  const compared = direct.analyze(surface, { reference: page, threshold: 2 });
  assert.ok(compared.deviation && compared.deviation.rms > 0 && compared.deviation.maximum < 0.5);
  assert.equal(compared.summary.threshold, 2);
  assert.deepEqual(await developable.analyze(surface, { reference: page, threshold: 2 }), compared);
  assert.throws(() => direct.analyze(page, { threshold: 0 }), error('OPTION', /threshold/));
  assert.throws(() => direct.analyze(surface, { spacing: 2 }), error('OPTION', /spacing/));
});

test('a sheet is as wide as the arc', async () => {
  const sheet = direct.unroll(page);
  const { places, positions, vertices, triangles, stretches, report, verdict } = sheet;
  assert.equal(places.length, 2 * vertices.length);
  assert.equal(positions.length, 3 * vertices.length);
  assert.equal(stretches.length, (2 * triangles.length) / 3);
  for (let i = 0; i < vertices.length; i += 97) {
    const off = places[2 * i] - width / 2 - onPage(positions[3 * i]);
    assert.ok(Math.abs(off - (places[0] - width / 2 - onPage(positions[0]))) < 0.05, `${i}: ${off}`);
  }
  assert.ok(report.distortion.rms < 1e-3 && report.distortion.flipped === 0 && report.crossings === 0);
  assert.equal(verdict, 'unrolled');
  assert.deepEqual(await developable.unroll(page), sheet);
  assert.equal(direct.unroll({ width: 20, height: 20, data: new Float32Array(400) }).verdict, 'flat');
  assert.throws(() => direct.unroll(page, /** @type {any} */ ({ tolerances: 1 })), error('OPTION', /tolerances/));
});

test('a photo is stretched to the page', async () => {
  const flat = direct.dewarp(page, photo, { trim: true });
  assert.equal(flat.resolution, 2);
  assert.equal(flat.data.length, 4 * flat.width * flat.height);
  assert.equal(flat.map.length, 2 * flat.width * flat.height);
  const arc = onPage(width - 1) - onPage(1);
  assert.ok(Math.abs(flat.width / 2 - arc) < 4, `${flat.width / 2} ${arc}`);
  const middle = Math.floor(flat.height / 2) * flat.width;
  for (let col = 3; col < flat.width - 3; col += 7) {
    const red = flat.data[4 * (middle + col)];
    assert.ok(Math.abs(red - flat.map[2 * (middle + col)]) <= 1, `${red} ${flat.map[2 * (middle + col)]}`);
    assert.equal(flat.data[4 * (middle + col) + 3], 255);
    // From the photo to the page and back.
    const x = (flat.map[2 * (middle + col)] + 0.5) / 2;
    const u = flat.corner[0] + (col + 0.5) / 2 - width / 2;
    assert.ok(Math.abs(u - onPage(x)) < 0.6, `${u} ${onPage(x)}`);
  }
  assert.deepEqual(await developable.dewarp(page, photo, { trim: true }), flat);
  const surface = direct.fit(page, { lambda: 'big' });
  const fitted = direct.dewarp(surface, photo, { dots: 1 });
  assert.ok(Math.abs(fitted.width - arc) < 4);
  assert.throws(() => direct.dewarp(page, /** @type {any} */ ({ width: 2 })), error('INPUT', /photo/));
  assert.throws(() => direct.dewarp(page, { ...photo, width: 3 }), error('SHAPE'));
});

test('patches of a folded sheet', async () => {
  const folded = lattice(60, 60, (x) => 0.6 * Math.abs(x - 30.2));
  const found = direct.patches(folded);
  assert.equal(found.patches.length, 2);
  assert.equal(found.labels.length, 3600);
  assert.notEqual(found.labels[1800], found.labels[1859]);
  const [{ fold, points, patches }] = found.creases;
  assert.ok(Math.abs(fold - 2 * Math.atan(0.6)) < 0.03, String(fold));
  assert.ok(points.length > 50 && points.every((point) => point.length === 3));
  assert.deepEqual(patches, [0, 1]);
  assert.deepEqual(await developable.patches(folded), found);
  assert.throws(() => direct.patches(folded, { fold: 0 }), error('OPTION', /fold/));
});

test('rulings of a tube', async () => {
  const tube = lattice(60, 80, (x) => Math.sqrt(radius ** 2 - (x - width / 2) ** 2));
  const found = direct.rulings(tube, { separation: 8 });
  const middle = 2 * (30 * 80 + 40);
  assert.ok(Math.abs(found.directions[middle]) < 0.01, 'upright');
  assert.ok(found.lines.length > 5 && found.lines.every(({ deviation }) => deviation < 0.01));
  assert.deepEqual(await developable.rulings(tube, { separation: 8 }), found);
  assert.throws(() => direct.rulings(tube, { separation: -1 }), error('OPTION', /separation/));
});

test('photos from and to files', async () => {
  const bytes = direct.writePhoto(photo);
  assert.deepEqual(direct.readPhoto(bytes), { ...photo, assumptions: [] });
  assert.deepEqual(await developable.readPhoto(bytes), { ...photo, assumptions: [] });
  assert.deepEqual(await developable.writePhoto(photo), bytes);
});

test('the commands', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'scan.npy'), direct.writeImage(page));
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(photo));
  const json = async (/** @type {string} */ name) => JSON.parse(await readFile(join(folder, name), 'utf8'));
  const silent = { status: 0, stdout: '', stderr: '' };
  /** @param {string} args */
  const command = (args) => run(folder, args.split(' '));

  assert.deepEqual(await command('analyze scan.npy -o figures.json --threshold 0.5 --lambda big'), silent);
  const { input, output, deviation } = await json('figures.json');
  assert.ok(input.threshold === 0.5 && output.vertices === input.vertices && deviation.rms < 1);
  assert.deepEqual(await command('analyze scan.npy -o figures.json --as-is'), silent);
  assert.deepEqual(Object.keys(await json('figures.json')), ['input']);

  assert.deepEqual(await command('unroll scan.npy -o sheet.obj --lambda big --report report.json'), silent);
  const obj = await readFile(join(folder, 'sheet.obj'), 'utf8');
  const report = await json('report.json');
  assert.ok(report.verdict === 'unrolled' && report.distortion.rms < 0.01);
  assert.deepEqual(await command('unroll scan.npy -o sheet.json --as-is'), silent);
  const sheet = await json('sheet.json');
  assert.equal(obj.match(/^v /gm)?.length, sheet.vertices.length);
  assert.equal(obj.match(/^f /gm)?.length, sheet.triangles.length / 3);

  assert.deepEqual(await command('dewarp scan.npy --texture photo.png -o flat.png --trim --map map.npy'), silent);
  const flat = direct.readPhoto(await readFile(join(folder, 'flat.png')));
  const map = await readFile(join(folder, 'map.npy'));
  assert.ok(map.toString('latin1', 0, 128).includes(`(${flat.height}, ${flat.width}, 2)`));
  assert.equal((map.length - 8 * flat.width * flat.height) % 64, 0);
  assert.deepEqual(await command('dewarp scan.npy --texture photo.png -o f.png --as-is --dots 1 --map map.json'), silent);
  const places = await json('map.json');
  assert.equal(places.places.length, places.columns * places.rows);
  assert.ok(places.error.maximum <= 0.25 && places.unit === null, JSON.stringify(places.error));
  assert.equal(places.resolution, 1);

  for (const [args, message] of [
    ['dewarp scan.npy -o f.png', /--texture PHOTO/],
    ['dewarp scan.npy --texture photo.png -o photo.png', /same file/],
    ['unroll scan.npy -o sheet.png', /\.obj or \.json/],
    ['fit scan.npy -o a.npy --trim', /--trim is not for "fit"/],
    ['dewarp scan.npy --texture photo.png -o f.png --dots -1', /--dots is -1/],
  ]) {
    const { status, stderr } = await command(/** @type {string} */ (args));
    assert.equal(status, 2, stderr);
    assert.match(stderr, /** @type {RegExp} */ (message));
  }
});
