/** Textures and photos as colours of the surface: of meshes, of depths and of images; directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { copyFile, mkdir, readFile, symlink, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { refuses, run, silent, succeeds, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { withExif } from './support/exif.mjs';
import { placeOf } from './support/shapes.mjs';

after(() => developable.dispose());
await Promise.all([direct.init(), direct.load('files', 'images', 'meshes', 'patterns')]);

/** @param {string} name */
const place = (name) => new URL(`../data/meshes/${name}`, import.meta.url);
/** @param {string} name */
const file = async (name) => new Uint8Array(await readFile(place(name)));

const [obj, mtl, png, glb] = await Promise.all(['textured.obj', 'textured.mtl', 'sheet.png', 'textured.glb'].map(file));
const files = new Map([['textured.mtl', mtl], ['sheet.png', png]]);

/**
 * The colour of the sheet above a place, from what make-textured.py says.
 * @param {number} x @param {number} y
 */
const shade = (x, y) => [(32 * (8 * (x / 5 + 0.2) - 0.5)) / 255, (32 * (8 * (0.8 - y / 5) - 0.5)) / 255, 128 / 255];

/**
 * Every coloured vertex has the colour of the sheet.
 * @param {import('../../pkg/index.js').Heightfield} field
 */
function checkShades(field, tolerance = 1e-4) {
  const { heights = [], colors = new Float32Array() } = field;
  assert.equal(colors.length, 3 * field.rows * field.cols);
  let count = 0;
  heights.forEach((z, i) => {
    if (Number.isNaN(z)) return;
    const [x, y] = placeOf(field, i);
    shade(x, y).forEach((value, k) => {
      assert.ok(Math.abs(colors[3 * i + k] - value) < tolerance, `vertex ${i}: ${colors[3 * i + k]}, not ${value}`);
    });
    count += 1;
  });
  assert.ok(count > 300);
}

/**
 * Whether these are the bytes of the sheet: trimesh fills them up to a multiple of four.
 * @param {unknown} bytes
 */
function isSheet(bytes) {
  assert.ok(bytes instanceof Uint8Array && bytes.length - png.length < 4);
  assert.deepEqual(bytes.subarray(0, png.length), png);
}

test('the colours of a textured mesh, through a solve and into files', async () => {
  for (const mesh of [direct.readMesh(obj, { files }), direct.readMesh(glb)]) {
    assert.deepEqual([mesh.textures?.length, mesh.missing], [1, undefined]);
    isSheet(mesh.textures?.[0]);
    const seen = direct.sampleMesh(mesh, { resolution: 40 });
    checkShades(seen);
    const surface = await developable.fit(seen, { lambda: 'big' });
    assert.deepEqual([surface.colors, surface.uvs, surface.texture], [seen.colors, seen.uvs, seen.texture]);
    isSheet(surface.texture);
    // The picture comes along; without it, the colours.
    const back = direct.readMesh(direct.writeGlb(surface));
    assert.deepEqual([back.textures, back.colors], [[seen.texture], undefined]);
    checkShades(direct.sampleMesh(back, { resolution: 40 }), 0.03);
    const colored = direct.readMesh(await developable.writeGlb(surface, { texture: null }));
    assert.deepEqual([colored.textures, colored.colors?.length], [undefined, colored.positions.length]);
    const ply = direct.readMesh(direct.writePly(surface));
    assert.equal(ply.colors?.length, ply.positions.length);
  }
  const object = { 'textured.mtl': mtl, 'sheet.png': png };
  assert.deepEqual(await developable.readMesh(new Blob([obj]), { files: object }), direct.readMesh(obj, { files }));
});

test('several textures, pixels in the place of files, and what has none', async () => {
  const mesh = direct.readMesh(await file('half-textured.glb'));
  assert.deepEqual([...new Set(mesh.textureOf)].sort(), [-1, 0]);
  const seen = direct.sampleMesh(mesh, { resolution: 60 });
  assert.equal(seen.texture, undefined, 'not of all of it');
  const red = (seen.heights ?? []).map((_, i) => i).filter((i) => seen.colors?.[3 * i] === 1);
  assert.ok(red.length > 20 && red.every((i) => seen.colors?.[3 * i + 2] === 0));
  // The same picture as pixels, and twice.
  const pixels = direct.readPhoto(png);
  const twice = { ...direct.readMesh(glb), textures: [pixels, png], textureOf: new Int32Array([0, 1, 0]) };
  checkShades(direct.sampleMesh(twice, { resolution: 40 }));
});

test('what is missing or damaged', async () => {
  assert.deepEqual(direct.readMesh(obj).missing, ['textured.mtl']);
  assert.deepEqual(direct.readMesh(obj, { files: { 'textured.mtl': mtl } }).missing, ['sheet.png']);
  // Damage to what only looks are made of refuses no mesh.
  assert.deepEqual(direct.readMesh(obj, { files: { 'textured.mtl': new TextEncoder().encode('newmtl a\nKd 1 1') } }).positions, direct.readMesh(obj).positions);
  const damaged = { ...direct.readMesh(glb), textures: [png.subarray(0, 40)] };
  assert.throws(() => direct.sampleMesh(damaged), error('FORMAT', /PNG/));
  await assert.rejects(developable.sampleMesh(damaged), error('FORMAT', /PNG/));
  // A kind of picture that is not read gives no colours.
  const foreign = { ...direct.readMesh(glb), textures: [new TextEncoder().encode('a picture of another kind')] };
  assert.deepEqual(direct.sampleMesh(foreign, { resolution: 20 }).heights, direct.sampleMesh(direct.readMesh(glb), { resolution: 20 }).heights);
  assert.throws(() => direct.readMesh(obj, { files: /** @type {any} */ ({ a: 'text' }) }), error('INPUT'));
  assert.throws(() => direct.sampleMesh({ ...damaged, textures: /** @type {any} */ (['a.png']) }), error('INPUT', /photo/));
  assert.throws(() => direct.sampleMesh({ ...direct.readMesh(glb), textureOf: new Int32Array(1) }), error('SHAPE'));
  const bare = { rows: 3, cols: 3, spacing: 1, heights: new Float64Array(9) };
  assert.throws(() => direct.paint(bare, png, /** @type {any} */ ({ place: 1 })), error('OPTION', /place/));
  assert.throws(() => direct.paint(bare, png, { extent: [0, 0, 0, 1] }), error('OPTION', /extent/));
  assert.throws(() => direct.writeObj(bare, { materials: 'a.mtl' }), error('UNSUPPORTED', /texture coordinates/));
  assert.throws(() => direct.writeMtl('two\nlines'), error('OPTION'));
});

test('a photo gives an image its colours', async () => {
  // Heights of 12 × 9 pixels of half a unit; a photo of four times as many, redder to the right, greener downwards.
  const [width, height, pixelSize] = [12, 9, 0.5];
  const image = { width, height, pixelSize, data: Float64Array.from({ length: width * height }, (_, i) => (i % width) / 20) };
  const data = Uint8Array.from({ length: 4 * 24 * 18 }, (_, i) => [10 * (Math.floor(i / 4) % 24), 10 * Math.floor(i / 96), 0, 255][i % 4]);
  const photo = { width: 24, height: 18, data };
  const surface = await developable.fit(image, { lambda: 'big' });
  const painted = direct.paint(surface, photo);
  assert.equal(painted.texture, undefined, 'pixels are no file');
  const { colors } = painted;
  for (const [i, z] of painted.heights.entries()) {
    if (Number.isNaN(z)) continue;
    const [x, y] = placeOf(painted, i);
    // In pixels of the photo, four to a unit, the centre of the first at 0; it ends as it is there.
    const expected = [Math.min(Math.max(4 * x - 0.5, 0), 23), Math.min(Math.max(17.5 - 4 * y, 0), 17)].map((v) => (10 * v) / 255);
    expected.forEach((value, k) => assert.ok(Math.abs(colors[3 * i + k] - value) < 1e-4, `${i}: ${colors[3 * i + k]} ${value}`));
  }
  const png = direct.writePhoto(photo);
  const again = await developable.paint(surface, new Blob([png]));
  assert.deepEqual([again.colors, again.uvs, again.texture, again.report], [colors, painted.uvs, png, surface.report]);
  // A part of it only.
  const part = direct.paint(surface, photo, { extent: [0, 0, 3, 4.5] });
  assert.ok(Math.max(...part.colors.filter((_, i) => i % 3 === 0)) > 230 / 255 - 1e-6);
});

test('colours of a depth camera, from files of other programs', async () => {
  const [depth, colour, jpeg] = await Promise.all(['depth-tum.png', 'colour-tum.png', 'colour-tum.jpg'].map(file));
  const camera = { fx: 60, fy: 62, cx: 39.5, cy: 29.5, depthScale: 1 / 5000 };
  const mesh = direct.backProject(direct.read(depth), camera);
  const seen = direct.sampleMesh({ ...mesh, textures: [colour] }, { resolution: 50 });
  const { colors = [] } = seen;
  let count = 0;
  for (const [i, z] of seen.heights.entries()) {
    if (Number.isNaN(z)) continue;
    const [x, y] = placeOf(seen, i);
    // The plane of the script, whose y counts down and z ahead, to a level of the depths; and the pixel that saw it.
    assert.ok(Math.abs(0.36 * x - 0.48 * y - 0.8 * z - 2) < 2e-4, `vertex ${i}`);
    const [u, v] = [39.5 - (60 * x) / z, 29.5 + (62 * y) / z];
    assert.ok(Math.abs(colors[3 * i] - (3 * u) / 255) < 0.004 && Math.abs(colors[3 * i + 1] - (4 * v) / 255) < 0.004, `vertex ${i}`);
    count += 1;
  }
  assert.ok(count > 800);
  const surface = await developable.fit(seen, { lambda: 'big' });
  const lossy = direct.paint(surface, jpeg);
  // Where a hole was bridged there is a colour now, for the camera sees the surface there.
  assert.ok(lossy.colors.every((value, i) => Number.isNaN(colors[i]) || Math.abs(value - colors[i]) < 0.03));
  assert.ok(surface.heights.every((z, i) => Number.isNaN(z) === Number.isNaN(lossy.colors[3 * i])));
  assert.deepEqual(lossy.texture, jpeg);
});

test('point clouds of other programs', async () => {
  const near = direct.readMesh(await file('cloud.ply'));
  const far = direct.readMesh(await file('cloud-far.ply'));
  for (const [mesh, [dx, dy, dz]] of /** @type {const} */ ([[near, [0, 0, 0]], [far, [512000, 5413000, 300]]])) {
    assert.deepEqual([mesh.triangles.length, mesh.positions.length], [0, 3 * 600]);
    const surface = direct.fit(direct.sampleMesh(mesh), { lambda: 'big' });
    const { positions } = direct.readMesh(direct.writeGlb(surface));
    assert.ok(positions.length > 300);
    for (let i = 0; i < positions.length; i += 3) {
      const [x, y, z] = [positions[i] - dx, positions[i + 1] - dy, positions[i + 2] - dz];
      assert.ok(Math.abs(0.5 * x - 0.25 * y + 1 - z) < 1e-3, `${x} ${y} ${z}`);
    }
  }
  const { colors = [], positions } = near;
  for (let i = 0; i < positions.length; i++) {
    const share = i % 3 === 2 ? 0 : positions[i] / (i % 3 === 0 ? 3 : 2);
    assert.ok(Math.abs(colors[i] - Math.min(Math.max(share, 0), 1)) < 0.5 / 255 + 1e-6);
  }
});

test('the command reads what lies beside a mesh, and nothing else', async () => {
  const folder = await temporaryFolder();
  const inner = join(folder, 'scan');
  await mkdir(inner);
  for (const name of ['textured.obj', 'textured.mtl', 'sheet.png']) await copyFile(place(name), join(inner, name));
  assert.deepEqual(await run(folder, 'fit scan/textured.obj --unit mm --resolution 40 --lambda big -o out.ply'), silent);
  const { colors = [], positions } = direct.readMesh(await readFile(join(folder, 'out.ply')));
  for (let i = 0; i < positions.length; i += 3) {
    shade(positions[i], positions[i + 1]).forEach((value, k) => assert.ok(Math.abs(colors[i + k] - value) < 0.003));
  }
  assert.deepEqual(await run(folder, 'fit scan/textured.obj --unit mm --resolution 40 --lambda big -o out.glb'), silent);
  assert.deepEqual(direct.readMesh(await readFile(join(folder, 'out.glb'))).textures, [png]);
  assert.match((await run(folder, 'info scan/textured.obj')).stdout, /^texture: +has coordinates, 1 picture$/m);
  // What the mesh is read with is not overwritten.
  await refuses(folder, [[
    'fit scan/textured.obj --resolution 40 --texture scan/sheet.png --mtl scan/textured.mtl -o out.obj',
    /scan\/textured\.mtl is a file that scan\/textured\.obj is read with/,
  ]]);
  assert.deepEqual(new Uint8Array(await readFile(join(inner, 'textured.mtl'))), new Uint8Array(mtl));
  // A path on another machine, and two that lead out of the folder.
  await writeFile(join(folder, 'secret.png'), png);
  await symlink(join(folder, 'secret.png'), join(inner, 'link.png'));
  for (const [name, found] of /** @type {const} */ ([['C:\\Users\\me\\sheet.png', true], ['../secret.png', false], ['link.png', false]])) {
    await writeFile(join(inner, 'textured.mtl'), `newmtl sheet\nmap_Kd ${name}\n`);
    const { status, stderr } = await run(folder, 'fit scan/textured.obj --unit mm --resolution 40 --lambda big -o out.ply');
    assert.equal(status, 0);
    if (found) assert.equal(stderr, '');
    else assert.match(stderr, new RegExp(`warning: scan/textured\\.obj names ".*${name.slice(-8)}", which is outside of its folder`));
    const info = (await run(folder, 'info scan/textured.obj')).stdout;
    assert.equal(/^missing: /m.test(info), !found, info);
  }
  for (const name of ['parts.gltf', ...[0, 1, 2, 3].map((i) => `gltf_buffer_${i}.bin`)]) await copyFile(place(name), join(inner, name));
  assert.deepEqual(await run(folder, 'fit scan/parts.gltf --resolution 40 --lambda big -o parts.glb'), silent);
  isSheet(direct.readMesh(await readFile(join(folder, 'parts.glb'))).textures?.[0]);
});

test('the command paints with a photo', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'scan.npy'), direct.writeImage({ width: 20, height: 16, data: new Float64Array(320).map((_, i) => (i % 20) / 9) }));
  for (const name of ['colour-tum.png', 'colour-tum.jpg', 'depth-tum.png']) await copyFile(place(name), join(folder, name));
  assert.deepEqual(await run(folder, 'fit scan.npy --texture colour-tum.png -o out.ply --lambda big'), silent);
  const { colors = [], positions } = direct.readMesh(await readFile(join(folder, 'out.ply')));
  for (let i = 0; i < positions.length; i += 3) {
    // 80 by 60 pixels on 20 by 16.
    const [u, v] = [4 * positions[i] - 0.5, 59.5 - (60 / 16) * positions[i + 1]];
    assert.ok(Math.abs(colors[i] - (3 * Math.max(u, 0)) / 255) < 0.01 && Math.abs(colors[i + 1] - (4 * v) / 255) < 0.01);
  }
  assert.deepEqual(await run(folder, 'fit depth-tum.png --intrinsics 60,62,39.5,29.5,0.0002 --texture colour-tum.jpg -o out.glb --lambda big'), silent);
  assert.equal(direct.readMesh(await readFile(join(folder, 'out.glb'))).textures?.length, 1);
  // An OBJ with the picture by way of an MTL, which is what this reads again.
  await mkdir(join(folder, 'sub'));
  assert.deepEqual(await run(folder, 'fit scan.npy --texture colour-tum.png -o out.obj --mtl sub/out.mtl --lambda big'), silent);
  assert.equal(await readFile(join(folder, 'sub/out.mtl'), 'utf8'), 'newmtl surface\nKd 1 1 1\nmap_Kd ../colour-tum.png\n');
  const text = await readFile(join(folder, 'out.obj'), 'utf8');
  assert.match(text, /^mtllib sub\/out\.mtl\nusemtl surface\nv \S+ \S+ \S+\n/);
  assert.match((await run(folder, ['info', 'out.obj'])).stdout, /1 picture$/m);
  await writeFile(join(folder, 'lying.jpg'), withExif(await file('colour-tum.jpg'), { orientation: 6 }));
  await refuses(folder, [
    ['fit scan.npy --texture colour-tum.png -o out.stl', /--texture/],
    ['fit scan.npy --texture colour-tum.png -o out.ply --mtl a.mtl', /--mtl/],
    ['fit scan.npy -o out.obj --mtl a.mtl', /--mtl/],
    ['fit scan.npy --texture colour-tum.png -o out.obj --mtl a.txt', /mtl must end/],
    ['fit scan.npy --texture scan.npy -o out.obj', /scan\.npy.*photos/, 3],
    // Whether who opens the .obj turns the picture cannot be known.
    ['fit scan.npy --texture lying.jpg -o lying.obj --mtl lying.mtl', /lying\.jpg.*Exif orientation 6.*save the photo upright/, 3],
  ]);
  await assert.rejects(readFile(join(folder, 'lying.obj')), { code: 'ENOENT' });
  for (const args of ['--texture lying.jpg -o lying.ply', '--texture colour-tum.jpg -o lying.obj --mtl lying.mtl']) {
    assert.deepEqual(await run(folder, `fit scan.npy ${args}`), silent);
  }
});

test('the textures of a mesh are printed on its sheets', async () => {
  // The mesh of make-textured.py: as there, texture coordinates say where a corner is.
  const corners = [[0, 0.5, 0.25], [3, 0, 0.5], [3.5, 2, 1], [-0.5, 2.25, 1.5], [1, 3, 0.125]];
  const mesh = direct.readMesh(glb);
  const options = { exact: true, scale: 10, printed: true };
  const drawing = direct.pattern(mesh, options);
  const printed = drawing.sheets.flatMap((sheet) => sheet.printed ?? []);
  assert.equal(printed.length, 3);
  for (const triangle of printed) {
    assert.equal(triangle.texture, 0);
    const places = triangle.uvs.map(([u, v]) => /** @type {number[]} */ (corners.find(([x, y]) => Math.hypot(x / 5 + 0.2 - u, y / 5 + 0.2 - v) < 1e-6)));
    for (const [a, b] of [[0, 1], [1, 2], [2, 0]]) {
      const [[x, y], [p, q]] = [triangle.corners[a], triangle.corners[b]];
      const length = Math.hypot(...places[a].map((value, k) => value - places[b][k]));
      assert.ok(Math.abs(Math.hypot(x - p, y - q) - 10 * length) < 1e-5);
    }
  }
  const [texture] = drawing.textures ?? [];
  const { width, height, data } = direct.readPhoto(texture.jpeg);
  assert.deepEqual([width, height, texture.width, texture.height], [8, 8, 8, 8]);
  for (const [row, col] of [[0, 0], [2, 5], [7, 7]]) {
    const pixel = [...data.subarray(4 * (8 * row + col), 4 * (8 * row + col) + 3)];
    [32 * col, 32 * row, 128].forEach((level, k) => assert.ok(Math.abs(pixel[k] - level) < 20, `${pixel} at ${row}, ${col}`));
  }

  const [svg, pdf] = [direct.writeSvg(drawing), direct.writePdf(drawing)].map((bytes) => Buffer.from(bytes).toString('latin1'));
  assert.ok(svg.includes(`data:image/jpeg;base64,${Buffer.from(texture.jpeg).toString('base64')}`));
  assert.match(svg, /<g [^>]*id="picture"/);
  assert.ok(pdf.includes(Buffer.from(texture.jpeg).toString('latin1')));

  const { textures, ...bare } = mesh;
  assert.throws(() => direct.pattern(bare, options), { code: 'INPUT', message: /no textures.*leave out `printed`/ });
  await assert.rejects(developable.pattern(bare, options), { code: 'INPUT' });
  assert.throws(() => direct.pattern(mesh, { ...options, thickness: 1 }), { code: 'OPTION', message: /printed/ });

  const folder = await temporaryFolder();
  await Promise.all(['textured.obj', 'textured.mtl', 'sheet.png'].map((name) => copyFile(place(name), join(folder, name))));
  await succeeds(folder, 'pattern textured.obj --surface --as-is --scale 10 --printed -o sheets.pdf');
  assert.ok((await readFile(join(folder, 'sheets.pdf'))).includes('/DCTDecode'));
});
