/** The native fixtures through the JavaScript API, image handling included. */
import assert from 'node:assert/strict';
import { readFile, readdir } from 'node:fs/promises';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { deviation } from './support/shapes.mjs';

const folder = new URL('../fixtures/', import.meta.url);
await direct.init();

for (const name of (await readdir(folder)).filter((entry) => entry.endsWith('.json'))) {
  test(name, async () => {
    const { input, options, expected } = JSON.parse(await readFile(new URL(name, folder), 'utf8'));
    for (const key of ['data', 'heights']) if (input[key]) input[key] = numbers(input[key]);
    const surface = direct.fit(input, options);
    close(surface.heights, numbers(expected.heights));
    if (expected.image) close(surface.image?.data ?? [], numbers(expected.image));
    else assert.equal(surface.image, undefined);
    const { seconds, threads, threadLimit, ...report } = /** @type {Record<string, any>} */ (surface.report);
    assert.ok(seconds.total >= 0);
    assert.deepEqual([threads, threadLimit], [1, 'build']);
    figures(report, expected.report, name);
  });
}

/** @param {(number | null)[]} values `null` is no data */
function numbers(values) {
  return Float64Array.from(values, (value) => value ?? NaN);
}

/** @param {ArrayLike<number>} found @param {Float64Array} expected */
function close(found, expected) {
  assert.equal(found.length, expected.length);
  const scale = expected.reduce((most, v) => (Number.isNaN(v) ? most : Math.max(most, Math.abs(v))), 0);
  assert.ok(deviation(found, expected) <= 1e-9 * scale);
}

/** @param {any} found @param {any} expected @param {string} path */
function figures(found, expected, path) {
  if (typeof expected === 'number' && !Number.isInteger(expected)) {
    const scale = path.endsWith('.gap') ? 1 : Math.abs(expected);
    assert.ok(Math.abs(found - expected) <= 1e-9 * scale, `${path} is ${found}, not ${expected}`);
  } else if (typeof expected === 'object') {
    assert.deepEqual(Object.keys(found).sort(), Object.keys(expected).sort(), path);
    for (const key of Object.keys(expected)) figures(found[key], expected[key], `${path}.${key}`);
  } else {
    assert.equal(found, expected, path);
  }
}
