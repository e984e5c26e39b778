/** Meshes and point clouds, seen from a direction of one's choice; files with several arrays. */
import assert from 'node:assert/strict';
import { grid, npy, npz, obj, parseNpy, ply } from './support/files.mjs';
import { choose, drop, open, openFromOneSide, runBy, save, settled, sharedDoorTest, sharedTest } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('./support/files.mjs').Mesh} Mesh */

/** A wedge over the rectangle 3 × 2, without any symmetry: slopes of its top to the right and upwards. */
const [ACROSS, UP] = [0.5, 0.2];
/** @param {number} x @param {number} y */
const top = (x, y) => 1 + ACROSS * x + UP * y;
const corners = /** @type {const} */ ([[0, 0], [3, 0], [3, 2], [0, 2]]);
/** @type {Mesh} */
const wedge = {
  points: [
    ...corners.map(([x, y]) => /** @type {const} */ ([x, y, 0])),
    ...corners.map(([x, y]) => /** @type {const} */ ([x, y, top(x, y)])),
  ],
  triangles: [
    [0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7],
    [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7],
  ],
};

/**
 * The heights of the result at its pixels, with the pixels' places in shares of width and height, y up.
 * @param {Page} page
 */
async function solved(page) {
  await settled(page);
  const { rows, cols, values } = parseNpy((await save(page, 'NPY')).bytes);
  return { rows, cols, points: values.map((z, i) => ({ x: (i % cols) / (cols - 1), y: 1 - Math.floor(i / cols) / (rows - 1), z })) };
}

/** @param {Page} page @param {string} name */
async function from(page, name) {
  await runBy(page, () => choose(page.getByRole('radio', { name, exact: true })));
}

/**
 * @param {{ x: number, y: number, z: number }[]} points
 * @param {(x: number, y: number) => number} expected
 * @param {number} tolerance
 */
function assertHeights(points, expected, tolerance) {
  const inner = points.filter(({ x, y }) => Math.min(x, 1 - x, y, 1 - y) > 0.05);
  assert.ok(inner.length > 1000);
  // Where a view's zero lies is not told.
  const level = inner.reduce((sum, { x, y, z }) => sum + z - expected(x, y), 0) / inner.length;
  const worst = Math.max(...inner.map(({ x, y, z }) => Math.abs(z - expected(x, y) - level)));
  assert.ok(worst < tolerance, `off by ${worst}`);
}

sharedDoorTest('a dropped mesh is turned, and its heights are those seen from there', async (page) => {
  await openFromOneSide(page, 'wedge.obj', obj(wedge));
  assert.match(await page.locator('#mesh-name').innerText(), /wedge \(OBJ\)/);
  assert.match(await page.locator('#mesh-span').innerText(), /^3 × 2 × 2\.9, 12 triangles\.$/);
  assert.ok(await page.locator('#space-after').isVisible(), 'solved at once');

  await from(page, '+z');
  const above = await solved(page);
  assert.ok(Math.abs(above.cols / above.rows - 3 / 2) < 0.05, `${above.cols} × ${above.rows}`);
  assertHeights(above.points, (x, y) => top(3 * x, 2 * y), 0.01);

  // From the right one sees z to the left and y up, and the side there, which is upright.
  await from(page, '+x');
  const right = await solved(page);
  assert.ok(Math.abs(right.cols / right.rows - top(3, 2) / 2) < 0.05, `${right.cols} × ${right.rows}`);
  const seen = right.points.filter(({ z }) => Number.isFinite(z));
  assert.ok(seen.length > 0.8 * right.points.length && seen.length < right.points.length, 'the slanting edge is seen');
  assert.ok(Math.max(...seen.map(({ z }) => z)) - Math.min(...seen.map(({ z }) => z)) < 0.01, 'upright');
});

sharedDoorTest('a point cloud is solved as well, and its result is written as a mesh', async (page) => {
  const points = grid(60, 40, (col, row) => row * 60 + col)
    .map((i) => /** @type {const} */ ([(i % 60) / 20, Math.floor(i / 60) / 20, top((i % 60) / 20, Math.floor(i / 60) / 20)]));
  await open(page, 'cloud.ply', ply({ points, triangles: [] }));
  assert.match(await page.locator('#mesh-name').innerText(), /^cloud \(PLY\)$/);
  assert.match(await page.locator('#mesh-span').innerText(), /2.400 points/);
  await from(page, '+z');
  await settled(page);
  const lines = (await save(page, 'OBJ')).bytes.toString().split('\n').filter((line) => line.startsWith('v '));
  assert.ok(lines.length > 300);
  for (const line of lines) {
    const [x, y, z] = line.split(' ').slice(1).map(Number);
    assert.ok(Math.abs(z - top(x, y)) < 0.02, line);
  }
});

sharedDoorTest('points in text are a point cloud where they lie on no grid', async (page) => {
  const line = (/** @type {number} */ i) => {
    const [x, y] = [((37 * i) % 101) / 35 + 0.005 * Math.sin(i), ((i * i) % 97) / 50 + 0.005 * Math.cos(i)];
    return `${x} ${y} ${top(x, y)}\n`;
  };
  await open(page, 'cloud.xyz', Buffer.from(Array.from({ length: 2400 }, (_, i) => line(i)).join('')));
  assert.match(await page.locator('#mesh-name').innerText(), /^cloud \(XYZ\)$/);
  assert.match(await page.locator('#mesh-span').innerText(), /2.400 points/);
});

sharedTest('a broken mesh gets a message, and what was there stays', async (page) => {
  const shown = () => Promise.all(['#verdict', '#input-caption', '#result-caption'].map((one) => page.locator(one).innerText()));
  const before = await shown();
  for (const [name, bytes] of /** @type {const} */ ([
    ['torn.obj', Buffer.from('v 0 0 0\nv 1 0 0\nf 1 2 9\n')],
    ['cut.ply', ply(wedge).subarray(0, 120)],
    ['none.glb', Buffer.from('glTF')],
  ])) {
    await drop(page, name, bytes);
    await page.getByRole('alert').filter({ hasText: name }).waitFor();
    assert.deepEqual(await shown(), before);
    assert.equal(await page.locator('#mesh-options').isVisible(), false);
  }
});

sharedDoorTest('of an NPZ with several arrays one is chosen', async (page) => {
  const low = grid(30, 20, (col) => 0.1 * col);
  const high = grid(16, 12, (_, row) => 2 * row);
  const rows = npy(5, [1, 2, 3, 4, 5]);
  await open(page, 'scans.npz', npz({ low: npy(30, low), high: npy(16, high), rows }));
  await page.locator('#input-caption', { hasText: '30 × 20' }).waitFor();
  const arrays = page.getByLabel('Array');
  assert.equal(await arrays.inputValue(), 'low');
  await arrays.selectOption('high');
  await page.locator('#input-caption', { hasText: '16 × 12' }).waitFor();
  assert.equal(await arrays.inputValue(), 'high');
  await open(page, 'single.npz', npz({ only: npy(16, high) }));
  await page.locator('#input-caption', { hasText: 'single' }).waitFor();
  assert.equal(await arrays.isVisible(), false);
});

sharedDoorTest('depths from a camera are put where it has seen them', async (page) => {
  // A plane that recedes to the right: its depths are not linear over the image.
  const [width, height, focus, slope] = [80, 60, 70, 0.6];
  const depths = grid(width, height, (col) => 2000 / (1 - (slope * (col - (width - 1) / 2)) / focus));
  await open(page, 'depth_disp.npy', npy(width, depths));
  // By its name they are depths: the surface is built by a guess, which is said as one.
  await page.locator('#mesh-name', { hasText: 'depth_disp (depths)' }).waitFor();
  await settled(page);
  assert.match(await page.locator('#guessed').innerText(), /Assumed: 60° field of view, depths in millimetres, not disparities/);
  assert.match(await page.locator('#verdict').innerText(), /^From this side: /);
  await page.getByLabel('Field of view, °').fill('0');
  await page.getByRole('button', { name: 'Build the 3D surface' }).click();
  assert.match(await page.locator('#guessed').innerText(), /Assumed/, 'no camera has that');
  await page.getByLabel('Field of view, °').fill(String((360 / Math.PI) * Math.atan(width / 2 / focus)));
  await runBy(page, () => page.getByRole('button', { name: 'Build the 3D surface' }).click());
  assert.equal(await page.locator('#guessed').isVisible(), false, 'nothing is guessed any more');
  // In metres, the depths' range among them.
  const range = (Math.max(...depths) - Math.min(...depths)) / 1000;
  const spans = /^([\d.]+) × ([\d.]+) × ([\d.]+) m, /.exec(await page.locator('#mesh-span').innerText())?.slice(1).map(Number) ?? [];
  assert.ok(Math.abs(spans[2] / range - 1) < 0.01, `${spans} against ${range}`);
  const { points } = await solved(page);
  const seen = points.map(({ z }) => z).filter(Number.isFinite);
  assert.ok(Math.max(...seen) - Math.min(...seen) < 1e-3 * range, 'flat, seen straight on');
});
