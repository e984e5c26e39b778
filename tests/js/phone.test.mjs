/** A phone's depths and photo of a page: directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { normal, smoothNoise } from '../../tools/bench/phone/sensor.mjs';
import { refuses, run, succeeds, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { withExif } from './support/exif.mjs';
import { expanded, readNpyMap } from './support/maps.mjs';
import { depthCamera, depths, displacement, meets, photo, photoCamera } from './support/phone.mjs';

after(() => developable.dispose());
await Promise.all([direct.init(), direct.load('files', 'images', 'meshes', 'unroll')]);

const { width, height, ...numbers } = depthCamera;
const picture = photo(photoCamera);
const seen = direct.sampleMesh(direct.backProject(depths(), numbers), { view: 'best-fit' });

/** The warp map that the command has written. @param {string} folder */
async function mapIn(folder) {
  const file = JSON.parse(await readFile(join(folder, 'map.json'), 'utf8'));
  return { ...file, map: expanded(file) };
}

/** The place in the photo of what lies at shares of the page's width and height. @param {number} s @param {number} t */
function seenAt(s, t) {
  let best = [Infinity, 0, 0];
  for (let row = 0; row < photoCamera.height; row += 2) {
    for (let col = 0; col < photoCamera.width; col += 2) {
      const found = meets(photoCamera, col, row);
      const off = found ? Math.hypot(found[1] / 0.21 + 0.5 - s, found[2] / 0.297 + 0.5 - t) : Infinity;
      if (off < best[0]) best = [off, col, row];
    }
  }
  return /** @type {[number, number]} */ (best.slice(1));
}

/** The corners of what lies between two shares of both. @param {number} low @param {number} high */
const cornersAt = (low, high) => [seenAt(low, low), seenAt(high, low), seenAt(high, high), seenAt(low, high)];

test('what cannot be is refused in plain words', () => {
  const { camera, uvs, ...bare } = seen;
  assert.throws(() => direct.dewarp(bare, picture), error('INPUT', /nothing says where in the photo/));
  const upright = { width: picture.height, height: picture.width, data: picture.data };
  assert.throws(() => direct.dewarp(seen, upright), error('UNSUPPORTED', /lies on its side/));
  const wide = { width: 160, height: 90, data: new Uint8ClampedArray(4 * 160 * 90) };
  assert.throws(() => direct.dewarp(seen, wide), error('UNSUPPORTED', /another part of the scene/));
  assert.throws(() => direct.backProject(depths(), { ...numbers, cx: 960, cy: 720 }), error('OPTION', /images of another size/));
  assert.throws(() => direct.dewarp(seen, picture, { camera: /** @type {any} */ ({ ...photoCamera, extent: 3 }) }), error('OPTION', /extent/));
  assert.throws(() => direct.dewarp(seen, picture, { camera: photoCamera, extent: [0, 0, 1, 1] }), error('OPTION', /leave it or `camera` out/));
  const heights = { width: 20, height: 20, data: new Float64Array(400) };
  assert.throws(() => direct.dewarp(heights, picture, { camera: photoCamera }), error('OPTION', /backProject/));
  const rotation = [[1, 0, 0], [0, 1, 0], [0, 0, -1]];
  assert.throws(() => direct.dewarp(seen, picture, { camera: { ...photoCamera, rotation: /** @type {any} */ (rotation) } }), error('OPTION', /rotation/));
});

test('the command takes what capture apps write', async () => {
  const folder = await temporaryFolder();
  const { data } = depths();
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(picture));
  await writeFile(join(folder, 'depth.exr'), direct.writeImage({ width, height, data }, { format: 'exr' }));
  // A matrix for the photo, and numbers for the depths.
  await writeFile(join(folder, 'camera_matrix.csv'), '1025.0, 0.0, 632.0\n0.0, 1025.0, 487.0\n0.0, 0.0, 1.0\n');
  await writeFile(join(folder, 'transforms.json'), JSON.stringify({ fl_x: 205, fl_y: 205, cx: 126, cy: 97, w: 256, h: 192, k1: 0 }));
  const common = ['--texture', 'photo.png', '--view', 'best-fit', '--lambda', 'big', '--dots', '1000'];
  await succeeds(folder, ['dewarp', 'depth.exr', '--intrinsics', 'camera_matrix.csv', ...common, '-o', 'page.png', '--map', 'map.json']);
  const found = displacement(photoCamera, await mapIn(folder));
  assert.ok(found < 0.003, String(found));
  // In full and on a grid.
  const full = await succeeds(folder, [
    'dewarp', 'depth.exr', '--intrinsics', 'transforms.json', ...common, '-o', 'page.png', '--map', 'map.npy',
  ]);
  const [flat, bytes] = [await mapIn(folder), await readFile(join(folder, 'map.npy'))];
  const { map, ...size } = readNpyMap(bytes);
  const { width: wide, height: tall, places, error: stated } = flat;
  assert.deepEqual({ width: wide, height: tall }, size);
  assert.deepEqual([flat.unit, flat.photo, places.length], ['m', { width: 1280, height: 960 }, flat.columns * flat.rows]);
  assert.ok(places.length < 5000, String(places.length));
  let largest = 0;
  for (let i = 0; i < map.length; i += 2) {
    if (!Number.isNaN(map[i])) largest = Math.max(largest, Math.hypot(map[i] - flat.map[i], map[i + 1] - flat.map[i + 1]));
  }
  // The grid is refined by a sample of the pixels, and what it states is measured at all of them.
  assert.ok(largest <= 0.26 && Math.abs(largest - stated.maximum) < 0.002 && stated.rms < stated.maximum, `${largest} ${stated.maximum}`);
  assert.doesNotMatch(full.stderr, /rim/);
  // With the table around it, at the page's own height, it is no page that is made flat, and that is said.
  await writeFile(join(folder, 'table.exr'), direct.writeImage({ width, height, data: data.map((depth) => depth || 0.44) }, { format: 'exr' }));
  const table = ['dewarp', 'table.exr', '--intrinsics', 'transforms.json', ...common, '-o', 'page.png'];
  const all = await succeeds(folder, table);
  assert.match(all.stderr, /the whole depth image was flattened.*--crop/);
  const cropped = [...table, '--crop', cornersAt(0.1, 0.9).join(), '--report', 'report.json'];
  const loss = async () => JSON.parse(await readFile(join(folder, 'report.json'), 'utf8')).loss;
  assert.doesNotMatch((await run(folder, cropped)).stderr, /rim|missing/);
  assert.ok((await loss()) < 0.015, String(await loss()));
  // A quarter of the page is covered, and a part of that is within the 6 % by which the sheet is continued.
  const covered = data.map((depth, i) => (i % width < 126 && i < 97 * width ? 0 : depth || 0.44));
  await writeFile(join(folder, 'table.exr'), direct.writeImage({ width, height, data: covered }, { format: 'exr' }));
  assert.match((await run(folder, [...cropped, '--trim'])).stderr, /\d\d % of the page between the corners of --crop is missing/);
  assert.ok((await loss()) > 0.13 && (await loss()) < 0.25, String(await loss()));
  // The wrong file, and depths that are taken for heights.
  await writeFile(join(folder, 'other.json'), JSON.stringify({ name: 'a phone' }));
  await refuses(folder, [[['dewarp', 'depth.exr', '--intrinsics', 'other.json', ...common, '-o', 'page.png'], /other\.json: there is no camera in it/, 3]]);
  const heights = await run(folder, ['dewarp', 'depth.exr', '--no-data', '0', '--texture', 'photo.png', '-o', 'page.png']);
  assert.match(heights.stderr, /assumed: pixels are .* wide: .*too flat \(are these depths of a camera\?\) \(--pixel-size decides it\)/);
});

test('a curled page is a cylinder, found more exactly than any surface, and a dented one is none', async () => {
  const { data } = depths();
  const noise = smoothNoise(width, height, 2, normal(3));
  const noisy = { width, height, data: data.map((depth, i) => depth && depth + 0.002 * noise[i]) };
  const field = direct.sampleMesh(direct.backProject(noisy, numbers), { view: 'best-fit' });
  const cylinder = direct.fitCylinder(field);
  assert.deepEqual([cylinder.camera, cylinder.uvs, cylinder.unit], [field.camera, field.uvs, field.unit]);
  const { verdict, rulings, residual } = cylinder.report;
  assert.equal(verdict, 'cylinder', JSON.stringify(cylinder.report));
  assert.ok(Math.abs(Math.hypot(...rulings) - 1) < 1e-12 && residual > 0.001 && residual < 0.003, JSON.stringify(cylinder.report));
  assert.throws(() => direct.fitCylinder(/** @type {any} */ ({ width: 2, height: 2, data: [1, 2, 3, 4] })), error('INPUT', /on the lattice/));
  const held = { ...field, constraints: field.heights };
  assert.throws(() => direct.fitCylinder(held), error('INPUT', /constraints: leave them out/));
  await assert.rejects(developable.fitCylinder(held), error('INPUT', /constraints: leave them out/));

  const folder = await temporaryFolder();
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(picture));
  await writeFile(join(folder, 'depth.exr'), direct.writeImage(noisy, { format: 'exr' }));
  const dent = data.map((depth, i) => depth && depth + 0.006 * Math.exp(-(((i % width) - 120) ** 2 + (Math.floor(i / width) - 100) ** 2) / 800));
  await writeFile(join(folder, 'dented.exr'), direct.writeImage({ width, height, data: dent }, { format: 'exr' }));
  /** @param {string} file @param {...string} more */
  const dewarped = async (file, ...more) => {
    const done = await run(folder, [
      'dewarp', file, '--intrinsics', '205,205,126,97', '--texture', 'photo.png', '-o', 'page.png', '--report', 'page.json', '--dots', '500', ...more,
    ]);
    return { ...done, report: done.status === 0 ? JSON.parse(await readFile(join(folder, 'page.json'), 'utf8')) : undefined };
  };
  const [byItself, other, minimised, dented, forced, wrong, unfitted] = [
    await dewarped('depth.exr'), await dewarped('depth.exr', '--shape', 'developable'), await dewarped('depth.exr', '--lambda', 'medium'),
    await dewarped('dented.exr'), await dewarped('dented.exr', '--shape', 'cylinder'), await dewarped('depth.exr', '--shape', 'cone'),
    await dewarped('depth.exr', '--shape', 'cylinder', '--as-is'),
  ];
  assert.equal(byItself.report?.cylinder?.verdict, 'cylinder', byItself.stderr);
  assert.ok(byItself.report.distortion.rms < 1e-3 && byItself.report.verdict === 'unrolled', JSON.stringify(byItself.report));
  for (const { status, report, stderr } of [other, minimised, dented]) assert.deepEqual([status, report?.cylinder], [0, undefined], stderr);
  assert.deepEqual([forced.status, forced.report?.cylinder?.verdict], [0, 'other'], forced.stderr);
  assert.match(forced.stderr, /warning: the heights are not those of a cylinder/);
  assert.equal(wrong.status, 2);
  assert.match(wrong.stderr, /--shape must be auto, cylinder or developable, but is "cone"/);
  assert.match(unfitted.stderr, /--as-is takes the heights without a fit/);
});

test('a part of the photo, with straight edges, and no table beside it', async () => {
  const folder = await temporaryFolder();
  // A table behind the page, as a depth camera sees it.
  const { data } = depths();
  await writeFile(join(folder, 'depth.exr'), direct.writeImage({ width, height, data: data.map((depth) => depth || 0.55) }, { format: 'exr' }));
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(picture));
  const corners = cornersAt(0.1, 0.9);
  const command = (/** @type {string[]} */ ...args) => succeeds(folder, [
    'dewarp', 'depth.exr', '--intrinsics', '205,205,126,97', '--texture', 'photo.png', '--view', 'best-fit', '--lambda', 'big',
    '--crop', corners.join(), '-o', 'page.png', '--map', 'map.json', ...args,
  ]);
  // As a rectangle: eight tenths of the page, in metres, less what straight chords in the photo cut off its bent edges.
  await command('--trim', '--deskew', '--report', 'report.json');
  const page = await mapIn(folder);
  assert.ok(!page.map.includes(NaN));
  const size = [page.width / page.resolution / 0.21, page.height / page.resolution / 0.297];
  assert.ok(Math.abs(size[0] / 0.8 - 1) < 0.012 && size[1] > 0.75 && size[1] < 0.81, String(size));
  assert.ok(displacement(photoCamera, page) < 0.004);
  const image = direct.readPhoto(await readFile(join(folder, 'page.png')));
  assert.ok(image.data.every((value, i) => i % 4 < 3 || value === 255));
  const { parts } = JSON.parse(await readFile(join(folder, 'report.json'), 'utf8'));
  assert.equal(parts, 1);
  assert.throws(() => direct.dewarp(seen, picture, { crop: [[0, 0], [1, 1]] }), error('OPTION', /three or more corners/));
  assert.throws(() => direct.dewarp(seen, picture, { crop: [[0, 0], [1, 0], [0, 1]] }), error('UNSUPPORTED', /nothing of the sheet lies within/));
});

/** ARKit's levels for depths, row by row: from the right 0, a strip that is 1, the rest 2. @param {number} i */
const level = (i) => {
  const col = i % width;
  return col < 130 ? 2 : col < 140 ? 1 : 0;
};

test('confidences and masks of depths, of any size', () => {
  const levels = { width, height, data: Uint8Array.from({ length: width * height }, (_, i) => level(i)) };
  const plain = direct.backProject(depths(), numbers);
  const trusted = direct.backProject(depths(), numbers, { confidence: levels });
  assert.deepEqual([...new Set(trusted.confidence)].sort(), [0, 0.25, 1]);
  const columns = (/** @type {import('../../pkg/index.js').Mesh} */ mesh) =>
    Math.max(...Array.from(mesh.triangles, (vertex) => vertex % width));
  assert.equal(columns(trusted), 139);
  assert.ok(columns(plain) > 150);
  // Twice as fine they say the same; shares of 255, and factors, likewise.
  const fine = { width: 2 * width, height: 2 * height, data: Uint8Array.from({ length: 4 * width * height }, (_, i) =>
    level(Math.floor(i / 4 / width) * width + ((i % (2 * width)) >> 1))) };
  assert.deepEqual(direct.backProject(depths(), numbers, { confidence: fine }), trusted);
  const shares = direct.backProject(depths(), numbers, { confidence: { ...levels, data: levels.data.map((v) => 127 * v) } });
  assert.ok(Math.abs((shares.confidence?.[0] ?? 0) - 254 / 255) < 1e-6);
  const factors = { ...levels, data: Float32Array.from(levels.data, (v) => [0, 0.25, 1][v]) };
  assert.deepEqual(direct.backProject(depths(), numbers, { confidence: factors }), trusted);
  // They go along to the fit: heights of little weight move it less.
  const view = direct.sampleMesh(trusted, { view: '-z' });
  const weights = new Set(Array.from(view.confidence ?? []).filter((value) => !Number.isNaN(value)));
  assert.ok(weights.has(1) && weights.has(0.25) && ![...weights].some((weight) => weight < 0.2499), String([...weights].slice(0, 5)));
  const doubtful = (/** @type {number} */ i) => Number(view.confidence?.[i]) < 0.3;
  const heights = view.heights.map((height, i) => height + (doubtful(i) ? 0.002 * Math.sin(7919 * i) : 0));
  const { confidence, ...bare } = view;
  const off = (/** @type {Float64Array} */ found) => found.reduce((sum, height, i) =>
    sum + (Number.isNaN(height) || !doubtful(i) ? 0 : (height - view.heights[i]) ** 2), 0);
  const weighed = off(direct.fit({ ...view, heights }, { lambda: 'big' }).heights);
  const equal = off(direct.fit({ ...bare, heights }, { lambda: 'big' }).heights);
  assert.ok(weighed < 0.8 * equal, `${weighed} ${equal}`);

  // A mask as it is drawn on the photo: its left half.
  const half = { width: 640, height: 480, data: Uint8Array.from({ length: 640 * 480 }, (_, i) => Number(i % 640 < 320)) };
  assert.equal(columns(direct.backProject(depths(), numbers, { mask: half })), 127);
  // Seen by a camera 5 cm to the right, at 0.43 m and f = 205 all is some 24 pixels of the depths farther to the left.
  const aside = { ...photoCamera, translation: /** @type {const} */ ([-0.05, 0, 0]) };
  const last = columns(direct.backProject(depths(), numbers, { mask: half, camera: aside }));
  assert.ok(last > 127 + 18 && last < 127 + 32, String(last));
  // Of a part of the photo.
  const crop = /** @type {const} */ ([[0, 0], [639.5, 0], [639.5, 960], [0, 960]]);
  assert.equal(columns(direct.backProject(depths(), numbers, { crop, photo: picture })), 127);

  const given = (/** @type {object} */ options, pattern = /./, code = 'INPUT') =>
    assert.throws(() => direct.backProject(depths(), numbers, options), error(code, pattern));
  given({ crop }, /photo/, 'OPTION');
  given({ mask: { ...half, width: 480, height: 640 } }, /proportions/, 'UNSUPPORTED');
  given({ confidence: { ...levels, width: 3 } }, /3 × 192 pixels/, 'SHAPE');
  given({ confidence: { ...factors, data: factors.data.map((v) => 5 * v) } }, /from 0 to 1/);
  given({ mask: 3 }, /width of the mask/);
  given({ trust: half }, /trust/, 'OPTION');
});

test('the command takes confidences and masks with depths', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'depth.exr'), direct.writeImage({ width, height, data: depths().data }, { format: 'exr' }));
  const grey = (/** @type {number} */ cols, /** @type {number} */ rows, /** @type {(i: number) => number} */ value) =>
    direct.writePhoto({
      width: cols, height: rows, data: Uint8ClampedArray.from({ length: 4 * cols * rows }, (_, i) => (i % 4 === 3 ? 255 : value(i >> 2))),
    });
  await writeFile(join(folder, 'confidence.png'), grey(width, height, level));
  await writeFile(join(folder, 'mask.png'), grey(640, 480, (i) => (i % 640 < 320 ? 255 : 0)));
  const common = ['fit', 'depth.exr', '--intrinsics', '205,205,126,97', '--lambda', 'big', '-o', 'page.ply'];
  /** Extents to the right, in metres. @type {(args: string[]) => Promise<number>} */
  const right = async (args) => {
    await succeeds(folder, [...common, ...args]);
    const { positions } = direct.readMesh(await readFile(join(folder, 'page.ply')));
    return Math.max(...positions.filter((_, i) => i % 3 === 0));
  };
  const [all, trusted, masked] = [await right([]), await right(['--confidence', 'confidence.png']), await right(['--mask', 'mask.png'])];
  // Columns 139 and 127 of the depths, at some 0.45 m.
  assert.ok(masked < 0.01 && trusted > 0.022 && trusted < 0.045 && all > 0.08, `${all} ${trusted} ${masked}`);
});

/** Pixels turned by 90 degrees clockwise. @param {{ width: number, height: number, data: Uint8ClampedArray }} image */
function onItsSide({ width: wide, height: tall, data }) {
  const turned = new Uint8ClampedArray(data.length);
  for (let i = 0; i < wide * tall; i += 1) {
    const [col, row] = [i % wide, Math.floor(i / wide)];
    turned.set(data.subarray(4 * i, 4 * i + 4), 4 * (col * tall + tall - 1 - row));
  }
  return { width: tall, height: wide, data: turned };
}

test('depths that lie as the sensor does, and a photo that was turned', async () => {
  const folder = await temporaryFolder();
  const jpeg = direct.writePhoto(picture, { format: 'jpeg', quality: 95 });
  await writeFile(join(folder, 'depth.exr'), direct.writeImage({ width, height, data: depths().data }, { format: 'exr' }));
  await writeFile(join(folder, 'upright.jpg'), withExif(jpeg, { orientation: 6 }));
  await writeFile(join(folder, 'bare.jpg'), direct.writePhoto(onItsSide(picture), { format: 'jpeg', quality: 95 }));
  await writeFile(join(folder, 'over.jpg'), withExif(jpeg, { orientation: 3 }));
  await writeFile(join(folder, 'camera.json'), JSON.stringify(photoCamera));
  assert.deepEqual(direct.readPhoto(withExif(jpeg, { orientation: 6 })).orientation, 6);
  assert.equal(direct.readPhoto(jpeg).orientation, undefined);
  /** @param {string[]} args */
  const command = (...args) => run(folder, [
    'dewarp', 'depth.exr', '--view', 'best-fit', '--lambda', 'big', '--dots', '1500', '-o', 'page.png', '--map', 'map.json', ...args,
  ]);
  // What a pixel of the turned photo shows, by where it was before.
  for (const args of [
    ['--texture', 'upright.jpg', '--intrinsics', 'camera.json'],
    ['--texture', 'upright.jpg', '--intrinsics', '205,205,126,97'],
    ['--texture', 'bare.jpg', '--intrinsics', 'camera.json', '--turn', '90'],
  ]) {
    const done = await command(...args);
    assert.equal(done.status, 0, done.stderr);
    // Where the sensor saw nothing, its file has zeros.
    assert.match(done.stderr, /^developable: depth\.exr: assumed: 0 is no data \(38719 pixels\) .*\n$/);
    const flat = await mapIn(folder);
    assert.ok(flat.width > flat.height, 'as the photo lies');
    // Back from the photo as it was turned to the one as it was stored.
    const map = flat.map.map((/** @type {number} */ _, /** @type {number} */ i) =>
      (i % 2 === 0 ? flat.map[i + 1] : 959 - flat.map[i - 1]));
    const found = displacement(photoCamera, { ...flat, map });
    assert.ok(found < 0.004, `${args}: ${found}`);
  }
  const refused = await command('--texture', 'bare.jpg', '--intrinsics', 'camera.json');
  assert.equal(refused.status, 2);
  assert.match(refused.stderr, /on its side.*--turn 90 or 270/);
  const told = await command('--texture', 'over.jpg', '--intrinsics', 'camera.json');
  assert.equal(told.status, 0);
  assert.match(told.stderr, /upside down.*--turn 180/);
  assert.doesNotMatch((await command('--texture', 'over.jpg', '--intrinsics', 'camera.json', '--turn', '180')).stderr, /warning/);
  assert.match((await command('--texture', 'bare.jpg', '--intrinsics', 'camera.json', '--turn', '45')).stderr, /90, 180 or 270/);
  assert.match((await command('--texture', 'upright.jpg', '--intrinsics', 'camera.json', '--turn', '180')).stderr, /on its side/);

  // All that is about the depths turns with them.
  const levels = { width, height, data: Uint8Array.from({ length: width * height }, (_, i) => level(i)) };
  const turned = direct.backProject(depths(), numbers, { turn: 90, confidence: levels, mask: levels });
  const plain = direct.backProject(depths(), numbers, { confidence: levels, mask: levels });
  assert.deepEqual([turned.camera?.width, turned.camera?.height, turned.camera?.cx, turned.camera?.cy], [height, width, height - 1 - 97, 126]);
  const pixel = 90 * width + 120;
  const same = 120 * height + height - 1 - 90;
  const [x, y, z] = plain.positions.subarray(3 * pixel, 3 * pixel + 3);
  assert.ok(z < 0);
  for (const [k, value] of [y, -x, z].entries()) assert.ok(Math.abs(turned.positions[3 * same + k] - value) < 1e-12);
  assert.equal(turned.triangles.length, plain.triangles.length);
  assert.throws(() => direct.backProject(depths(), numbers, { turn: /** @type {any} */ (45) }), error('OPTION', /^option `turn` is 45, but must be 0, 90, 180 or 270 degrees/));
});

test('a textured scan brings its photo along', async () => {
  const folder = await temporaryFolder();
  const texture = direct.writePhoto(picture);
  const { camera, ...surface } = direct.fit(seen, { lambda: 'big' });
  await writeFile(join(folder, 'scan.glb'), direct.writeGlb({ ...surface, texture }));
  await succeeds(folder, ['dewarp', 'scan.glb', '--view', 'best-fit', '--lambda', 'big', '-o', 'page.png', '--map', 'map.json']);
  const flat = await mapIn(folder);
  const found = displacement(photoCamera, flat);
  assert.ok(found < 0.003, String(found));
  const bare = { ...surface, uvs: undefined, colors: undefined };
  await writeFile(join(folder, 'bare.glb'), direct.writeGlb(bare));
  await refuses(folder, [['dewarp bare.glb -o page.png', /has no texture of its own/]]);
});
