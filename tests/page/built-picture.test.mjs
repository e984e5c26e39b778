/** The picture of a pattern put together. */
import assert from 'node:assert/strict';
import { cuboid } from './support/box.mjs';
import { obj } from './support/files.mjs';
import { openWhole, saveAs, sharedDoorTest } from './support/page.mjs';
import { parsePng } from './support/photos.mjs';

sharedDoorTest('the picture of a finished tower is upright, shaded, at an angle and numbered, and a model of it moves', async (page) => {
  // OBJ files take y for the axis that points upwards.
  await openWhole(page, 'tower.obj', obj(cuboid([20, 60, 20])));
  await page.locator('#end-sheets').click();
  const { width, data } = parsePng((await saveAs(page, 'PNG')).bytes);
  /** Columns and rows of what is coloured, and its tones. */
  const [cols, rows, tones] = [[Infinity, -Infinity], [Infinity, -Infinity], new Map()];
  const black = { above: 0, below: 0 };
  for (let i = 0; i < data.length; i += 4) {
    const [least, most] = [Math.min(data[i], data[i + 1], data[i + 2]), Math.max(data[i], data[i + 1], data[i + 2])];
    if (most < 30) black[i / 4 < 1500 * width ? 'above' : 'below']++;
    if (most - least < 40) continue;
    const [col, row] = [(i / 4) % width, Math.floor(i / 4 / width)];
    [cols[0], cols[1], rows[0], rows[1]] = [Math.min(cols[0], col), Math.max(cols[1], col), Math.min(rows[0], row), Math.max(rows[1], row)];
    tones.set(data[i], (tones.get(data[i]) ?? 0) + 1);
  }
  const [wide, high] = [cols[1] - cols[0], rows[1] - rows[0]];
  assert.ok(high > 1.5 * wide, `${wide} × ${high}`);
  // Three sides are seen, each in its light, and the lid is a little of it.
  assert.ok([...tones.values()].filter((count) => count > 0.03 * wide * high).length >= 3, `${[...tones].filter(([, count]) => count > 1000)}`);
  assert.ok(black.above > 100, 'a number');
  assert.ok(black.below > 1000, 'how it is joined');

  await page.locator('#end-sheets').click();
  const { bytes } = await saveAs(page, 'GLB');
  const { animations } = JSON.parse(bytes.toString('utf8', 20, 20 + bytes.readUInt32LE(12)));
  assert.equal(animations[0].name, 'Assembly');
}, { drawn: true });
