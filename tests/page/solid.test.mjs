/** Solids for 3D printers: closed, the right way out, and in millimetres. */
import assert from 'node:assert/strict';
import { dispose, readMesh } from '../../pkg/index.js';
import { obj } from './support/files.mjs';
import { drop, saveAs, sharedTest } from './support/page.mjs';

/**
 * The triangles of a binary STL: its edges that have no opposite one, its volume and its sides.
 * @param {Buffer} bytes
 */
function measure(bytes) {
  const edges = new Map();
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  let volume = 0;
  for (let at = 84; at < bytes.length; at += 50) {
    const [a, b, c] = [0, 1, 2].map((corner) => [0, 1, 2].map((k) => bytes.readFloatLE(at + 12 + 12 * corner + 4 * k)));
    for (const place of [a, b, c]) place.forEach((value, k) => ([low[k], high[k]] = [Math.min(low[k], value), Math.max(high[k], value)]));
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    for (const [from, to] of [[a, b], [b, c], [c, a]]) {
      const [there, back] = [`${from} ${to}`, `${to} ${from}`];
      if (edges.get(back)) edges.set(back, edges.get(back) - 1);
      else edges.set(there, (edges.get(there) ?? 0) + 1);
    }
  }
  return { open: [...edges.values()].filter((count) => count > 0).length, volume, sides: high.map((value, k) => value - low[k]), lowest: low[2] };
}

sharedTest('heights on a base are a solid, as STL and as a 3MF that can be opened', async (page) => {
  await page.locator('#end-file').click();
  await page.locator('#save-formats input[value="solid.stl"]').check();
  await page.getByLabel('Longest side when printed, mm').fill('90');
  await page.getByLabel('Base at its thinnest, mm').fill('3');
  await page.getByLabel('Base at its thinnest, mm').blur();
  const { open, volume, sides, lowest } = measure((await saveAs(page, 'Solid STL')).bytes);
  assert.equal(open, 0, 'closed');
  assert.ok(Math.abs(Math.max(...sides) - 90) < 0.01 && lowest === 0, String(sides));
  assert.ok(volume > 0.9 * 3 * sides[0] * sides[1] * 0.5, `its faces look outwards: ${volume}`);

  await page.locator('#end-file').click();
  const { bytes } = await saveAs(page, 'Solid 3MF');
  const { positions, unit } = await readMesh(bytes);
  assert.equal(unit, 'mm');
  assert.ok(Math.abs(Math.max(...positions) - Math.min(...positions) - 180) < 0.1, 'its longest side is the one that is offered');
  dispose();
});

sharedTest('an open mesh becomes a shell, and a caution is said', async (page) => {
  // A tent of two faces, folded by 90°.
  const [points, triangles] = [/** @type {[number, number, number][]} */ ([]), /** @type {[number, number, number][]} */ ([])];
  for (let i = 0; i < 9; i++) {
    for (let j = 0; j < 9; j++) {
      points.push([10 * i, 10 * j, 40 - Math.abs(10 * i - 40)]);
      const corner = 9 * i + j;
      if (i < 8 && j < 8) triangles.push([corner, corner + 9, corner + 10], [corner, corner + 10, corner + 1]);
    }
  }
  await drop(page, 'tent.obj', obj({ points, triangles }));
  await page.locator('#mesh-name', { hasText: 'tent' }).waitFor();
  const whole = page.getByRole('radio', { name: 'Whole mesh', exact: true });
  if (!(await whole.isChecked())) await whole.locator('..').click();
  await page.locator('#end-file:enabled').click();
  const { bytes } = await saveAs(page, 'Solid STL');
  const { open, volume } = measure(bytes);
  assert.equal(open, 0, 'closed');
  // Two faces of 80 by 40√2 mm, 2 mm thick.
  const expected = 2 * 2 * 80 * 40 * Math.SQRT2;
  assert.ok(Math.abs(volume - expected) < 0.1 * expected, `${volume} for ${expected}`);
});
