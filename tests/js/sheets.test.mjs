/** Surfaces measured, laid flat, and photos of them made flat, directly and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { refuses, run, silent, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { lattice } from './support/shapes.mjs';

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

test('they have a wasm of their own', async () => {
  assert.throws(() => direct.unroll(page), error('NOT_INITIALIZED', /load\('unroll'\)/));
  await Promise.all([direct.init(), direct.load('files', 'unroll')]);
});

test('analysis of images and of surfaces', () => {
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
  assert.throws(() => direct.analyze(page, { threshold: 0 }), error('OPTION', /threshold/));
  assert.throws(() => direct.analyze(surface, { spacing: 2 }), error('OPTION', /spacing/));
  assert.throws(() => direct.dewarp(page, /** @type {any} */ ({ width: 2 })), error('INPUT', /photo/));
  assert.throws(() => direct.dewarp(page, { ...photo, width: 3 }), error('SHAPE'));
  assert.throws(() => direct.patches(page, { fold: 0 }), error('OPTION', /fold/));
  assert.throws(() => direct.rulings(page, { separation: -1 }), error('OPTION', /separation/));
});

test('photos from and to files', () => {
  const bytes = direct.writePhoto(photo);
  assert.deepEqual(direct.readPhoto(bytes), { ...photo, assumptions: [] });
});

test('the commands', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'scan.npy'), direct.writeImage(page));
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(photo));
  const json = async (/** @type {string} */ name) => JSON.parse(await readFile(join(folder, name), 'utf8'));

  assert.deepEqual(await run(folder, 'analyze scan.npy -o figures.json --threshold 0.5 --lambda big'), silent);
  const { input, output, deviation } = await json('figures.json');
  assert.ok(input.threshold === 0.5 && output.vertices === input.vertices && deviation.rms < 1);
  assert.deepEqual(await run(folder, 'analyze scan.npy -o figures.json --as-is'), silent);
  assert.deepEqual(Object.keys(await json('figures.json')), ['input']);

  assert.deepEqual(await run(folder, 'unroll scan.npy -o sheet.obj --lambda big --report report.json'), silent);
  const obj = await readFile(join(folder, 'sheet.obj'), 'utf8');
  const report = await json('report.json');
  assert.ok(report.verdict === 'unrolled' && report.distortion.rms < 0.01);
  assert.deepEqual(await run(folder, 'unroll scan.npy -o sheet.json --as-is'), silent);
  const sheet = await json('sheet.json');
  assert.equal(obj.match(/^v /gm)?.length, sheet.vertices.length);
  assert.equal(obj.match(/^f /gm)?.length, sheet.triangles.length / 3);

  const fitted = await run(folder, 'dewarp scan.npy --texture photo.png -o flat.png --trim --map map.npy');
  assert.match(fitted.stderr, /^developable: this input has no noise, so the surface keeps to its heights, but for 0\.00\d+ .*\n$/);
  const flat = direct.readPhoto(await readFile(join(folder, 'flat.png')));
  const map = await readFile(join(folder, 'map.npy'));
  assert.ok(map.toString('latin1', 0, 128).includes(`(${flat.height}, ${flat.width}, 2)`));
  assert.equal((map.length - 8 * flat.width * flat.height) % 64, 0);
  assert.deepEqual(await run(folder, 'dewarp scan.npy --texture photo.png -o f.png --as-is --dots 1 --map map.json'), silent);
  const places = await json('map.json');
  assert.equal(places.places.length, places.columns * places.rows);
  assert.ok(places.error.maximum <= 0.25 && places.unit === null, JSON.stringify(places.error));
  assert.equal(places.resolution, 1);

  await refuses(folder, [
    ['dewarp scan.npy -o f.png', /--texture PHOTO/],
    ['dewarp scan.npy --texture photo.png -o photo.png', /same file/],
    ['unroll scan.npy -o sheet.png', /\.obj or \.json/],
    ['fit scan.npy -o a.npy --trim', /--trim is not for "fit"/],
    ['dewarp scan.npy --texture photo.png -o f.png --dots -1', /--dots is -1/],
  ]);
});
