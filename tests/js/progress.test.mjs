/** How far long calls are, told to `onProgress`. */
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import * as developable from '../../pkg/index.js';
import { gridMesh, lattice } from './support/shapes.mjs';

await direct.init();
await direct.load('files', 'unroll', 'patterns');
after(() => developable.dispose());

/** A dome, which does not lie flat. @param {number} x @param {number} y */
const dome = (x, y) => Math.sqrt(195 ** 2 - (x - 90) ** 2 - (y + 90) ** 2);
const surface = lattice(150, 130, dome);
const small = lattice(24, 20, dome);
const mesh = gridMesh(70, 70, (col, row) => [3 * col, 3 * row, dome(3 * col, -3 * row)]);
/** A white page on black, a little bent. */
const photo = { width: 480, height: 640, data: new Uint8Array(4 * 480 * 640).fill(255) };
const across = (/** @type {number} */ y) => Array.from({ length: 21 }, (_, i) => /** @type {[number, number]} */ ([60 + 18 * i, y + 20 * Math.sin((Math.PI * i) / 20)]));
const edges = { top: across(80), bottom: across(540) };

/** @typedef {{ onProgress?: (progress: import('../../pkg/types.js').CallProgress) => void, signal?: AbortSignal }} Watchable */
/** @type {Record<string, (api: any, options: Watchable) => any>} */
const calls = {
  unroll: (api, options) => api.unroll(surface, { tolerance: 1e-14, ...options }),
  pattern: (api, options) => api.pattern(surface, options),
  unrollMesh: (api, options) => api.unroll(mesh, options),
  patternMesh: (api, options) => api.pattern(mesh, { exact: false, ...options }),
  dewarpPage: (api, options) => api.dewarpPage(photo, edges, options),
};

for (const [name, call] of Object.entries(calls)) {
  test(`${name} tells how far it is, up to the end, in both APIs`, async () => {
    for (const api of [direct, developable]) {
      /** @type {number[]} */
      const told = [];
      await call(api, { onProgress: ({ fraction }) => void told.push(fraction) });
      assert.deepEqual(told, told.toSorted((a, b) => a - b), 'it never falls');
      assert.ok(told[0] > 0 && told[0] < 1 && told.indexOf(1) === told.length - 1, `${told}`);
    }
  });
}

test('what the function throws, the call throws, and the next one works', async () => {
  const error = new RangeError('enough');
  const onProgress = () => { throw error; };
  assert.throws(() => direct.pattern(small, { onProgress }), error);
  await assert.rejects(developable.pattern(small, { onProgress }), error);
  await assert.rejects(developable.pattern(small, { onProgress: async () => { throw error; } }), error);
  assert.throws(() => direct.pattern(small, { onProgress: /** @type {any} */ (async () => {}) }), { code: 'OPTION', message: /promise/ });
  const watched = await developable.pattern(small, { onProgress() {} });
  assert.deepEqual(watched, direct.pattern(small), 'who watches changes nothing');
});

test('a call that is told of can be aborted', async () => {
  const controller = new AbortController();
  const aborted = developable.pattern(surface, { signal: controller.signal, onProgress: () => controller.abort() });
  await assert.rejects(aborted, { name: 'AbortError' });
});

test('calls that tell nothing refuse it', async () => {
  for (const api of [direct, developable]) {
    await assert.rejects(async () => api.patches(surface, /** @type {any} */ ({ onProgress() {} })), { code: 'OPTION', message: /unknown option `onProgress`/ });
  }
});

test('a drawing whose options are wrong is refused before its pattern is made', () => {
  for (const options of [{ scale: -1 }, { tabs: -1 }, { marks: 0.5 }, { kerf: -1 }, { allowance: Infinity }, { thickness: 1, kFactor: 2 }, { stock: /** @type {[number, number]} */ ([-100, 100]) }, { stock: /** @type {[number]} */ ([60000]) }]) {
    let calls = 0;
    const onProgress = () => { calls += 1; };
    for (const call of [() => direct.pattern(small, { ...options, onProgress }), () => direct.pattern(mesh, { ...options, onProgress })]) {
      assert.throws(call, { code: 'OPTION' });
    }
    assert.equal(calls, 0, JSON.stringify(options));
  }
});
