/** The Node command, told more than heights: confidence, constraints, occlusions. */
import assert from 'node:assert/strict';
import { readFile, readdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { fit } from '../../pkg/index.js';
import { refuses, run, temporaryFolder } from './support/command.mjs';
import { cylinder, deviation, image, lattice, noisy, plane } from './support/shapes.mjs';

await Promise.all([direct.init(), direct.load('files')]);
const folder = await temporaryFolder();
const ramp = image(30, 24, plane);
const step = image(30, 24, (x, y) => plane(x, y) + (x > 15 ? 9 : 0));

/** @param {string} name @param {Parameters<typeof direct.writeImage>[0]} input */
const store = (name, input) => writeFile(join(folder, name), direct.writeImage(input));
/** @param {string} name */
const load = async (name) => direct.read(await readFile(join(folder, name)));
/** Runs a command that has nothing to say but what is expected. @param {string} args @param {string} [expected] */
async function command(args, expected = '') {
  assert.deepEqual(await run(folder, args), { status: 0, stdout: expected, stderr: '' });
}
/** @param {string} args */
async function report(args) {
  await command(`${args} --report r.json`);
  return JSON.parse(await readFile(join(folder, 'r.json'), 'utf8'));
}

test('energies, passes and thresholds reach the solver', async () => {
  await store('step.npy', step);
  const plain = await report('fit step.npy -o out.npy');
  assert.deepEqual([plain.energy, plain.reweighting, plain.occluded], ['huber', 0, 0]);
  assert.equal((await report('fit step.npy -o out.npy --lambda medium')).energy, 'huber');
  const paper = await report('fit step.npy -o out.npy --paper');
  assert.deepEqual([paper.energy, paper.lambda], ['nuclear', 1e6]);
  assert.equal((await report('fit step.npy -o out.npy --energy frobenius')).energy, 'frobenius');
  assert.equal((await report('fit step.npy -o out.npy --energy nuclear --reweighting 2')).reweighting, 2);
  const huber = await report('fit step.npy -o out.npy --energy huber --bend-radius 0.2 --flatness 0.5 --crease-passes 0');
  assert.deepEqual([huber.huber.bendRadius, huber.huber.flatness, huber.huber.creasePasses], [0.2, 0.5, 0]);
  const own = await report('fit step.npy -o out.npy --lambda auto');
  // The heights are multiples of 0.1.
  assert.ok(Math.abs(own.lambdaChoice.step - 0.1) < 1e-9, JSON.stringify(own.lambdaChoice));
  const torn = await report('fit step.npy -o out.npy --occlusion-threshold 150');
  assert.ok(torn.occluded > 20 && torn.objective < 1e-6);
  assert.ok(deviation((await load('out.npy')).data, step.data) < 9.1);
  assert.equal((await report('fit step.npy -o out.npy --occlusion-threshold auto')).occluded, 0);
});

test('occlusions are written as a mask that can be given back', async () => {
  await store('step.npy', step);
  const found = direct.occlusions(step, { threshold: 150 });
  assert.ok(found.image && found.count > 20);
  await command('occlusions step.npy -o mask.png --threshold 150', `${found.count}\n`);
  const png = await load('mask.png');
  assert.deepEqual([png.width, png.height, png.dataType], [30, 24, 'u8']);
  assert.deepEqual([...png.data], [...found.image].map((flag) => 255 * flag));
  await command('occlusions step.npy -o mask.npy --threshold 150', `${found.count}\n`);
  assert.deepEqual([...(await load('mask.npy')).data], [...found.image]);
  await command('occlusions step.npy -o none.png', '0\n');
  assert.ok((await load('none.png')).data.every((level) => level === 0));
  const { occluded, objective } = await report('fit step.npy -o out.npy --occlusions mask.png');
  const plain = await report('fit step.npy -o out.npy');
  assert.ok(occluded > 20 && objective < plain.objective / 5);

  const hex = lattice(24, 30, (x, y) => plane(x, y) + (x > 14.2 ? 6 : 0));
  await store('hex.npy', hex);
  const there = direct.occlusions(hex, { threshold: 100 });
  await command('occlusions hex.npy -o hex.png --lattice hex --threshold 100', `${there.count}\n`);
  assert.deepEqual([...(await load('hex.png')).data], [...there.vertices].map((flag) => 255 * flag));
});

test('a file of confidences: whole numbers are shares of the largest', async () => {
  const spoilt = (/** @type {number} */ i) => i % 30 >= 10 && i % 30 < 16 && i > 240 && i < 450;
  const wide = (/** @type {number} */ i) => [-31, -30, -29, -1, 0, 1, 29, 30, 31].some((by) => spoilt(i + by));
  await store('spoilt.npy', { ...ramp, data: ramp.data.map((z, i) => (spoilt(i) ? 40 * Math.sin(i) : z)) });
  await store('trust.npy', { ...ramp, data: ramp.data.map((_, i) => (wide(i) ? 0 : 1)) });
  await command('fit spoilt.npy -o out.npy --lambda big --confidence trust.npy --pixel-size 1');
  const { data } = await load('out.npy');
  assert.ok(deviation(data, ramp.data) < 0.02, `${deviation(data, ramp.data)}`);
  const whole = direct.writeImage({ ...ramp, data: ramp.data.map((_, i) => (wide(i) ? 0 : 1)) });
  // An array of bytes, which this package does not write.
  const text = "{'descr': '|u1', 'fortran_order': False, 'shape': (24, 30), }".padEnd(117) + '\n';
  const bytes = Buffer.concat([
    Buffer.from(whole.subarray(0, 8)), Buffer.from([118, 0]), Buffer.from(text),
    Buffer.from(ramp.data.map((_, i) => (wide(i) ? 0 : 255))),
  ]);
  await writeFile(join(folder, 'bytes.npy'), bytes);
  await command('fit spoilt.npy -o same.npy --lambda big --confidence bytes.npy --pixel-size 1');
  assert.deepEqual((await load('same.npy')).data, data);
});

test('offsets of whole rows and columns are said to be taken out, unless they are to be left', async () => {
  const shape = cylinder(64);
  /** The offset of each line of a size, from noise that is the same each time. @param {number} amplitude */
  const offsets = (amplitude) => Float64Array.from({ length: 64 }, noisy(() => 0, amplitude));
  const sent = '; --bridge none leaves them';
  for (const [rows, columns, words] of /** @type {[number, number, string][]} */ ([[3, 0, 'rows'], [0, 3, 'columns'], [3, 3, 'rows and columns'], [0, 0, '']])) {
    const [byRow, byColumn] = [offsets(rows), offsets(columns).toReversed()];
    await store('lines.npy', image(64, 64, noisy((x, y) => shape(x, y) + byRow[Math.floor(y)] + byColumn[Math.floor(x)], 0.5)));
    const { status, stderr } = await run(folder, ['fit', 'lines.npy', '-o', 'out.npy', '--pixel-size', '1', '--report', 'r.json']);
    assert.equal(status, 0);
    assert.equal(stderr, words && `developable: ${words} of this input have offsets of their own, which were taken out${sent}\n`);
    const { offsetRows, offsetColumns } = JSON.parse(await readFile(join(folder, 'r.json'), 'utf8')).lambdaChoice;
    assert.deepEqual([offsetRows, offsetColumns], [rows > 0, columns > 0]);
    assert.doesNotMatch((await run(folder, ['fit', 'lines.npy', '-o', 'out.npy', '--pixel-size', '1', '--bridge', 'none'])).stderr, /offsets/);
  }
});

test('every command that fits tells smooth noise that it takes away, since that may be a shape', async () => {
  const rough = Float64Array.from({ length: 70 * 70 }, noisy(() => 0, 1));
  const blur = [1, 4, 6, 4, 1].flatMap((a, i) => [1, 4, 6, 4, 1].map((b, k) => [70 * i + k, (a * b) / 256]));
  const smooth = (/** @type {number} */ x, /** @type {number} */ y) => blur.reduce((sum, [at, weight]) => sum + weight * rough[70 * Math.floor(y) + Math.floor(x) + at], 0);
  await store('smooth.npy', image(64, 64, (x, y) => 0.3 * x + smooth(x, y)));
  for (const args of ['fit smooth.npy -o out.npy', 'analyze smooth.npy', 'patches smooth.npy -o out.json']) {
    const told = /^developable: the surface is without noise of 0\.1\d+, alike over distances of [12][\d.]*, 0\.\d+ from the heights .*--tolerance 0\.2% keeps it\n$/;
    assert.match((await run(folder, args)).stderr, told, args);
  }
});

test('what of a surface is on no sheet is told with its share', async () => {
  const rough = (/** @type {number} */ x, /** @type {number} */ y) => (x > 54 && y > 54 ? 9 * Math.sin(2.1 * x) * Math.cos(1.7 * y) : 0);
  await store('tip.npy', image(60, 60, (x, y) => 20 + 0.2 * x + rough(x, y)));
  const { stderr } = await run(folder, 'pattern tip.npy -o tip.svg --as-is --report r.json');
  const { missing, area } = JSON.parse(await readFile(join(folder, 'r.json'), 'utf8'));
  const [, told, share] = stderr.match(/([\d.]+) mm² of the surface \(([\d.]+) %\) on no sheet/)?.map(Number) ?? [];
  assert.ok(told > 5 && Math.abs(told - missing.area) < 1 && Math.abs(share - (100 * told) / (told + area)) < 0.1, stderr);
});

test('a tolerance is a distance or a share of the height range, in the command and in both APIs', async () => {
  const waves = image(60, 60, (x, y) => 10 + 3 * Math.sin(x / 7) * Math.cos(y / 9));
  await store('waves.npy', waves);
  const range = Math.max(...waves.data) - Math.min(...waves.data);
  for (const [tolerance, distance] of /** @type {[number | `${number}%`, number][]} */ ([['3%', 0.03 * range], [0.1, 0.1]])) {
    const { lambdaChoice, lambda } = await report(`fit waves.npy -o out.npy --tolerance ${tolerance}`);
    assert.equal(lambdaChoice.reason, 'tolerance');
    // The range is that of the vertices, which are between the pixels.
    assert.ok(Math.abs(lambdaChoice.tolerance / distance - 1) < 0.02, JSON.stringify(lambdaChoice));
    for (const { report: own } of [direct.fit(waves, { tolerance }), await fit(waves, { tolerance })]) {
      assert.ok(Math.abs(own.lambda / lambda - 1) < 1e-9, `${own.lambda} ${lambda}`);
    }
  }
  for (const wrong of ['-3', '0', '3 percent', '-2%']) {
    assert.match((await run(folder, ['fit', 'waves.npy', '-o', 'out.npy', `--tolerance=${wrong}`])).stderr, /share.* such as 0\.5%/, wrong);
  }
});

test('a design passes through its constraints', async () => {
  const pins = new Map([32, 57, 662, 687].map((i) => [i, ramp.data[i]]));
  const constraints = { ...ramp, data: ramp.data.map((_, i) => pins.get(i) ?? 0) };
  await store('pins.npy', constraints);
  const { constrained } = await report('design pins.npy -o out.npy --free 0 --height-scale 2');
  assert.equal(constrained, 4);
  const { data } = await load('out.npy');
  // The vertices are up to half a pixel from the pixels.
  assert.ok(deviation(data, ramp.data.map((z) => 2 * z)) < 0.7, `${deviation(data, ramp.data.map((z) => 2 * z))}`);
  await store('nan.npy', { ...constraints, data: constraints.data.map((z) => z || NaN) });
  await command('design nan.npy -o same.npy --height-scale 2');
  assert.deepEqual((await load('same.npy')).data, data);
  await command('design pins.npy -o out.obj --free 0');
  const vertices = [...(await readFile(join(folder, 'out.obj'), 'utf8')).matchAll(/^v /gm)];
  assert.ok(vertices.length > 24 * 30 * 0.9);
  // On the lattice they are met where they are.
  const hex = lattice(12, 14, plane);
  await store('hex.npy', { ...hex, heights: hex.heights.map((z, i) => ([15, 26, 143].includes(i) ? z : 0)) });
  await command('design hex.npy -o out.npy --lattice hex --free 0');
  assert.ok(deviation((await load('out.npy')).data, hex.heights) < 1e-5);
});

test('constraints besides heights, and what is wrong with either', async () => {
  await store('ramp.npy', ramp);
  await store('pin.npy', { ...ramp, data: ramp.data.map((z, i) => (i === 375 ? z + 4 : -1)) });
  const { constrained } = await report('fit ramp.npy -o out.npy --constraints pin.npy --free -1 --lambda big');
  assert.equal(constrained, 1);
  const moved = (await load('out.npy')).data.map((z, i) => z - ramp.data[i]);
  assert.ok(moved[375] > 2 && Math.abs(moved[0]) < 0.1);
  await writeFile(join(folder, 'kept.npy'), 'kept');
  await refuses(folder, [
    ['design pin.npy -o kept.npy --free -1', /not held in place/, 3],
    ['design pin.npy -o kept.npy', /--free V/, 3],
  ]);
  assert.equal(await readFile(join(folder, 'kept.npy'), 'utf8'), 'kept');
  assert.ok(!(await readdir(folder)).some((name) => name.endsWith('.tmp')));
});
