/** The apps in examples/apps/, as Vite serves them in this clone. */
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { createServer } from 'vite';
import { colouredPicture, levelPhoto } from '../page/support/photos.mjs';
import { launch, openPage, skip } from './support/browser.mjs';
import { root } from './support/paths.mjs';

/** @type {import('playwright-core').Browser} */
let browser;

if (!skip) {
  before(async () => {
    browser = await launch();
  });
  after(() => browser?.close());
}

/**
 * @param {string} name
 * @param {string} what
 * @param {(page: import('playwright-core').Page) => Promise<void>} body
 */
function inApp(name, what, body) {
  test(`${name}: ${what}`, { skip }, async () => {
    const server = await createServer({
      root: join(root, 'examples/apps', name), configFile: false, logLevel: 'silent', server: { host: '127.0.0.1', port: 0 },
      cacheDir: join(root, 'target/apps', name),
    });
    try {
      await server.listen();
      const { page, incidents } = await openPage(browser, server.resolvedUrls?.local[0] ?? '');
      await body(page);
      assert.deepEqual(incidents, []);
      await page.close();
    } finally {
      await server.close();
    }
  });
}

inApp('scanner', 'photos become a PDF of A4 pages, and a photo without a page is named', async (page) => {
  const files = [{ name: 'page.png', buffer: levelPhoto }, { name: 'blank.png', buffer: colouredPicture }];
  await page.locator('input').setInputFiles(files.map((file) => ({ ...file, mimeType: 'image/png' })));
  const link = page.getByRole('link', { name: 'Save scan.pdf' });
  await link.waitFor({ timeout: 60_000 });
  await page.waitForFunction(`document.querySelector('a').href !== ''`);
  const said = await page.locator('li').allTextContents();
  assert.equal(said.length, 2);
  assert.match(said[0], /^page\.png: ./);
  assert.match(said[1], /^blank\.png: .*page/);
  const pdf = Buffer.from(await page.evaluate(`fetch(document.querySelector('a').href).then((file) => file.arrayBuffer())
    .then((bytes) => Array.from(new Uint8Array(bytes)))`)).toString('latin1');
  assert.ok(pdf.startsWith('%PDF-'));
  const [, width, height] = /\/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]/.exec(pdf)?.map(Number) ?? [];
  // A4 in points, to a millimetre: pixels are whole.
  assert.ok(Math.abs(width - 595.3) < 3 && Math.abs(height - 841.9) < 3, `${width} × ${height}`);
  assert.equal([...pdf.matchAll(/\/Type \/Page\b/g)].length, 1);
});

inApp('lambda', 'the slider solves again, and the picture changes', async (page) => {
  const status = page.getByRole('status');
  const shown = () => page.evaluate(`document.querySelector('canvas').toDataURL()`);
  await status.filter({ hasText: '1.0e+6' }).waitFor({ timeout: 60_000 });
  const first = await shown();
  await page.getByRole('slider').fill('3');
  await status.filter({ hasText: '1.0e+3' }).waitFor({ timeout: 60_000 });
  assert.notEqual(await shown(), first);
  assert.match(await status.innerText(), /within [0-5]\.\d % of the optimum/);
});
