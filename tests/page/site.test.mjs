/** The page as a folder of static files: under a path of its own, with few requests, without a network, and renewed as a whole. */
import assert from 'node:assert/strict';
import { subscribe } from 'node:diagnostics_channel';
import { mkdtemp, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { brotliCompress, constants } from 'node:zlib';
import { serve } from '../../tools/serve.mjs';
import { writeSite } from '../../tools/site.mjs';
import { pageTest, settled } from './support/page.mjs';
import { colouredPicture } from './support/photos.mjs';

/** What service workers fetch at the moment, and how much of it at once at most. */
const kept = { now: 0, most: 0 };
/** Counts what a service worker begins and ends to fetch. @param {string} event @param {number} change */
const countKept = (event, change) => subscribe(`http.server.${event}`, (message) => {
  const { request } = /** @type {{ request: import('node:http').IncomingMessage }} */ (message);
  if (request.headers.referer?.endsWith('/sw.js')) kept.most = Math.max(kept.most, (kept.now += change));
});
countKept('request.start', 1);
countKept('response.finish', -1);

/** Waits for the pictures of a guide. @param {import('playwright-core').Page} page */
async function loaded(page) {
  const pictures = page.locator('main img');
  await pictures.first().waitFor();
  await page.waitForFunction(() => [...document.images].every((one) => one.complete));
  assert.ok((await pictures.evaluateAll((all) => all.map((one) => /** @type {HTMLImageElement} */ (one).naturalWidth))).every((width) => width > 0));
}

pageTest('the site works under any path and without a network, and is renewed as a whole', async (page) => {
  const context = page.context();
  const folder = await mkdtemp(join(tmpdir(), 'developable-site-'));
  await writeSite(folder, { quality: 1 });
  const server = await serve({ folders: { '/some/where/': folder } });
  try {
    const visit = await context.newPage();
    /** @type {string[]} */
    const asked = [];
    // The page's own: what the service worker keeps for later comes besides.
    visit.on('request', (request) => asked.push(request.url()));
    await visit.goto(`${server.url}some/where/#example=cone&size=100&noise=0.02`);
    await visit.locator('#certificate').waitFor();
    assert.equal(kept.most, 0, 'what is kept for later is not fetched before the answer');
    await settled(visit);
    const own = asked.filter((url) => !/(sw|register)\.js$|manifest/.test(url) && !url.startsWith('blob:'));
    assert.ok(own.every((url) => url.startsWith(`${server.url}some/where/`)), String(own));
    const first = own.slice(0, own.findIndex((url) => /solver_bg/.test(url)) + 1);
    assert.ok(first.length > 0 && first.length <= 12, `${first.length} requests up to the solver: ${first}`);

    // Everything is kept once the worker is there.
    await visit.evaluate(async () => { await navigator.serviceWorker.ready; });
    assert.equal(kept.most, 1, 'files are kept one by one');
    // Guides are linked from the page, and what of them is opened is kept, pictures too.
    const guide = await context.newPage();
    await guide.goto(visit.url().replace(/#.*/, ''));
    await guide.reload();
    // Text recognition is kept once it was used.
    const model = `${server.url}some/where/assets/${(await readdir(join(folder, 'assets'))).find((name) => name.startsWith('text-english'))}`;
    const isModelKept = () => guide.evaluate((url) => caches.match(url).then((kept) => kept !== undefined), model);
    const modelSize = (/** @type {import('playwright-core').Page} */ tab) => tab.evaluate(async (url) => (await (await fetch(url)).arrayBuffer()).byteLength, model);
    assert.equal(await isModelKept(), false);
    const size = await modelSize(guide);
    assert.ok(size > 2e6 && await isModelKept(), String(size));
    await guide.getByRole('link', { name: 'Guide' }).click();
    await guide.getByRole('heading', { name: 'The web page', level: 1 }).waitFor();
    await guide.goto(new URL('meshes.html', guide.url()).href);
    await loaded(guide);
    await context.setOffline(true);
    await server.close();
    await visit.reload();
    assert.equal(await modelSize(visit), size);
    await settled(visit);
    assert.match(await visit.locator('#certificate').innerText(), /^Proven/);
    assert.ok(await visit.evaluate(() => crossOriginIsolated), 'the service worker isolates the page');
    // What was not loaded before, too.
    await visit.locator('#end-file').click();
    await visit.locator('#save-formats input[value="glb"]').check();
    await visit.locator('#save-size', { hasText: /glb, \d/ }).waitFor();
    await visit.keyboard.press('Escape');

    // What the system's share sheet hands over is opened, without a network too.
    const shared = await context.newPage();
    await shared.goto(`${visit.url().replace(/#.*/, '')}`);
    await shared.evaluate((content) => {
      const form = document.createElement('form');
      Object.assign(form, { method: 'post', enctype: 'multipart/form-data', action: './share' });
      const input = document.createElement('input');
      Object.assign(input, { type: 'file', name: 'files' });
      const files = new DataTransfer();
      files.items.add(new File([Uint8Array.from(atob(content), (character) => character.charCodeAt(0))], 'IMG 7.png', { type: 'image/png' }));
      input.files = files.files;
      form.append(input);
      document.body.append(form);
      form.submit();
    }, colouredPicture.toString('base64'));
    await shared.locator('#page-caption', { hasText: 'IMG 7' }).waitFor();
    await shared.close();

    // Guides: one that was opened, with its picture, one that was not, and what is not kept.
    await guide.reload();
    await loaded(guide);
    await guide.getByRole('link', { name: 'Scans', exact: true }).click();
    await guide.getByRole('heading', { name: 'Clean up a scan' }).waitFor();
    await guide.getByRole('link', { name: 'Benchmarks', exact: true }).click();
    await guide.getByRole('heading', { name: 'Not kept' }).waitFor();
    await guide.close();

    // Another version: not mixed with this one, and taken when it is asked for.
    await context.setOffline(false);
    const again = await serve({ folders: { '/some/where/': folder }, port: Number(new URL(server.url).port) });
    try {
      for (const [name, before, after] of [['index.html', '>developable</a>', '>developable 2</a>'], ['sw.js', '"version":"', '"version":"2']]) {
        const file = join(folder, name);
        for (const end of ['.br', '.gz']) await rm(file + end);
        await writeFile(file, (await readFile(file, 'utf8')).replace(before, after));
      }
      await visit.reload();
      await visit.evaluate(async () => { await (await navigator.serviceWorker.ready).update(); });
      await visit.getByRole('button', { name: /new version/ }).waitFor();
      assert.equal(await visit.locator('h1').innerText(), 'developable');
      // A request that the old worker never answers keeps the new worker waiting.
      await visit.evaluate(() => {
        void fetch('./share', /** @type {RequestInit} */ ({ method: 'POST', body: new ReadableStream(), duplex: 'half' })).catch(() => {});
      });
      await visit.getByRole('button', { name: /new version/ }).click();
      await visit.getByRole('heading', { name: 'developable 2' }).waitFor();
      assert.match(new URL(visit.url()).hash, /cone/, 'what was shown stands in the address');
    } finally {
      await again.close();
    }
  } finally {
    await context.setOffline(false);
    await server.close().catch(() => {});
    await rm(folder, { recursive: true, force: true });
  }
}, { start: '' });

/** The best compression saves a tenth more, and takes twenty times as long. */
const QUICK = { params: { [constants.BROTLI_PARAM_QUALITY]: 6 } };

/** What may be sent for the doors with their pictures, which need no solver, and for an example that is solved and drawn: requests, and kilobytes as the site sends them. */
const LOADING_LIMITS = [{ start: '', seen: '.doors', requests: 8, kB: 150 }, { start: '#example=roof&size=100', seen: '#certificate', requests: 9, kB: 488 }];

for (const { start, seen, requests, kB } of LOADING_LIMITS) {
  pageTest(`few requests and bytes come before ${seen}`, async (page) => {
    /** @type {Set<string>} */
    const asked = new Set();
    page.on('request', (request) => asked.add(request.url().replace(/#.*/, '')));
    await page.reload();
    await page.locator(seen).waitFor();
    await settled(page);
    // The pieces of what is shown already are counted by the unrolling's wasm.
    const urls = [...asked].filter((url) => url.startsWith('http') && !/unroll_bg|icon/.test(url));
    const sizes = await Promise.all(urls.map(async (url) => promisify(brotliCompress)(await (await fetch(url)).arrayBuffer(), QUICK)));
    const list = urls.map((url, i) => `${url} ${sizes[i].length}`).join('\n');
    const sum = sizes.reduce((bytes, { length }) => bytes + length, 0) / 1000;
    assert.ok(urls.length <= requests && sum <= kB, `${urls.length} requests, ${sum} kB:\n${list}`);
    assert.equal(urls.filter((url) => url.includes('solver_bg')).length, start === '' ? 0 : 1, list);
    assert.equal(urls.some((url) => url.includes('three')), start !== '', list);
    // Nothing waits for what it does not need: the package and the solver not for the page's modules.
    const order = [/\/pkg-/, /\/index-.*js$/, /solver_bg/, /\/three-/].map((name) => urls.findIndex((url) => name.test(url)));
    assert.deepEqual(order.filter((place) => place >= 0), order.filter((place) => place >= 0).toSorted((a, b) => a - b), list);
  }, { start, drawn: true });
}
