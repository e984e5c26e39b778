/** Depth cameras: a known plane comes back from its depths; directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { run, temporaryFolder } from './support/command.mjs';

after(() => developable.dispose());
await Promise.all([direct.init(), direct.load('files', 'meshes')]);

const [width, height] = [64, 48];
const camera = { fx: 90, fy: 110, cx: 30, cy: 25 };

/** x to the right, y up, z backwards, on the ray of a pixel, 1 ahead. @param {number} i */
const ray = (i) => [((i % width) - 30) / 90, (25 - Math.floor(i / width)) / 110, -1];
/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** A plane at a slant: no flip or turn leaves it as it is. */
const normal = [0.36, 0.48, 0.8];
const away = -3;
const depths = Float64Array.from({ length: width * height }, (_, i) => away / dot(normal, ray(i)));
const image = { width, height, data: depths };

/** @param {ArrayLike<number>} positions */
function checkPlane(positions, tolerance = 1e-6) {
  assert.ok(positions.length > 3000);
  for (let i = 0; i < positions.length; i += 3) {
    const point = [positions[i], positions[i + 1], positions[i + 2]];
    assert.ok(Math.abs(dot(normal, point) - away) < tolerance, point.join());
  }
}

/** @param {string} code @param {RegExp} message */
const error = (code, message) => (/** @type {any} */ thrown) => {
  assert.equal(thrown.code, code, String(thrown));
  assert.match(thrown.message, message);
  return true;
};

test('every pixel becomes a vertex on its ray', async () => {
  const mesh = direct.backProject(image, camera);
  checkPlane(mesh.positions, 1e-12);
  for (const i of [0, width - 1, width * height - 1, 777]) {
    const expected = ray(i).map((v) => v * depths[i]);
    expected.forEach((v, k) => assert.ok(Math.abs(mesh.positions[3 * i + k] - v) < 1e-12));
    assert.ok(Math.abs((mesh.uvs?.[2 * i] ?? 0) - ((i % width) + 0.5) / width) < 1e-6);
    assert.ok(Math.abs((mesh.uvs?.[2 * i + 1] ?? 0) - (1 - (Math.floor(i / width) + 0.5) / height)) < 1e-6);
  }
  assert.equal(mesh.triangles.length, 6 * (width - 1) * (height - 1));
  assert.deepEqual(await developable.backProject(image, camera), mesh);
  assert.equal(depths.length, width * height, 'the depths are not taken away');
});

test('units, rays, masks and values without depth', () => {
  const mesh = direct.backProject(image, camera);
  const millimetres = depths.map((v) => 1000 * v);
  // What images are scaled by otherwise does not count.
  const scaled = direct.backProject({ ...image, data: millimetres, heightScale: 7, pixelSize: 3 }, { ...camera, depthScale: 0.001 });
  const rays = depths.map((v, i) => v * Math.hypot(...ray(i)));
  for (const other of [scaled, direct.backProject({ ...image, data: rays }, { ...camera, depth: 'ray' })]) {
    assert.ok(other.positions.every((v, i) => Math.abs(v - mesh.positions[i]) < 1e-12));
  }
  const mask = new Uint8Array(width * height).fill(1);
  mask[10 * width + 10] = 0;
  const holed = depths.slice();
  holed[20 * width + 10] = NaN;
  holed[20 * width + 20] = 0;
  holed[20 * width + 30] = 65535;
  const { triangles } = direct.backProject({ ...image, data: holed, mask, noData: 65535 }, camera);
  assert.equal(triangles.length, mesh.triangles.length - 4 * 4 * 3);
});

test('from depths to a surface in the axes of the camera, with a picture of the same size', async () => {
  const mesh = direct.backProject(image, camera);
  const colors = Float32Array.from({ length: 3 * width * height }, (_, i) => (i % 3 === 0 ? (Math.floor(i / 3) % width) / width : 0.5));
  for (const view of /** @type {const} */ (['-z', 'best-fit'])) {
    const seen = direct.sampleMesh({ ...mesh, colors }, { view, resolution: 60 });
    const surface = direct.fit(seen, { lambda: 'big' });
    const back = direct.readMesh(direct.writePly(surface));
    checkPlane(back.positions);
    // Left in the picture is left in space.
    const reds = [...(back.colors ?? [])].filter((_, i) => i % 3 === 0);
    const xs = [...back.positions].filter((_, i) => i % 3 === 0);
    const at = (/** @type {number} */ x) => reds[xs.indexOf(x)];
    assert.ok(at(Math.min(...xs)) < 0.1 && at(Math.max(...xs)) > 0.9);
    assert.equal(back.uvs?.length, 2 * xs.length);
  }
});

test('a photo is laid on by the camera, wherever it was', async () => {
  // Red says from where in the photo a colour is, green from how far down.
  const size = { width: 160, height: 120 };
  const photo = { ...size, data: Uint8ClampedArray.from({ length: 4 * 160 * 120 }, (_, i) => [Math.floor(i / 4) % 160, Math.floor(i / 640), 0, 255][i % 4]) };
  const seen = direct.sampleMesh(direct.backProject(image, camera), { view: 'best-fit', resolution: 60 });
  const surface = direct.fit(seen, { lambda: 'big' });
  /**
   * Colours where they belong, by the written file alone.
   * @param {import('../../pkg/types.js').Heightfield} field
   * @param {{ fx: number, fy: number, cx: number, cy: number, rotation?: number[][], translation?: number[] }} by in pixels of the photo
   */
  const check = (field, { fx, fy, cx, cy, translation: [tx, ty, tz] = [0, 0, 0] }) => {
    const { positions, colors = [], uvs = [] } = direct.readMesh(direct.writeGlb({ ...field, texture: undefined }));
    let inside = 0;
    for (let i = 0; i < positions.length / 3; i++) {
      const [x, y, z] = [positions[3 * i] + tx, -positions[3 * i + 1] + ty, -positions[3 * i + 2] + tz];
      const [u, v] = [cx + (fx * x) / z, cy + (fy * y) / z];
      if (u < 1 || v < 1 || u > 158 || v > 118) continue;
      inside++;
      assert.ok(Math.abs(255 * colors[3 * i] - u) < 0.6 && Math.abs(255 * colors[3 * i + 1] - v) < 0.6, `${i}: ${u} ${v}`);
      assert.ok(Math.abs(160 * uvs[2 * i] - 0.5 - u) < 0.05 && Math.abs(120 * (1 - uvs[2 * i + 1]) - 0.5 - v) < 0.05);
    }
    return inside;
  };
  const scale = 160 / width;
  const own = { fx: scale * camera.fx, fy: scale * camera.fy, cx: scale * (camera.cx + 0.5) - 0.5, cy: scale * (camera.cy + 0.5) - 0.5 };
  // The surface is not where the depths were: the fitted points count.
  const lifted = { ...surface, heights: surface.heights.map((z) => z + 0.03) };
  assert.ok(check(direct.paint(surface, photo), own) > 500);
  assert.ok(check(direct.paint(lifted, photo), own) > 500);
  const elsewhere = { ...own, cx: own.cx + 3, ...size, translation: /** @type {const} */ ([0.04, -0.03, 0.02]), rotation: /** @type {const} */ ([[1, 0, 0], [0, 1, 0], [0, 0, 1]]) };
  const painted = direct.paint(surface, photo, { camera: elsewhere });
  assert.ok(check(painted, { ...elsewhere, rotation: undefined, translation: [...elsewhere.translation] }) > 400);
  assert.deepEqual((await developable.paint(surface, photo, { camera: elsewhere })).colors, painted.colors);
  // A photo that is no image of this camera, and two ways to say the same.
  const square = { width: 10, height: 10, data: new Uint8ClampedArray(400) };
  assert.throws(() => direct.paint(surface, square), error('UNSUPPORTED', /10 × 10/));
  assert.throws(() => direct.paint(surface, photo, { camera: elsewhere, extent: [0, 0, 1, 1] }), error('OPTION', /extent/));
});

test('what is wrong with a camera is said', async () => {
  /** @param {any} changed */
  const changed = (changed) => () => direct.backProject(image, { ...camera, ...changed });
  assert.throws(changed({ fx: 0 }), error('OPTION', /`fx` is 0/));
  assert.throws(changed({ fy: 'long' }), error('OPTION', /`fy`/));
  assert.throws(changed({ cx: NaN }), error('OPTION', /`cx`/));
  assert.throws(changed({ cy: undefined }), error('OPTION', /fx, fy, cx and cy/));
  assert.throws(changed({ depthScale: -1 }), error('OPTION', /`depthScale`/));
  assert.throws(changed({ depth: 'radial' }), error('OPTION', /planar or ray/));
  assert.throws(changed({ k1: NaN }), error('OPTION', /`k1`/));
  assert.throws(changed({ k4: 0.1 }), error('OPTION', /k4/));
  assert.throws(() => direct.backProject(/** @type {any} */ ({}), camera), error('INPUT', /width/));
  assert.throws(() => direct.backProject({ ...image, data: [1, 2] }, camera), error('SHAPE', /depth image/));
  const none = { ...image, data: new Float64Array(width * height) };
  await assert.rejects(developable.backProject(none, camera), error('UNSUPPORTED', /no three neighbouring/));
});

test('the command takes depths with --intrinsics', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'depth.npy'), direct.writeNpy({ width, height, data: depths.map((v) => 1000 * v) }));
  await writeFile(join(folder, 'rays.npy'), direct.writeNpy({ width, height, data: depths.map((v, i) => v * Math.hypot(...ray(i))) }));
  const grey = { width: 2 * width, height: 2 * height, data: new Uint8Array(16 * width * height).fill(128) };
  const photo = Buffer.from(direct.writePhoto(grey, { format: 'jpeg' }));
  await writeFile(join(folder, 'photo.jpg'), photo);
  await writeFile(join(folder, 'part.jpg'), await readFile(new URL('../data/grey.jpg', import.meta.url)));
  const { fx, fy, cx, cy } = camera;
  await writeFile(join(folder, 'phone.json'), JSON.stringify({ fx: 2 * fx, fy: 2 * fy, cx: 2 * cx + 0.5, cy: 2 * cy + 0.5, w: 2 * width, h: 2 * height }));
  /** @param {string} args */
  const fit = (args) => run(folder, ['fit', ...args.split(' ')]);
  const silent = { status: 0, stdout: '', stderr: '' };
  const numbers = '--intrinsics 90,110,30,25';
  for (const [args, output] of [
    [`depth.npy ${numbers},0.001`, 'a.ply'],
    [`depth.npy ${numbers},0.001 --view best-fit`, 'b.ply'],
    [`rays.npy ${numbers} --ray --spacing 0.05`, 'c.obj'],
    [`rays.npy ${numbers} --ray --texture photo.jpg`, 'd.glb'],
    // Numbers that are about the photo, and a camera of its own.
    [`rays.npy --intrinsics phone.json --ray --texture photo.jpg`, 'e.glb'],
    [`rays.npy ${numbers} --ray --texture photo.jpg --photo-camera phone.json`, 'f.glb'],
  ]) {
    assert.deepEqual(await fit(`${args} --lambda big -o ${output}`), silent, args);
    checkPlane(direct.readMesh(await readFile(join(folder, output))).positions, 1e-5);
  }
  assert.ok((await readFile(join(folder, 'd.glb'))).indexOf(photo) > 0);
  /** @type {[string, number, RegExp][]} */
  const wrong = [
    [`depth.npy --intrinsics 90,110,30 -o x.ply`, 2, /--intrinsics.*fx,fy,cx,cy/],
    [`depth.npy --intrinsics 90,110,30,b -o x.ply`, 2, /--intrinsics/],
    [`depth.npy --intrinsics 0,110,30,25 -o x.ply`, 2, /--fx|fx/],
    [`depth.npy --ray -o x.ply`, 2, /--ray/],
    [`depth.npy ${numbers} --texture part.jpg -o x.ply`, 3, /16 × 16 pixels.*another part/],
    [`depth.npy ${numbers} --photo-camera phone.json -o x.ply`, 2, /--texture/],
    [`depth.npy ${numbers} --texture photo.jpg -o x.stl`, 2, /--texture.*\.glb/],
    [`depth.npy ${numbers} --texture missing.jpg -o x.glb`, 3, /missing\.jpg/],
    [`depth.npy ${numbers} --height-scale 2 -o x.ply`, 2, /--height-scale/],
    [`a.ply ${numbers} -o x.ply`, 2, /--intrinsics/],
    [`depth.npy ${numbers} --resolution 9 --spacing 1 -o x.ply`, 2, /--spacing/],
  ];
  for (const [args, status, message] of wrong) {
    const result = await fit(args);
    assert.equal(result.status, status, `${args}: ${result.stderr}`);
    assert.match(result.stderr, message);
  }
});

test('cameras from the files of other programs', () => {
  const numbers = { fx: 1400, fy: 1410, cx: 960, cy: 720 };
  const images = [{ width: 256, height: 192 }, { width: 1920, height: 1440 }];
  const sized = { ...numbers, width: 1920, height: 1440 };
  /** The image that they are for follows from the middle. @type {[string, object][]} */
  const known = [
    ['1400,0,960\n0,1410,720\n0,0,1\n', sized],
    ['1400 0 960\r\n0 1410 720\r\n0 0 1', sized],
    [JSON.stringify([[1400, 0, 960], [0, 1410, 720], [0, 0, 1]]), sized],
    [JSON.stringify({ intrinsics: [1400, 0, 0, 0, 1410, 0, 960, 720, 1] }), sized],
    [JSON.stringify({ camera: numbers }), sized],
    [JSON.stringify({ fl_x: 1400, fl_y: 1410, cx: 960, cy: 720, w: 1920, h: 1440, k1: 0.1 }), { ...sized, k1: 0.1 }],
    [JSON.stringify({ camera_matrix: { data: [1400, 0, 960, 0, 1410, 720, 0, 0, 1] }, distortion_coefficients: { data: [0.1, 0, 0, 0, 0.02] } }),
      { ...sized, k1: 0.1, k2: 0, p1: 0, p2: 0, k3: 0.02 }],
  ];
  for (const [text, expected] of known) {
    assert.deepEqual(developable.parseCamera(text, images), expected, text);
    assert.deepEqual(developable.parseCamera(`\uFEFF${text}`, images), expected, 'after a byte order mark');
  }
  assert.deepEqual(direct.parseCamera(known[0][0]), numbers, 'of no image that is known');
  for (const [text, message] of /** @type {[string, RegExp][]} */ ([
    ['', /no camera/], ['{', /no camera/], ['[]', /no camera/], ['{"camera":null}', /no camera/], ['1,2,3', /no camera/],
    ['1400,0,9600\n0,1410,720\n0,0,1', /far from the middle of 256 × 192 and of 1920 × 1440/],
  ])) {
    assert.throws(() => developable.parseCamera(text, images), (/** @type {any} */ error) =>
      error instanceof developable.DevelopableError && error.code === 'INPUT' && message.test(error.message), text);
  }
});
