/** Files that belong together: depths with their photo and camera, scans with their textures. */
import assert from 'node:assert/strict';
import { unzipSync } from 'fflate';
import { writePhoto } from '../../pkg/direct.js';
import { meets } from '../js/support/phone.mjs';
import { gridMesh } from '../js/support/shapes.mjs';
import { grid, npy, parseNpy, png16 } from './support/files.mjs';
import { choose, downloaded, drop, dropAll, look, open, painted, runBy, settled, sharedDoorTest, sharedTest } from './support/page.mjs';
import { camera, dots, dottedPhoto, png } from './support/photos.mjs';

/** @typedef {import('playwright-core').Page} Page */

/** The depth camera sees what the photo does, more coarsely. */
const coarse = camera.width / 256;
const depthCamera = {
  width: 256, height: 192, fx: camera.fx / coarse, fy: camera.fy / coarse,
  cx: (camera.cx + 0.5) / coarse - 0.5, cy: (camera.cy + 0.5) / coarse - 0.5,
};
/** Metres, `beside` the page what lies there. @param {number} beside */
const depths = (beside) => grid(256, 192, (col, row) => meets(depthCamera, col, row)?.[0] ?? beside);
const photo = dottedPhoto();
const { width, height, fx, fy, cx, cy } = camera;
/** The photo's camera as OpenCV writes it. */
const calibration = Buffer.from(`<?xml version="1.0"?>\n<opencv_storage>\n<image_width>${width}</image_width>\n<image_height>${height}</image_height>\n` +
  `<camera_matrix type_id="opencv-matrix">\n<rows>3</rows><cols>3</cols><dt>d</dt>\n<data>\n${fx} 0. ${cx} 0. ${fy} ${cy} 0. 0. 1.</data></camera_matrix>\n</opencv_storage>\n`);

/** Whether the dots of the photo are seen on the surface. @param {Page} page */
async function dotsOnSurface(page) {
  assert.ok(await page.getByRole('radio', { name: 'Photo', exact: true }).isChecked());
  await page.locator('#stage[data-busy="false"]:has(#analysis[data-view="photo"])').waitFor({ state: 'attached' });
  await painted(page);
  return (await look(page, 'result')).roughness > 1;
}

sharedDoorTest('depths, photo and camera in one drop are a surface with the photo on it', async (page) => {
  await runBy(page, () => dropAll(page, { 'IMG_1.png': photo, 'depth.npy': npy(256, depths(0)), 'camera.xml': calibration, 'notes.md': Buffer.from('a page') }));
  await page.getByRole('alert').filter({ hasText: 'Left out: “notes.md”. With depths go one photo' }).waitFor();
  assert.equal(await page.locator('#mesh-name').innerText(), 'depth (depths)');
  assert.ok(await dotsOnSurface(page));
}, { drawn: true });

sharedDoorTest('the camera is assumed until its file is opened', async (page) => {
  await dropAll(page, { 'depth.png': png16(256, depths(0).map((depth) => Math.round(10000 * depth))), 'IMG_1.png': photo });
  // Built by a guess, with the photo on it at once.
  await page.locator('#guessed', { hasText: 'Assumed: 60° field of view' }).waitFor();
  await page.locator('#certificate').waitFor();
  assert.ok(await dotsOnSurface(page));
  assert.ok(await page.getByLabel('These are depths from a camera').isChecked());
  // A tenth of a millimetre.
  await page.getByLabel('Depth scale').fill('0.0001');
  await page.getByLabel('Depth scale').press('Tab');
  assert.match(await page.locator('#camera-span').innerText(), /0\.3\d* to 0\.\d+( m)? away/);
  const { fx, fy, cx, cy } = depthCamera;
  await page.locator('#camera-file').setInputFiles({ name: 'camera.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify({ fx, fy, cx, cy })) });
  await page.locator('#camera-about', { hasText: `centre ${cx}, ${cy}` }).waitFor();
  await runBy(page, () => page.getByRole('button', { name: 'Build the 3D surface' }).click());
  assert.equal(await page.locator('#guessed').isVisible(), false, 'nothing is guessed any more');
}, { drawn: true });

sharedDoorTest('a camera that cannot belong to the image is refused', async (page) => {
  await open(page, 'depth.npy', npy(256, depths(0)));
  // A surface is built by an assumed camera; the end of that would hide a message about another file.
  await page.locator('#verdict').filter({ hasText: 'From this side' }).waitFor();
  await page.getByLabel('These are depths from a camera').check();
  await drop(page, 'other.json', Buffer.from(JSON.stringify({ name: 'a phone' })));
  await page.getByRole('alert').filter({ hasText: 'other.json' }).filter({ hasText: 'no camera in it' }).waitFor();
  await drop(page, 'far.csv', Buffer.from('900,0,2000\n0,900,1500\n0,0,1\n'));
  await page.getByRole('alert').filter({ hasText: 'far from the middle' }).waitFor();
});

sharedTest('a scan in OBJ brings its material and texture along', async (page) => {
  // The page of the photo, seen from above: its texture is the flat page.
  const [n, m, radius] = [40, 12, 0.12];
  const lines = ['mtllib page.mtl', 'usemtl paper'];
  const { triangles } = gridMesh(n + 1, m + 1, (i, j) => {
    const angle = ((i / n - 0.5) * 0.21) / radius;
    const place = /** @type {const} */ ([radius * Math.sin(angle), 0.297 * (j / m - 0.5), radius * Math.cos(angle)]);
    lines.push(`v ${place.join(' ')}`, `vt ${i / n} ${j / m}`);
    return [...place];
  });
  for (let i = 0; i < triangles.length; i += 3) lines.push(`f ${Array.from(triangles.subarray(i, i + 3), (v) => `${v + 1}/${v + 1}`).join(' ')}`);
  await dropAll(page, {
    'page.obj': Buffer.from(`${lines.join('\n')}\n`),
    'page.mtl': Buffer.from('newmtl paper\nmap_Kd page.png\n'),
    'page.png': flatDots(420, 594),
  });
  await page.locator('#mesh-name', { hasText: 'page (OBJ)' }).waitFor();
  assert.doesNotMatch(await page.locator('#mesh-span').innerText(), /Without/);
  await settled(page);
  await choose(page.getByRole('radio', { name: 'Photo', exact: true }));
  assert.ok(await dotsOnSurface(page));
}, { drawn: true });

sharedDoorTest('heights in another unit, and levels that are guessed, are asked about', async (page) => {
  const [width, height] = [60, 40];
  await drop(page, 'grey.jpg', Buffer.from(writePhoto({ width, height, data: new Uint8Array(4 * width * height).map((_, i) => (i % 4 === 3 ? 255 : (i >> 2) % width)) }, { format: 'jpeg' })));
  await page.locator('#page-caption', { hasText: 'grey' }).waitFor();
  await page.getByRole('alert').getByRole('button', { name: 'Heights instead?' }).click();
  await page.locator('#input-caption', { hasText: 'grey' }).waitFor({ state: 'attached' });
  const assumed = page.locator('#guessed');
  await open(page, 'metres.npy', npy(60, grid(60, 40, (col) => 0.08 * Math.sin(col / 20))));
  assert.match(await assumed.innerText(), /pixels are 0\.00\d wide: .*relief of 0\.0\d.*too flat.*depths/s);
  const side = Number(await page.getByLabel('Pixel size').inputValue());
  await runBy(page, () => page.getByRole('button', { name: 'Steeper' }).click());
  assert.ok(Math.abs(Number(await page.getByLabel('Pixel size').inputValue()) / side - 0.5) < 1e-9);
  assert.doesNotMatch(await assumed.innerText(), /pixels are/, 'what is decided is not assumed');
  await open(page, 'levels.png', png16(60, grid(60, 40, (col) => 20000 + 100 * col)));
  assert.match(await assumed.innerText(), /from black to white is a quarter of the longer side/);
});

sharedDoorTest('several scans are cleaned into one ZIP, and what fails is left out with its reason', async (page) => {
  const [small, large] = [npy(40, grid(40, 30, (col, row) => 0.1 * Math.abs(col - 20) + 0.02 * row)), npy(60, grid(60, 40, (col) => 0.1 * col))];
  await dropAll(page, { 'b.npy': small, 'a.npy': large, 'broken.npy': Buffer.from('no numbers') });
  await page.getByRole('button', { name: 'Clean all 3 into one ZIP…' }).click();
  await page.locator('#save-formats').getByRole('radio', { name: /^NPY / }).check();
  await page.locator('#save-size', { hasText: /^scans\.npy\.zip, .* Without “broken\.npy”: / }).waitFor();
  const { bytes } = await downloaded(page, () => page.locator('#save-now').click());
  const { 'reports.csv': table, ...surfaces } = unzipSync(bytes);
  assert.deepEqual(Object.entries(surfaces).map(([name, content]) => [name, parseNpy(Buffer.from(content)).cols]), [['b-developable.npy', 40], ['a-developable.npy', 60]]);
  const [columns, ...rows] = new TextDecoder().decode(table).trim().split('\r\n').map((line) => line.split(','));
  assert.deepEqual(rows.map(([file]) => file), ['b', 'a']);
  assert.ok(rows.every((row) => row.length === columns.length && Number(row[columns.indexOf('lambda')]) > 0), String(rows));
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
