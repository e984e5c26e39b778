/** Height images besides PNG and NPY: the wasm of their own, in each API and on the command line. */
import assert from 'node:assert/strict';
import { copyFile, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { loadSync } from '../../pkg/sync.js';
import { refuses, run, succeeds, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { filesWasmFile, imagesWasmFile, pkg, root } from './support/paths.mjs';
import { deviation, image, plane } from './support/shapes.mjs';

const folder = await temporaryFolder();
after(() => developable.dispose());

/** @param {string} name */
const data = (name) => readFile(join(root, 'tests/data', name));

/** As `tests/data/make-images.py` begins: 3 rows of 4 values, one of them missing. */
const ramp = Array.from({ length: 12 }, (_, i) => 7 * i + 3);
const holes = ramp.map((value, i) => (i === 6 ? NaN : value / 8 - 2));

test('the direct API says which wasm file a format needs', async () => {
  const [tiff, npy] = [await data('f4.tif'), await data('f4-le.npy')];
  assert.throws(() => direct.read(tiff), error('NOT_INITIALIZED', /load\('images'\)/));
  assert.throws(() => direct.npzArrays(tiff), error('NOT_INITIALIZED', /load\('images'\)/));
  assert.throws(() => direct.writeImage(image(3, 3, plane), { format: 'exr' }), error('NOT_INITIALIZED', /load\('images'\)/));
  loadSync({ images: await readFile(imagesWasmFile) });
  assert.equal(deviation(direct.read(tiff).data, holes), 0);
  assert.throws(() => direct.read(npy), error('NOT_INITIALIZED', /load\('files'\)/));
  loadSync({ files: await readFile(filesWasmFile) });
  assert.throws(() => direct.read(new TextEncoder().encode('hello')), error('UNSUPPORTED', /PNG, NPY, TIFF, EXR/));
});

test('each format is read by its first bytes, and by its name', async () => {
  for (const [name, format, dataType] of [
    ['f4.tif', 'tiff', 'f32'], ['big.tif', 'tiff', 'f32'], ['zip.exr', 'exr', 'f32'], ['le.pfm', 'pfm', 'f32'],
    ['deflated.npz', 'npz', 'f64'],
  ]) {
    const bytes = await data(name);
    const options = { format: /** @type {import('../../pkg/types.js').Format} */ (format) };
    for (const file of [direct.read(bytes), direct.read(bytes, options), await developable.read(bytes)]) {
      assert.deepEqual([file.format, file.dataType, file.width, file.height], [format, dataType, 4, 3], name);
      assert.equal(deviation(file.data, holes), 0, name);
      assert.equal(file.unit, null);
    }
  }
  const [jpeg, webp] = [await data('grey.jpg'), new Blob([new Uint8Array(await data('grey.webp'))])];
  assert.deepEqual([direct.read(jpeg).format, direct.read(jpeg).width], ['jpeg', 16]);
  assert.deepEqual([...(await developable.read(webp)).data], ramp.map((value) => 2 * value));
});

test('units come with the pixel size', async () => {
  const [metres, dpi] = [direct.read(await data('geo-metres.tif')), direct.read(await data('dpi.tif'))];
  assert.deepEqual([metres.unit, metres.pixelSize, dpi.unit], ['m', 0.5, 'mm']);
  assert.ok(Math.abs(dpi.pixelSize - 0.1) < 1e-12);
  const uneven = await data('unequal.tif');
  const square = await developable.read(uneven);
  assert.ok(Math.abs(square.pixelSize - 0.127) < 1e-12);
  assert.deepEqual(square.assumptions.map(({ code, option }) => [code, option]), [['heightUnit', 'heightScale'], ['squarePixels', 'pixelSize']]);
});

test('arrays of an archive are chosen by name', async () => {
  const bytes = await data('several.npz');
  const arrays = [['depth', [3, 4], 'f64'], ['confidence', [3, 4], 'u8'], ['name', [1], '<U1']]
    .map(([name, shape, dataType]) => ({ name, shape, dataType, mayBeImage: false }));
  assert.deepEqual(direct.npzArrays(bytes), arrays);
  assert.deepEqual(await developable.npzArrays(bytes), arrays);
  assert.throws(() => direct.read(bytes), error('UNSUPPORTED', /`depth`, `confidence`.*option `array`/));
  assert.deepEqual([...direct.read(bytes, { array: 'confidence' }).data], ramp);
  const exr = await data('zip.exr');
  assert.deepEqual(direct.read(exr, { array: 'z' }), direct.read(exr));
  assert.throws(() => direct.read(exr, { array: 'depth' }), error('UNSUPPORTED', /no channel `depth`, only `Z`/));
  const tiff = await data('unequal.tif');
  assert.throws(() => direct.read(tiff, { array: 'depth' }), error('OPTION', /NPZ and EXR/));
});

test('what is wrong with a file is an error', async () => {
  const exr = await data('zip.exr');
  assert.throws(() => direct.read(exr.subarray(0, 300)), error('FORMAT', /EXR/));
  assert.throws(() => direct.read(exr, { format: 'tiff' }), error('FORMAT', /begins like EXR/));
  await assert.rejects(developable.read(await data('rgb-colour.tif')), error('UNSUPPORTED', /row 2, column 1/));
  const unknown = /** @type {any} */ ({ format: 'heic' });
  assert.throws(() => direct.read(exr, unknown), error('OPTION', /or hgt$/));
});

test('TIFF and EXR come back as they were written', async () => {
  const field = image(7, 5, (x, y) => Math.fround(x * x + 0.1 * y), 0.25);
  field.data[9] = NaN;
  for (const bytes of [direct.writeImage(field, { format: 'tiff' }), direct.writeImage(field, { format: 'exr' }), await developable.writeImage(field, { format: 'tiff' }), await developable.writeImage(field, { format: 'exr' })]) {
    const back = direct.read(bytes);
    assert.deepEqual([back.width, back.height, back.pixelSize, back.dataType], [7, 5, 0.25, 'f32']);
    assert.equal(deviation(back.data, field.data), 0);
  }
});

test('a worker finds the wasm where it is told to', async () => {
  const lost = new developable.DevelopableWorker({ imagesWasm: pathToFileURL(`${pkg}nothing.wasm`) });
  const tiff = await data('f4.tif');
  await assert.rejects(lost.read(tiff), error('INIT', /nothing\.wasm|no such file/i));
  assert.equal((await lost.read(await data('f4-le.npy'))).width, 4);
  lost.dispose();
  const found = new developable.DevelopableWorker({ imagesWasm: await readFile(imagesWasmFile) });
  assert.equal((await found.read(tiff)).width, 4);
  found.dispose();
});

test('the command reads and writes them', async () => {
  const field = image(12, 10, (x, y) => Math.fround(plane(x, y)), 0.5);
  await writeFile(join(folder, 'plane.tif'), direct.writeImage(field, { format: 'tiff' }));
  await writeFile(join(folder, 'mask.exr'), direct.writeImage({ ...field, data: field.data.map((_, i) => (i < 24 ? 0 : 1)) }, { format: 'exr' }));
  for (const output of ['out.tif', 'out.tiff', 'out.exr']) {
    await succeeds(folder, `fit plane.tif -o ${output} --mask mask.exr`);
    const back = direct.read(await readFile(join(folder, output)));
    assert.deepEqual([back.width, back.height, back.pixelSize], [12, 10, 0.5]);
    assert.ok(back.data.subarray(0, 24).every(Number.isNaN));
    assert.ok(deviation(back.data.subarray(24), field.data.subarray(24)) < 1e-4);
  }
});

test('the command tells what is in a file', async () => {
  for (const name of ['several.npz', 'geo-metres.tif', 'colour.jpg']) await copyFile(join(root, 'tests/data', name), join(folder, name));
  const arrays = await run(folder, 'info several.npz');
  assert.match(arrays.stdout, /^format: +npz\narray: +depth, 3 × 4, f64\narray: +confidence, 3 × 4, u8\narray: +name, 1, <U1\n$/);
  const one = await run(folder, 'info several.npz --array confidence');
  assert.match(one.stdout, /values: +3 to 80\n/);
  const tiff = await run(folder, 'info geo-metres.tif');
  for (const line of [
    /^format: +tiff$/m, /^size: +4 × 3 pixels$/m, /^data type: +f32$/m, /^values: +-1\.625 to 8$/m,
    /^no data: +1 pixels$/m, /^pixel size: +0\.5 m$/m, /^height scale: +1$/m,
  ]) assert.match(tiff.stdout, line);
  // Of levels, what they stand for.
  await writeFile(join(folder, 'steps.png'), direct.writeImage({ width: 3, height: 2, data: [1, 2, 3, 4, 5, 6] }, { format: 'png' }));
  assert.match((await run(folder, 'info steps.png')).stdout, /^heights: +1 to 6$/m);
  await refuses(folder, [['info colour.jpg', /colour\.jpg: JPEG: the pixel at row 0/, 3]]);
  const several = await run(folder, 'fit several.npz -o out.npy');
  assert.match(several.stderr, /several\.npz: .*choose one by --array/);
  assert.equal((await run(folder, 'info geo-metres.tif --lambda 3')).status, 2);
});

test('a size of pixels that is given is the one that is solved with and written', async () => {
  // Pixels of 0.5 × 0.6 m on a map, whose upper left corner is at (400000, 5400000).
  /** @type {import('../../pkg/types.js').Georeference} */
  const georeference = { transformation: [0.5, 0, 4e5, 0, -0.6, 5.4e6], keys: [1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001], doubles: [], text: '' };
  const field = image(24, 20, (x, y) => Math.fround(plane(x, y)));
  // Without a size of its own the image has that of the map.
  await writeFile(join(folder, 'map.tif'), direct.writeImage({ ...field, pixelSize: undefined, georeference }, { format: 'tiff' }));
  const told = direct.read(await readFile(join(folder, 'map.tif')), { pixelSize: 2 });
  assert.deepEqual([told.width, told.height, told.pixelSize, told.unit], [24, 20, 2, 'm']);
  const fit = await run(folder, 'fit map.tif -o two.tif --pixel-size 2');
  assert.equal(fit.status, 0);
  assert.match(fit.stderr, /pixels are 2 wide, which was given, and not 0\.5 × 0\.6, which the file says/);
  const back = direct.read(await readFile(join(folder, 'two.tif')));
  assert.deepEqual([back.width, back.pixelSize, back.georeference?.transformation], [24, 2, [2, 0, 4e5, 0, -2, 5.4e6]]);
  const solved = await run(folder, 'fit map.tif -o own.tif --report own.json');
  // What was assumed is the same wherever it is told.
  const { assumptions } = JSON.parse(await readFile(join(folder, 'own.json'), 'utf8'));
  const info = await run(folder, 'info map.tif');
  assert.deepEqual(assumptions, direct.read(await readFile(join(folder, 'map.tif'))).assumptions);
  assert.deepEqual(assumptions.map((/** @type {{ code: string }} */ { code }) => code), ['squarePixels']);
  for (const { words } of assumptions) assert.ok(solved.stderr.includes(`assumed: ${words} (--`) && info.stdout.includes(words), words);
  const own = direct.read(await readFile(join(folder, 'own.tif')));
  // Solved on squares, and written on the pixels of the file, all of them and where they lie.
  assert.deepEqual([own.width, own.height, own.pixelSize, own.georeference?.transformation, own.georeference?.size], [24, 24, 0.5, georeference.transformation, [24, 20]]);
  await direct.init();
  // The surface itself says where it lies, so that whoever writes it need not know its input.
  const surface = direct.fit(direct.read(await readFile(join(folder, 'map.tif'))));
  assert.deepEqual(direct.read(direct.writeImage(surface, { format: 'tiff' })).georeference, own.georeference);
  const array = direct.read(direct.writeImage(surface, { format: 'npy' }));
  assert.deepEqual([array.width, array.height], [24, 20]);
  assert.deepEqual(own.georeference?.keys, georeference.keys);
});
