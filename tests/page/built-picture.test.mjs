/** The picture of a pattern put together. */
import assert from 'node:assert/strict';
import { pageTest, saveAs } from './support/page.mjs';

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
}, { drawn: true });
