/** The picture of a pattern put together: what its raster shows of a known mesh, and what the page saves. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { axesOf, rasterise } from '../../www/surface/built-picture.js';
import { pageTest, saveAs } from './support/page.mjs';

/** A unit square at height 1 above the middle of a square of twice its side. */
const TABLE = {
  positions: Float64Array.from([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -0.5, -0.5, 1, 0.5, -0.5, 1, 0.5, 0.5, 1, -0.5, 0.5, 1]),
  triangles: Uint32Array.from([0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7]),
};

test('a raster shows as much of a square as its slant leaves, and hides what is behind', () => {
  for (const elevation of [90, 60, 30]) {
    const { width, triangle, depth, project } = rasterise(TABLE, axesOf(-20, elevation), 800, 10);
    const sine = Math.sin((elevation * Math.PI) / 180);
    const [from, to] = [project([0, 0, 0]), project([1, 0, 0])];
    const perUnit = Math.hypot(to[0] - from[0], (to[1] - from[1]) / sine);
    // Nothing is before the upper square: its area times the sine of the elevation.
    const upper = triangle.filter((one) => one >= 2).length / perUnit ** 2;
    assert.ok(Math.abs(upper - sine) < 0.01, `${elevation}: ${upper}`);
    const [col, row, near] = project([0.1, 0.2, 1]);
    assert.ok(Math.abs(depth[Math.floor(row) * width + Math.floor(col)] - near) < 2, 'the upper square is nearest');
  }
});

pageTest('the picture of a finished piece is shaded and at an angle', async (page) => {
  await page.locator('#end-sheets').click();
  const { bytes } = await saveAs(page, 'PNG');
  const { tones, share } = await page.evaluate(async (base64) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (character) => character.charCodeAt(0))]));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    if (!context) throw new Error('no canvas');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    /** Tones of pixels in one hue. */
    const tones = new Set();
    for (let i = 0; i < data.length; i += 4) {
      if (Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40) tones.add(data[i]);
    }
    return { tones: tones.size, share: image.height / image.width };
  }, bytes.toString('base64'));
  // From above, a square with a colour for each sheet would be as high as wide, and in as many tones as sheets.
  assert.ok(share < 0.9, `${share} as high as wide`);
  assert.ok(tones > 30, `${tones} tones`);
});
