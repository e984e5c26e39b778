/** Files that belong together: depths with their photo and camera, scans with their textures; and a part of the photo. */
import assert from 'node:assert/strict';
import { meets } from '../js/support/phone.mjs';
import { normal, smoothNoise } from '../../tools/bench/phone/sensor.mjs';
import { grid, npy, png16 } from './support/files.mjs';
import { parsed } from './support/numbers.mjs';
import { choose, doorTest, drop, dropAll, look, open, pageTest, painted, runBy, saveAs } from './support/page.mjs';
import { camera, dots, dottedPhoto, misplaced, parsePng, png, seen } from './support/photos.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {[number, number]} Place */

/** The depth camera sees what the photo does, more coarsely. */
const coarse = camera.width / 256;
const depthCamera = {
  width: 256, height: 192, fx: camera.fx / coarse, fy: camera.fy / coarse,
  cx: (camera.cx + 0.5) / coarse - 0.5, cy: (camera.cy + 0.5) / coarse - 0.5,
};
/** Metres, `beside` the page what lies there. @param {number} beside */
const depths = (beside) => grid(256, 192, (col, row) => meets(depthCamera, col, row)?.[0] ?? beside);
const photo = dottedPhoto();
const coloured = png({ width: 16, height: 16, data: Uint8Array.from({ length: 1024 }, (_, i) => [200, 100, 50, 255][i % 4]) });
const { width, height, fx, fy, cx, cy } = camera;
const numbers = Buffer.from(JSON.stringify({ w: width, h: height, K: [fx, 0, 0, 0, fy, 0, cx, cy, 1] }));

/** @param {Page} page */
async function flattened(page) {
  await page.locator('#analysis[aria-busy="false"]').waitFor();
  await painted(page);
}

/** @param {Page} page */
async function flatPng(page) {
  await flattened(page);
  await page.locator('#flat-save').click();
  return parsePng((await saveAs(page, 'PNG')).bytes);
}

/** From pixels of the photo to those of the page. @param {Page} page @param {Place} place @returns {Promise<Place>} */
async function onPage(page, [x, y]) {
  const box = await page.locator('#photo-over').boundingBox();
  assert.ok(box);
  return [box.x + ((x + 0.5) / width) * box.width, box.y + ((y + 0.5) / height) * box.height];
}

doorTest('depths, photo and camera in one drop come out flat', async (page) => {
  // Two millimetres of a sensor's noise.
  const noise = smoothNoise(256, 192, 2, normal(3));
  const noisy = depths(0).map((depth, i) => depth && depth + 0.002 * noise[i]);
  await runBy(page, () => dropAll(page, { 'IMG_1.png': photo, 'depth.npy': npy(256, noisy), 'camera.json': numbers }));
  await page.locator('#about-view .said', { hasText: 'Made flat' }).waitFor();
  assert.equal(await page.locator('#photo-name').innerText(), 'IMG_1.png');
  assert.equal(await page.locator('#mesh-name').innerText(), 'depth (depths)');
  assert.match(await page.locator('#about-view .said').innerText(), /one profile/);
  const error = misplaced(await flatPng(page));
  assert.ok(error < 0.004, `dots are off by ${100 * error} % of the width`);
});

doorTest('what is known of depths is dropped with them, and what is not is said', async (page) => {
  // A table at the page's own depth beside it: by the mask none of it is left. The middle is not to be trusted.
  const scene = depths(0.45).map((depth, i) => (Math.hypot((i % 256) - 128, Math.floor(i / 256) - 96) < 9 ? 0.3 : depth));
  const mask = grid(256, 192, (col, row) => (meets(depthCamera, col, row) ? 65535 : 0));
  const trust = grid(256, 192, (col, row) => (Math.hypot(col - 128, row - 96) < 10 ? 0 : 2));
  await runBy(page, () => dropAll(page, {
    'IMG_1.png': photo, 'depth.npy': npy(256, scene), 'camera.json': numbers,
    'confidence.png': png16(256, trust), 'IMG_1_mask.png': png16(256, mask), 'notes.md': Buffer.from('a page'),
  }));
  await page.getByRole('alert').filter({ hasText: 'Left out: “notes.md”' }).waitFor();
  assert.equal(await page.locator('#mesh-name').innerText(), 'depth (depths, with confidence.png and IMG_1_mask.png)');
  const flat = await flatPng(page);
  const error = misplaced(flat);
  assert.ok(error < 0.005, `dots are off by ${100 * error} % of the width`);
  assert.ok(Math.abs(flat.width / flat.height / (0.21 / 0.297) - 1) < 0.1, `${flat.width} × ${flat.height}: the page alone`);

  // What cannot be used is said with its name.
  await dropAll(page, { 'depth.npy': npy(256, scene), 'confidence.png': coloured });
  await page.getByRole('alert').filter({ hasText: 'confidence.png' }).filter({ hasText: 'colour' }).waitFor();
});

doorTest('the camera is assumed until its file is opened', async (page) => {
  await dropAll(page, { 'depth.png': png16(256, depths(0).map((depth) => Math.round(10000 * depth))), 'IMG_1.png': photo });
  // Built by a guess, with the photo on it at once.
  await page.locator('#guessed', { hasText: 'Assumed: 60° field of view' }).waitFor();
  assert.ok(await page.getByRole('radio', { name: 'Photo', exact: true }).isChecked());
  await page.locator('#certificate').waitFor();
  await page.locator('#analysis[data-view="photo"][aria-busy="false"]').waitFor({ state: 'attached' });
  await painted(page);
  assert.ok((await look(page, 'result')).roughness > 1, 'dots on the surface');
  assert.ok(await page.getByLabel('These are depths from a camera').isChecked());
  // A tenth of a millimetre.
  await page.getByLabel('Depth scale').fill('0.0001');
  await page.getByLabel('Depth scale').press('Tab');
  assert.match(await page.locator('#camera-span').innerText(), /0\.3\d* to 0\.\d+ away/);
  const { fx, fy, cx, cy } = depthCamera;
  await page.locator('#camera-file').setInputFiles({ name: 'camera.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify({ fx, fy, cx, cy })) });
  await page.locator('#camera-about', { hasText: `centre ${cx}, ${cy}` }).waitFor();
  await runBy(page, () => page.getByRole('button', { name: 'Build the 3D surface' }).click());
  await choose(page.getByRole('radio', { name: 'Flat photo', exact: true }));
  await runBy(page, () => page.getByRole('button', { name: 'Solve', exact: true }).click());
  const error = misplaced(await flatPng(page));
  assert.ok(error < 0.006, `dots are off by ${100 * error} % of the width`);
}, { drawn: true });

doorTest('a camera that cannot belong to the image is refused', async (page) => {
  await open(page, 'depth.npy', npy(256, depths(0)));
  // A surface is built by an assumed camera; the end of that would hide a message about another file.
  await page.locator('#verdict').filter({ hasText: 'From this side' }).waitFor();
  await page.getByLabel('These are depths from a camera').check();
  await drop(page, 'other.json', Buffer.from(JSON.stringify({ name: 'a phone' })));
  await page.getByRole('alert').filter({ hasText: 'other.json' }).filter({ hasText: 'no camera in it' }).waitFor();
  await drop(page, 'far.csv', Buffer.from('900,0,2000\n0,900,1500\n0,0,1\n'));
  await page.getByRole('alert').filter({ hasText: 'far from the middle' }).waitFor();
});

pageTest('a scan in OBJ brings its material and texture along', async (page) => {
  // The page of the photo, seen from above: its texture is the flat page.
  const [n, m, radius] = [40, 12, 0.12];
  const lines = ['mtllib page.mtl', 'usemtl paper'];
  for (let j = 0; j <= m; j++) {
    for (let i = 0; i <= n; i++) {
      const angle = ((i / n - 0.5) * 0.21) / radius;
      lines.push(`v ${radius * Math.sin(angle)} ${0.297 * (j / m - 0.5)} ${radius * Math.cos(angle)}`, `vt ${i / n} ${j / m}`);
    }
  }
  for (let j = 0; j < m; j++) {
    for (let i = 0; i < n; i++) {
      const [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([x, y]) => y * (n + 1) + x + 1);
      lines.push(`f ${a}/${a} ${b}/${b} ${c}/${c}`, `f ${a}/${a} ${c}/${c} ${d}/${d}`);
    }
  }
  await dropAll(page, {
    'page.obj': Buffer.from(`${lines.join('\n')}\n`),
    'page.mtl': Buffer.from('newmtl paper\nmap_Kd page.png\n'),
    'page.png': flatDots(420, 594),
  });
  await page.locator('#mesh-name', { hasText: 'page (OBJ)' }).waitFor();
  assert.doesNotMatch(await page.locator('#mesh-span').innerText(), /Without/);
  await choose(page.getByRole('radio', { name: 'Flat photo', exact: true }));
  await runBy(page, () => page.getByRole('button', { name: 'Solve', exact: true }).click());
  const error = misplaced(await flatPng(page));
  assert.match(await page.locator('#photo-name').innerText(), /texture/);
  assert.ok(error < 0.004, `dots are off by ${100 * error} % of the width`);
});

doorTest('heights in another unit, and levels that are guessed, are asked about', async (page) => {
  // A photo before what it shows.
  await drop(page, 'holiday.png', coloured);
  await page.locator('#page-caption', { hasText: 'holiday' }).waitFor();
  await page.getByRole('alert').getByRole('button', { name: 'Heights instead?' }).click();
  await page.getByRole('alert').filter({ hasText: 'holiday.png' }).filter({ hasText: 'Open the depths' }).waitFor();
  const assumed = page.locator('#guessed');
  await open(page, 'metres.npy', npy(60, grid(60, 40, (col) => 0.08 * Math.sin(col / 20))));
  assert.match(await assumed.innerText(), /pixels are 0\.00\d wide: .*relief of 0\.0\d.*too flat.*depths/s);
  const side = Number(await page.getByLabel('Pixel size').inputValue());
  await runBy(page, () => page.getByRole('button', { name: 'Steeper' }).click());
  assert.ok(Math.abs(Number(await page.getByLabel('Pixel size').inputValue()) / side - 0.5) < 1e-9);
  assert.doesNotMatch(await assumed.innerText(), /pixels are/, 'what is decided is not assumed');
  await choose(page.getByRole('radio', { name: 'Flat photo', exact: true }));
  await flattened(page);
  assert.equal(await page.locator('#photo-name').innerText(), 'holiday.png');

  await open(page, 'levels.png', png16(60, grid(60, 40, (col) => 20000 + 100 * col)));
  assert.match(await assumed.innerText(), /from black to white is a quarter of the longer side/);
  // And after it, from another file.
  await choose(page.getByRole('radio', { name: 'Shaded', exact: true }));
  await drop(page, 'later.png', coloured);
  await page.locator('#photo-name', { hasText: 'later.png' }).waitFor();
  await flattened(page);
});

/** The flat page itself. @param {number} wide @param {number} high */
function flatDots(wide, high) {
  const data = new Uint8Array(4 * wide * high).fill(255);
  for (let i = 0; i < wide * high; i++) {
    const [s, t] = [(((i % wide) + 0.5) / wide) * dots.across, ((Math.floor(i / wide) + 0.5) / high) * dots.down];
    const off = Math.hypot(((s % 1) - 0.5) * (0.21 / dots.across), ((t % 1) - 0.5) * (0.297 / dots.down));
    data.fill(off < 0.008 ? 20 : 240, 4 * i, 4 * i + 3);
  }
  return png({ width: wide, height: high, data });
}
