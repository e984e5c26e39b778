/** The synchronous API. The order matters: at first nothing is loaded, at last the instance breaks. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { initSync, loadSync } from '../../pkg/sync.js';
import { error } from './support/error.mjs';
import { filesWasmFile, wasmFile } from './support/paths.mjs';
import { cylinder, deviation, endless, image, lattice, noisy, placeOf, plane } from './support/shapes.mjs';

const ramp = image(12, 10, plane);

test('before init every function says so', () => {
  assert.throws(() => direct.fit(ramp), error('NOT_INITIALIZED', /init\(\)/));
  assert.throws(() => new direct.Solver(ramp), error('NOT_INITIALIZED'));
  assert.throws(() => direct.read(new Uint8Array(8)), error('NOT_INITIALIZED', /load\('images'\)/));
});

test('an init that fails can be tried again, one that is done stays', async () => {
  await assert.rejects(direct.init(new Uint8Array([1, 2, 3])), error('INIT'));
  await assert.rejects(direct.init('does-not-exist.wasm'), error('INIT', /does-not-exist/));
  await assert.rejects(direct.init(Promise.reject(new Error('no luck'))), error('INIT', /no luck/));
  await assert.rejects(direct.init(/** @type {any} */ (7)), error('INIT'));
  assert.throws(() => initSync(new Uint8Array([1, 2, 3])), error('INIT'));
  const first = direct.init(readFile(wasmFile));
  assert.equal(direct.init('does-not-exist.wasm'), first);
  await first;
  initSync(new Uint8Array(0));
});

test('files have a wasm of their own', async () => {
  assert.throws(() => direct.writeImage(ramp), error('NOT_INITIALIZED', /load\('files'\)/));
  await assert.rejects(direct.load({ files: 'does-not-exist.wasm' }), error('INIT', /does-not-exist/));
  loadSync({ files: await readFile(filesWasmFile) });
  await direct.load({ files: 'does-not-exist.wasm' }); // it is there already
  assert.equal(direct.read(direct.writeImage(ramp)).width, ramp.width);
});

test('a plane comes back', () => {
  const surface = direct.fit(ramp);
  assert.equal(surface.report.stopReason, 'rounding');
  assert.ok(surface.image);
  assert.ok(deviation(surface.image.data, ramp.data) < 1e-9);
  assert.equal(surface.heights.length, surface.rows * surface.cols);
  for (const [i, z] of surface.heights.entries()) {
    const [x, y] = placeOf(surface, i);
    assert.ok(Number.isNaN(z) || Math.abs(z - plane(x, y)) < 1e-9, `vertex ${i}`);
  }
});

test('a lattice goes in and out as it is, without the spacing option', () => {
  const input = lattice(20, 24, (x, y) => cylinder(12)(x, -y), 0.5);
  const surface = direct.fit({ ...input, origin: [3, 4] }, { lambda: 'big' });
  assert.deepEqual([surface.rows, surface.cols, surface.spacing, surface.origin, surface.image], [20, 24, 0.5, [3, 4], undefined]);
  assert.ok(deviation(surface.heights, input.heights) < 0.1);
  assert.throws(() => direct.fit(input, { spacing: 1 }), error('OPTION', /spacing/));
});

test('no data by NaN, mask or value stays no data', () => {
  const masked = { ...ramp, data: ramp.data.slice(), mask: new Uint8Array(ramp.data.length).fill(1), noData: -9999.9 };
  masked.data[0] = NaN;
  masked.mask[11] = 0;
  masked.data[108] = -9999.9;
  /** @param {import('../../pkg/types.js').HeightImage} input */
  const gaps = (input) => {
    const out = direct.fit(input).image;
    assert.ok(out);
    return [...out.data.keys()].filter((i) => Number.isNaN(out.data[i]));
  };
  assert.deepEqual(gaps(masked), [0, 11, 108]);
  // In 32 bits the value is another one, and is still meant.
  assert.deepEqual(gaps({ ...masked, data: Float32Array.from(masked.data) }), [0, 11, 108]);
});

test('every kind of numbers is taken, and scaled', () => {
  const levels = [...ramp.data].map((_, i) => i % 12);
  const kinds = [
    Array, Int8Array, Uint8Array, Uint8ClampedArray, Int16Array, Uint16Array, Int32Array, Uint32Array,
    Float32Array, Float64Array,
  ];
  for (const kind of kinds) {
    const data = /** @type {{ from: (values: number[]) => direct.Numbers }} */ (kind).from(levels);
    const surface = direct.fit({ width: 12, height: 10, data, heightScale: 0.25 });
    assert.ok(surface.image && Math.abs(surface.image.data[5] - 1.25) < 1e-9, kind.name);
  }
});

test('wrong inputs and options are named', () => {
  /** @param {object} input @param {object} [options] */
  const fit = (input, options) => () => direct.fit(/** @type {any} */ (input), options);
  const { width, height, data } = ramp;
  assert.throws(fit(/** @type {any} */ (null)), error('INPUT', /image.*lattice/));
  assert.throws(fit({ width, height }), error('INPUT', /image.*lattice/));
  assert.throws(fit({ width: 12.5, height, data }), error('INPUT', /width.*12\.5/));
  assert.throws(fit({ width: '12', height, data }), error('INPUT', /width.*"12"/));
  assert.throws(fit({ width, height, data: 'abc' }), error('INPUT', /data.*"abc"/));
  assert.throws(fit({ width, height, data: new BigInt64Array(120) }), error('INPUT', /data.*BigInt64Array/));
  assert.throws(fit({ width, height, data: [1, null] }), error('INPUT', /data\[1\].*null/));
  assert.throws(fit({ ...ramp, mask: 'all' }), error('INPUT', /mask/));
  assert.throws(fit({ ...ramp, mask: [1] }), error('SHAPE', /mask/));
  assert.throws(fit({ ...ramp, mask: new Uint8Array(3) }), error('SHAPE', /mask/));
  assert.throws(fit({ ...ramp, noData: '0' }), error('INPUT', /noData/));
  assert.throws(fit({ ...ramp, pixelSize: 0 }), error('OPTION', /pixelSize/));
  assert.throws(fit({ rows: 3, cols: 3, heights: new Array(9).fill(0) }), error('INPUT', /spacing/));
  assert.throws(fit({ ...lattice(3, 3, plane), origin: [1] }), error('INPUT', /origin/));
  assert.throws(fit({ width: 3, height, data }), error('SHAPE', /120.*30/));
  assert.throws(fit({ width: 2 ** 20, height: 2 ** 20, data }), error('TOO_LARGE'));
  assert.throws(fit({ width: 2 ** 32, height, data }), error('TOO_LARGE'));
  assert.throws(fit({ width: 0, height: 0, data: [] }), error('EMPTY'));
  assert.throws(fit({ width: 2, height: 2, data: [0, 1, Infinity, 0] }), error('NOT_FINITE', /row 1, column 0/));
  assert.throws(fit({ width: 2, height: 2, data: [0, 1, 2, 3] }), error('NO_INTERIOR'));

  assert.throws(fit(ramp, { lambda: 'huge' }), error('OPTION', /lambda.*huge/));
  assert.throws(fit(ramp, { lambda: -1 }), error('OPTION', /lambda.*-1/));
  // What JSON does not know, and what is left out.
  for (const lambda of [() => 1, Symbol('big')]) assert.throws(fit(ramp, { lambda }), error('OPTION', /lambda/));
  assert.throws(() => direct.example(/** @type {any} */ (undefined)), error('OPTION', /example/));
  assert.throws(fit(ramp, { gap: '0.1' }), error('OPTION', /gap.*0\.1/));
  assert.throws(fit(ramp, { gap: null }), error('OPTION', /gap.*null/));
  assert.throws(fit(ramp, { maxIterations: 1.5 }), error('OPTION', /maxIterations.*1\.5/));
  assert.throws(fit(ramp, { schedule: 'fast' }), error('OPTION', /schedule.*fast/));
  assert.throws(fit(ramp, { normalize: 1 }), error('OPTION', /normalize/));
  assert.throws(fit(ramp, { spacing: -1 }), error('OPTION', /spacing/));
  assert.throws(() => new direct.Solver(ramp, /** @type {any} */ (7)), error('OPTION', /object/));
  assert.equal(direct.fit(ramp, { gap: undefined }).report.stopReason, 'rounding');
});

test('a solver runs in steps of the asked-for length', () => {
  const { input, options } = endless();
  const solver = new direct.Solver(input, options);
  // What comes before the first iteration is done in steps as well.
  assert.deepEqual([solver.progress().iteration, solver.progress().level > 0], [0, true]);
  while (solver.progress().cgIterations === 0) assert.equal(solver.advance(0), true);
  for (const milliseconds of [0, 10, 40]) {
    const before = solver.progress();
    const start = performance.now();
    assert.equal(solver.advance(milliseconds), true);
    const spent = performance.now() - start;
    assert.notDeepEqual(solver.progress(), before);
    // It comes back at all: the solve has no end of its own.
    assert.ok(spent >= milliseconds * 0.5, `${spent} ms for ${milliseconds}`);
  }
  const running = solver.surface();
  solver.cancel();
  assert.equal(solver.advance(1), false);
  const { report, heights } = solver.surface();
  assert.equal(report.stopReason, 'cancelled');
  assert.deepEqual(heights, running.heights);
  solver.dispose();
});

test('arrays that were handed out stay as they are', () => {
  const solver = new direct.Solver(image(30, 30, noisy(cylinder(30), 0.5)), { gap: 1e-9 });
  const early = solver.surface();
  const kept = early.heights.slice();
  while (solver.advance(5));
  const late = solver.surface();
  assert.deepEqual(early.heights, kept);
  assert.ok(deviation(late.heights, kept) > 0);
  solver.dispose();
  direct.fit(endless(200).input, { maxIterations: 3 }); // new memory over the old
  assert.deepEqual(early.heights, kept);
  assert.equal(late.heights.buffer.byteLength, late.heights.byteLength);
});

test('after disposal there is an error instead of a crash', () => {
  const solver = new direct.Solver(ramp);
  assert.equal(solver.disposed, false);
  solver.dispose();
  solver.dispose();
  solver[Symbol.dispose]();
  assert.equal(solver.disposed, true);
  assert.throws(() => solver.advance(1), error('DISPOSED'));
  assert.throws(() => solver.progress(), error('DISPOSED'));
  assert.throws(() => solver.cancel(), error('DISPOSED'));
  assert.throws(() => solver.surface(), error('DISPOSED'));
});

test('progress is told, and `false` stops', () => {
  const { input, options } = endless();
  let calls = 0;
  const surface = direct.fit(input, { ...options, onProgress: () => ++calls < 3 });
  assert.equal(surface.report.stopReason, 'cancelled');
  assert.ok(calls >= 3);
});

test('a callback that is async is refused where nothing can wait for it', async () => {
  const { input, options } = endless();
  /** @type {unknown[]} */
  const unhandled = [];
  /** @param {unknown} reason */
  const listen = (reason) => unhandled.push(reason);
  process.on('unhandledRejection', listen);
  const onProgress = /** @type {any} */ (async () => Promise.reject(new Error('mine')));
  const refused = { code: 'OPTION', message: /`onProgress` returned a promise.*promise API/ };
  assert.throws(() => direct.fit(input, { ...options, maxIterations: 400, onProgress }), refused);
  assert.throws(() => direct.fit(image(12, 10, plane), { onProgress }), refused);
  await new Promise((resolve) => setImmediate(resolve));
  process.off('unhandledRejection', listen);
  assert.deepEqual(unhandled, []);
});

test('disposal gives the memory back', () => {
  const { input } = endless(200);
  const solve = () => {
    const solver = new direct.Solver(input);
    solver.advance(0);
    solver.dispose();
  };
  solve();
  const before = process.memoryUsage().arrayBuffers;
  for (let i = 0; i < 20; i += 1) solve();
  // A leak would add more than 90 bytes for each of 45,000 vertices, 20 times.
  assert.ok(process.memoryUsage().arrayBuffers - before < 27e6);
});
