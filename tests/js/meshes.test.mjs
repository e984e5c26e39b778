/** Meshes: read, sampled, fitted and turned back; directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { refuses, run, silent, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { gridMesh, placeOf } from './support/shapes.mjs';

after(() => developable.dispose());

/** @param {string} name */
const file = (name) => readFile(new URL(`../data/meshes/${name}`, import.meta.url));

/** A square of the plane x + 2y + 4z = 1 that stands in the mesh's own axes, finely cut. */
const tilted = (cells = 12) => gridMesh(cells + 1, cells + 1, (col, row) => [col / cells, row / cells, (1 - (col + 2 * row) / cells) / 4]);

/** @param {string} text @returns {number[][]} */
const verticesOf = (text) => text.split('\n').filter((line) => line.startsWith('v '))
  .map((line) => line.slice(2).split(' ').map(Number));

/** @param {number[]} point */
const offPlane = ([x, y, z]) => Math.abs(x + 2 * y + 4 * z - 1);

test('meshes have a wasm of their own', async () => {
  assert.throws(() => direct.readMesh(new Uint8Array(8)), error('NOT_INITIALIZED', /load\('meshes'\)/));
  await Promise.all([direct.init(), direct.load('files', 'meshes')]);
});

test('files of all formats', async () => {
  for (const name of ['colours.obj', 'polygons-be.ply', 'trimesh-ascii.ply', 'ascii.stl', 'numpy-binary.stl', 'embedded.gltf', 'turned.glb']) {
    const bytes = await file(name);
    const mesh = direct.readMesh(bytes);
    assert.equal(mesh.triangles.length, 9, name);
    assert.ok(mesh.positions instanceof Float64Array && mesh.positions.length >= 15, name);
  }
  const { colors } = direct.readMesh(await file('colours.obj'), { format: 'obj' });
  assert.equal(colors?.length, 15);
  const { uvs } = direct.readMesh(await file('fan.glb'), { format: 'glb' });
  assert.equal(uvs?.length, 10);
});

test('a plane comes back in its own axes from every side', async () => {
  const mesh = tilted();
  for (const view of /** @type {const} */ (['-x', '+x', '-y', '+y', '-z', '+z', 'best-fit'])) {
    const sampled = direct.sampleMesh(mesh, { view, resolution: 30 });
    const surface = direct.fit(sampled, { lambda: 'big' });
    assert.deepEqual(surface.frame, sampled.frame);
    const points = verticesOf(new TextDecoder().decode(direct.writeObj(surface)));
    assert.ok(points.length > 100, view);
    for (const point of points) {
      assert.ok(offPlane(point) < 1e-6, `${view}: ${point}`);
      assert.ok(point[0] > -1e-9 && point[0] < 1 + 1e-9 && point[1] > -1e-9 && point[1] < 1 + 1e-9);
    }
  }
});

test('the promise API does the same', async () => {
  const mesh = { ...tilted(), colors: new Float32Array(3 * 169).fill(0.5) };
  const options = { view: /** @type {const} */ ([-1, -2, -4]), spacing: 0.05 };
  const sampled = await developable.sampleMesh(mesh, options);
  assert.equal(mesh.positions.length, 3 * 169, 'the mesh is not taken away');
  assert.deepEqual(sampled, direct.sampleMesh(mesh, options));
  assert.equal(sampled.colors?.length, 3 * sampled.rows * sampled.cols);
  const surface = await developable.fit(sampled, { lambda: 'big' });
  assert.deepEqual(surface.frame, sampled.frame);
  const bytes = await developable.writeObj(surface);
  assert.ok(verticesOf(new TextDecoder().decode(bytes)).every((point) => offPlane(point) < 1e-6));
});

test('plain arrays are a mesh too', () => {
  const mesh = /** @type {any} */ ({ positions: [0, 0, 1, 2, 0, 1, 0, 2, 1], triangles: [0, 1, 2] });
  const { heights, colors, uvs } = direct.sampleMesh(mesh, { resolution: 9 });
  assert.ok(heights.every((z) => Math.abs(z - 1) < 1e-12 || Number.isNaN(z)) && !heights.every(Number.isNaN));
  assert.equal(colors, undefined);
  assert.equal(uvs, undefined);
});

test('a point cloud is seen as a mesh is', async () => {
  const { positions } = tilted(60);
  const colors = Float32Array.from(positions);
  const options = { view: /** @type {const} */ ('-z') };
  for (const cloud of [{ positions, colors }, { positions, triangles: new Uint32Array(0), colors }]) {
    const seen = direct.sampleMesh(/** @type {any} */ (cloud), options);
    // Some points for each vertex: 61 by 61 of them are there.
    assert.ok(seen.heights.length > 600 && seen.heights.length < 1100, `${seen.heights.length}`);
    const surface = direct.fit(seen, { lambda: 'big' });
    const points = verticesOf(new TextDecoder().decode(direct.writeObj({ ...surface, colors: undefined })));
    assert.ok(points.length > 500 && points.every((point) => offPlane(point) < 1e-6));
    const [x, y] = [surface.colors?.[0], surface.colors?.[1]].map(Number);
    assert.ok(Math.hypot(x, y - 1) < 0.05, 'the colour of the corner at the top left');
  }
  const points = direct.readMesh(await file('points.ply'));
  assert.deepEqual([points.positions.length, points.triangles.length], [15, 0]);
  assert.throws(() => direct.sampleMesh(/** @type {any} */ ({ positions: [] })), error('UNSUPPORTED', /no point/));
});

test('what is wrong with a mesh or an option is said', async () => {
  const mesh = tilted(2);
  /** @param {any} options */
  const sample = (options) => () => direct.sampleMesh(mesh, options);
  assert.throws(sample({ view: 'top' }), error('OPTION', /view/));
  assert.throws(sample({ view: [0, 0, 0] }), error('OPTION', /view/));
  assert.throws(sample({ view: [0, 1] }), error('OPTION', /view/));
  assert.throws(sample({ resolution: 1 }), error('OPTION', /resolution/));
  assert.throws(sample({ resolution: 2.5 }), error('OPTION', /resolution/));
  assert.throws(sample({ resolution: 9, spacing: 1 }), error('OPTION', /spacing/));
  assert.throws(sample({ spacing: 0 }), error('OPTION', /spacing/));
  assert.throws(sample({ size: 7 }), error('OPTION', /size/));
  assert.throws(sample({ spacing: 1e-7 }), error('TOO_LARGE'));
  /** @param {any} changed */
  const changed = (changed) => () => direct.sampleMesh({ ...mesh, ...changed });
  assert.throws(changed({ positions: undefined }), error('INPUT', /positions/));
  assert.throws(changed({ triangles: [0, 1, -1] }), error('INPUT', /triangles\[2\]/));
  assert.throws(changed({ triangles: new Uint32Array(4) }), error('SHAPE'));
  assert.throws(changed({ triangles: new Uint32Array([0, 1, 99]) }), error('FORMAT', /99/));
  assert.throws(changed({ colors: new Float32Array(3) }), error('SHAPE'));
  assert.throws(changed({ positions: new Float64Array(27).fill(NaN) }), error('NOT_FINITE'));
  assert.throws(() => direct.sampleMesh(/** @type {any} */ (undefined)), error('INPUT'));
  assert.throws(() => direct.readMesh(new Uint8Array(9)), error('UNSUPPORTED'));
  assert.throws(() => direct.readMesh(new Uint8Array(9), { format: 'stl' }), error('FORMAT'));
  assert.throws(() => direct.readMesh(new Uint8Array(9), /** @type {any} */ ({ format: 'fbx' })), error('OPTION'));
  const draco = await file('draco.glb');
  assert.throws(() => direct.readMesh(draco), error('UNSUPPORTED', /draco/));
  await assert.rejects(developable.readMesh(draco), error('UNSUPPORTED', /draco/));
  const heights = { rows: 3, cols: 3, spacing: 1, heights: new Float64Array(9) };
  assert.throws(() => direct.writeObj({ ...heights, frame: /** @type {any} */ ({ up: [1, 2] }) }), error('INPUT', /frame/));
});

test('damaged files leave the wasm alive', async () => {
  for (const name of ['colours.obj', 'polygons-le.ply', 'trimesh-ascii.ply', 'binary.stl', 'ascii.stl', 'strip.glb', 'embedded.gltf']) {
    const whole = await file(name);
    for (let i = 0; i < 600; i++) {
      const bytes = Uint8Array.from(whole);
      for (let k = 0; k <= i % 3; k++) bytes[(i * 7919 + k * 104729) % bytes.length] = (i * 31 + k * 17) % 256;
      try {
        direct.readMesh(i % 2 ? bytes : bytes.subarray(0, (i * 13) % bytes.length), { format: /** @type {any} */ (name.split('.')[1]) });
      } catch (thrown) {
        const { code } = /** @type {import('../../pkg/direct.js').DevelopableError} */ (thrown);
        assert.ok(['FORMAT', 'UNSUPPORTED', 'NOT_FINITE'].includes(code), `${name}, ${i}: ${thrown}`);
      }
    }
  }
});

test('a quarter of a million triangles', () => {
  const mesh = tilted(356);
  assert.ok(mesh.triangles.length > 750_000);
  const sampled = direct.sampleMesh(mesh, { resolution: 215 });
  const { heights, rows, cols } = sampled;
  assert.ok(heights.length > 37_000);
  const off = heights.map((z, i) => {
    const [x, y] = placeOf(sampled, i);
    return 4 * z - (1 - x - 2 * y);
  });
  assert.ok(off.every((value) => !(Math.abs(value) > 1e-9)));
  assert.ok(heights.filter(Number.isNaN).length < rows + 2 * cols);
});

test('the command fits a mesh in its own axes', async () => {
  const folder = await temporaryFolder();
  const obj = Buffer.from(direct.writeObj(tilted())).toString();
  await writeFile(join(folder, 'plane.obj'), obj);
  await writeFile(join(folder, 'cloud.obj'), obj.split('\n').filter((line) => line.startsWith('v ')).join('\n'));
  await writeFile(join(folder, 'bad.ply'), 'ply\n');
  await writeFile(join(folder, 'image.npy'), 'none');
  for (const view of ['-z', '+y', '-1,-2,-4', 'best-fit']) {
    assert.deepEqual(await run(folder, `fit plane.obj --unit mm --view ${view} --resolution 25 --lambda big -o out.obj`), silent);
    const points = verticesOf(await readFile(join(folder, 'out.obj'), 'utf8'));
    assert.ok(points.length > 100 && points.every((point) => offPlane(point) < 1e-6), view);
  }
  assert.deepEqual(await run(folder, 'fit cloud.obj --unit mm --view best-fit --lambda big -o out.obj'), silent);
  const points = verticesOf(await readFile(join(folder, 'out.obj'), 'utf8'));
  assert.ok(points.length > 20 && points.every((point) => offPlane(point) < 1e-6));
  assert.deepEqual(await run(folder, 'fit plane.obj --unit mm --spacing 0.1 --lambda big -o out.npy'), silent);
  await refuses(folder, [
    ['fit plane.obj --view top -o out.obj', /--view/],
    ['fit plane.obj --view 1,2 -o out.obj', /--view/],
    ['fit plane.obj --resolution 1 -o out.obj', /--resolution/],
    ['fit plane.obj --resolution 9 --spacing 1 -o out.obj', /--spacing/],
    ['fit plane.obj --mask image.npy -o out.obj', /--mask/],
    ['fit image.npy --view -z -o out.obj', /--view/],
    ['fit bad.ply -o out.obj', /bad\.ply.*PLY/, 3],
    ['fit nothing.stl -o out.obj', /nothing\.stl/, 3],
  ]);
  const info = await run(folder, ['info', 'cloud.obj']);
  assert.deepEqual([info.status, info.stderr], [0, '']);
  for (const line of [/^vertices: +169$/m, /^triangles: +none: a point cloud$/m, /^x: +0 to 1$/m, /^z: +-0\.5 to 0\.25$/m, /^colours: +no$/m]) {
    assert.match(info.stdout, line);
  }
  assert.match((await run(folder, ['info', 'plane.obj'])).stdout, /^triangles: +288$/m);
  assert.equal((await run(folder, ['info', 'bad.ply'])).status, 3);
  assert.equal((await run(folder, ['design', 'plane.obj', '-o', 'out.obj'])).status, 2);
  assert.equal((await run(folder, ['occlusions', 'plane.obj', '-o', 'out.npy', '--resolution', '20'])).status, 0);
});

test('the command takes points in text for a cloud, unless they lie on a grid', async () => {
  const folder = await temporaryFolder();
  const scattered = Array.from({ length: 400 }, (_, i) => [(37 * i) % 101 + 0.3 * Math.sin(i), (i * i) % 97 + 0.2 * Math.cos(i), 0.1 * ((37 * i) % 101)]);
  const grid = Array.from({ length: 400 }, (_, i) => [i % 20, Math.floor(i / 20), 0.1 * i]);
  for (const [name, points] of /** @type {const} */ ([['cloud', scattered], ['grid', grid]])) {
    await writeFile(join(folder, `${name}.xyz`), points.map((point) => `${point.join(' ')}\n`).join(''));
  }
  const cloud = await run(folder, ['info', 'cloud.xyz']);
  assert.match(cloud.stdout, /vertices: +400\ntriangles: +none: a point cloud/);
  assert.match((await run(folder, ['info', 'grid.xyz'])).stdout, /size: +20 × 20 pixels/);
  assert.equal((await run(folder, ['fit', 'cloud.xyz', '-o', 'cloud.npy'])).status, 0);
  assert.match((await run(folder, ['info', 'none.xyz'])).stderr, /cannot read none\.xyz/);
  if (process.platform === 'win32') return;
  // A pipe can be read only once.
  execFileSync('mkfifo', [join(folder, 'pipe.xyz')]);
  const written = writeFile(join(folder, 'pipe.xyz'), await readFile(join(folder, 'cloud.xyz')));
  assert.equal((await run(folder, ['info', 'pipe.xyz'])).stdout, cloud.stdout);
  await written;
});
