/** Surfaces as pictures: directly and in a worker, without a browser. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { image, lattice, plane } from './support/shapes.mjs';

before(async () => {
  await direct.init();
  await direct.load('unroll');
});
after(() => developable.dispose());

/** @param {{ width: number, data: Uint8ClampedArray }} picture @param {number} row @param {number} col */
const pixel = ({ width, data }, row, col) => [...data.subarray(4 * (row * width + col), 4 * (row * width + col) + 4)];

/** The green of what is shaded, of a plane with these slopes. @param {number[]} slopes @param {number[]} light */
function green([gx, gy], [x, y, z]) {
  const cosine = (z - gx * x - gy * y) / Math.hypot(x, y, z) / Math.hypot(gx, gy, 1);
  return Math.round(255 * (0.15 + 0.85 * Math.max(0, cosine)));
}

test('an image has a picture of its size, a surface that of its image', async () => {
  const input = image(30, 20, plane, 0.5);
  const light = /** @type {const} */ ([1, 2, 3]);
  for (const field of [input, direct.fit(input)]) {
    const drawn = direct.picture(field, { light });
    assert.deepEqual([drawn.width, drawn.height, drawn.data.length], [30, 20, 2400]);
    assert.ok(drawn.data instanceof Uint8ClampedArray);
    for (const place of [[0, 0], [10, 15], [19, 29], [0, 29]]) {
      const [, g, , alpha] = pixel(drawn, place[0], place[1]);
      assert.deepEqual([g, alpha], [green([0.3, -0.2], [...light]), 255], String(place));
    }
  }
  const wide = direct.picture(input, { width: 90 });
  assert.deepEqual([wide.width, wide.height], [90, 60]);
  const coarse = direct.picture(input, { spacing: 1 });
  assert.deepEqual([coarse.width, coarse.height], [15, 10]);
  // The lower left quarter.
  const part = direct.picture(input, { extent: [0, 0, 7.5, 5] });
  assert.deepEqual([part.width, part.height], [15, 10]);
});

test('holes are transparent', () => {
  const input = image(30, 20, (x, y) => (Math.hypot(x - 15, y - 10) < 4 ? NaN : x));
  for (const style of /** @type {const} */ (['shaded', 'curvature', 'patches'])) {
    const drawn = direct.picture(input, { style });
    assert.deepEqual(pixel(drawn, 10, 15), [0, 0, 0, 0]);
    assert.equal(pixel(drawn, 2, 2)[3], 255);
  }
});

test('curvature and patches have their colours', async () => {
  const radius = 80;
  const cap = lattice(61, 51, (x, y) => Math.sqrt(radius ** 2 - (x - 25) ** 2 - (y + 26) ** 2));
  // White where the scale is wide, the red end of RdBu where it is narrow.
  const wide = direct.picture(cap, { style: 'curvature', limit: 1e3 });
  assert.deepEqual(pixel(wide, 26, 25), [247, 247, 247, 255]);
  const narrow = direct.picture(cap, { style: 'curvature', limit: 0.5 / radius ** 2 });
  assert.deepEqual(pixel(narrow, 26, 25), [103, 0, 31, 255]);
  // It bends downwards both ways.
  const kappa2 = direct.picture(cap, { style: 'curvature', curvature: 'kappa2', limit: 0.5 / radius });
  assert.deepEqual(pixel(kappa2, 26, 25), [5, 48, 97, 255]);

  const folded = lattice(60, 60, (x) => 0.6 * Math.abs(x - 30.2));
  const drawn = direct.picture(folded, { style: 'patches' });
  const [left, crease, right] = [pixel(drawn, 25, 5), pixel(drawn, 25, 30), pixel(drawn, 25, 55)];
  assert.notDeepEqual(left, right);
  assert.ok(2 * crease[1] < Math.min(left[1], right[1]), `${left} ${crease} ${right}`);
  // As one patch they have one colour.
  const whole = direct.picture(folded, { style: 'patches', fold: 3 });
  assert.deepEqual(pixel(whole, 25, 5), pixel(whole, 25, 55));
});

test('what cannot be drawn is an error with a code', async () => {
  const input = image(8, 8, plane);
  const nowhere = /** @type {any} */ ({});
  for (const [options, code, message] of /** @type {[any, string, RegExp][]} */ ([
    [{ style: 'shiny' }, 'OPTION', /`style`.*"shiny".*patches/],
    [{ curvature: 'kappa1' }, 'OPTION', /`curvature`/],
    [{ light: [0, 0, -1] }, 'OPTION', /`light`/],
    [{ style: 'curvature', limit: 0 }, 'OPTION', /`limit`/],
    [{ width: 0 }, 'OPTION', /`width`/],
    [{ width: 2 ** 31 }, 'TOO_LARGE', /picture/],
    [{ size: 3 }, 'OPTION', /size/],
    [{ extent: [0, 0, 0, 1] }, 'OPTION', /`extent`.*left less than right/],
  ])) {
    assert.throws(() => direct.picture(input, options), { code, message });
    await assert.rejects(developable.picture(input, options), { code, message });
  }
  assert.throws(() => direct.draw(nowhere, input), { code: 'INPUT', message: /HTMLCanvasElement/ });
  await assert.rejects(developable.draw(nowhere, input), { code: 'INPUT', message: /HTMLCanvasElement/ });
});
