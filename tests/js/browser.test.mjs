/** The package as plain modules in a page with a strict content security policy. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { isolation, serve as serveFolders } from '../../tools/serve.mjs';
import { launch, openPage, serve, skip } from './support/browser.mjs';
import { temporaryFolder } from './support/command.mjs';
import { pkg, wasmFile } from './support/paths.mjs';
import { trapping } from './support/wasm-surgery.mjs';

const site = await temporaryFolder();
// What the tests use lies in a file: the policy forbids scripts in the page.
await writeFile(join(site, 'index.html'), `<!doctype html>
  <link rel="icon" href="data:,">
  <script type="module" src="/page.js"></script>
`);
await writeFile(join(site, 'page.js'), `
  import * as developable from '/pkg/index.js';
  import * as direct from '/pkg/direct.js';
  globalThis.developable = developable;
  globalThis.direct = direct;
  globalThis.plane = (width, height) => ({
    width, height,
    data: Float64Array.from({ length: width * height }, (_, i) => 0.3 * (i % width) - 0.2 * Math.floor(i / width)),
  });
  globalThis.endless = async () => ({
    input: (await developable.example('roof', { size: 200, noise: 0.1 })).input,
    options: { lambda: 'small', gap: 1e-12, maxIterations: 1e9 },
  });
  globalThis.outcome = (promise) => promise.then((value) => ({ value }), ({ name, code }) => ({ name, code }));
`);

/** @type {import('playwright-core').Browser} */
let browser;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;
/** The page that tests share, whose modules and wasm are so loaded once. @type {Awaited<ReturnType<typeof openPage>>} */
let shared;

if (!skip) {
  before(async () => {
    await writeFile(join(site, 'broken.wasm'), trapping(await readFile(wasmFile), 'solver_surface'));
    server = await serve({ '/pkg/': pkg, '/': site });
    browser = await launch();
    shared = await openPage(browser, server.url);
  });
  after(async () => {
    await browser?.close();
    await server?.close();
  });
}

/**
 * @param {string} name
 * @param {(page: import('playwright-core').Page) => Promise<void>} body
 * @param {RegExp[]} [expected] incidents
 */
function inPage(name, body, expected = []) {
  test(name, { skip }, async () => {
    const { page, incidents } = shared;
    await body(page);
    assert.deepEqual(incidents.splice(0).filter((text) => !expected.some((pattern) => pattern.test(text))), []);
  });
}

inPage('a worker solves, without blob: or eval', async (page) => {
  const result = await page.evaluate(`(async () => {
    const input = plane(20, 15);
    const surface = await developable.fit(input);
    return {
      most: Math.max(...surface.image.data.map((z, i) => Math.abs(z - input.data[i]))),
      reason: surface.report.stopReason,
      real: surface.heights instanceof Float64Array,
    };
  })()`);
  assert.ok(result.most < 1e-9);
  assert.deepEqual([result.reason, result.real], ['rounding', true]);
});

test('in a page that is isolated from others the package works as well, on two threads with the bits of one', { skip }, async () => {
  const isolated = await serve({ '/pkg/': pkg, '/': site }, isolation);
  const { page, incidents } = await openPage(browser, isolated.url);
  const result = await page.evaluate(`(async () => {
    const worker = new developable.DevelopableWorker({ workerUrl: '/pkg/worker.js' });
    const fits = await Promise.all([developable.fit(plane(20, 15)), worker.fit(plane(20, 15))]);
    worker.dispose();
    await direct.init();
    const reasons = [...fits, direct.fit(plane(20, 15))].map(({ report }) => report.stopReason);
    return { isolated: crossOriginIsolated, reasons };
  })()`);
  assert.deepEqual(result, { isolated: true, reasons: ['rounding', 'rounding', 'rounding'] });
  const [one, two] = await page.evaluate(`(async () => {
    // Threads are not limited by the cores of the machine that tests.
    Object.defineProperty(navigator, 'hardwareConcurrency', { value: 2 });
    const data = Float64Array.from({ length: 190 * 190 }, (_, i) => Math.abs((i % 190) - 75) + Math.sin(i));
    const results = [];
    for (const threads of [1, 2]) {
      const worker = new developable.DevelopableWorker({ threads });
      const { heights, report } = await worker.fit({ width: 190, height: 190, data }, { lambda: 1e6 });
      worker.dispose();
      results.push({ heights: Array.from(heights), threads: report.threads, limit: report.threadLimit });
    }
    return results;
  })()`);
  assert.deepEqual([one.threads, one.limit, two.threads, two.limit], [1, 'options', 2, 'options']);
  assert.deepEqual(two.heights, one.heights);
  assert.deepEqual(incidents, []);
  await page.close();
  await isolated.close();
});

inPage('progress comes, and an abort stops the work while the page stays alive', async (page) => {
  const result = await page.evaluate(`(async () => {
    const { input, options } = await endless();
    const controller = new AbortController();
    let told = 0, frames = 0;
    const { signal } = controller;
    const solve = outcome(developable.fit(input, { ...options, signal, onProgress: () => { told += 1; } }));
    // The page is drawn while the worker tells of its progress.
    while (told < 2 || frames < 5) {
      await new Promise(requestAnimationFrame);
      frames += 1;
    }
    controller.abort();
    // The rejection does not wait for the worker, which answers before the solve could end.
    const answered = developable.example('cone', { size: 8 }).then(() => ({ name: 'answered' }));
    const { name } = await Promise.race([solve, answered]);
    await answered;
    return name;
  })()`);
  assert.equal(result, 'AbortError');
});

inPage('an abort can keep the best surface', async (page) => {
  const reason = await page.evaluate(`(async () => {
    const { input, options } = await endless();
    const surface = await developable.fit(input, { ...options, signal: AbortSignal.timeout(500), onAbort: 'keep' });
    return surface.report.stopReason;
  })()`);
  assert.equal(reason, 'cancelled');
});

inPage('the direct API runs in the page itself', async (page) => {
  const result = await page.evaluate(`(async () => {
    const early = await outcome((async () => direct.fit(plane(8, 8)))());
    await direct.init();
    return { early: early.code, reason: direct.fit(plane(8, 8)).report.stopReason };
  })()`);
  assert.deepEqual(result, { early: 'NOT_INITIALIZED', reason: 'rounding' });
});

inPage('wasm from another place: relative address, response, bytes, module', async (page) => {
  const reasons = await page.evaluate(`(async () => {
    const place = 'pkg/wasm/solver_bg.wasm';
    const bytes = await (await fetch(place)).arrayBuffer();
    const module = await WebAssembly.compile(bytes);
    const sources = [place, new URL(place, location.href), await fetch(place), fetch(place), bytes, module];
    const reasons = [];
    for (const wasm of sources) {
      const worker = new developable.DevelopableWorker({ wasm, workerUrl: '/pkg/worker.js' });
      reasons.push((await worker.fit(plane(8, 8))).report.stopReason);
      worker.dispose();
    }
    return reasons;
  })()`);
  assert.deepEqual(reasons, new Array(6).fill('rounding'));
});

inPage('what cannot be loaded, or crashes, is an error with a code', async (page) => {
  const codes = await page.evaluate(`(async () => {
    const fit = (options) => outcome(new developable.DevelopableWorker(options).fit(plane(8, 8)));
    const failures = await Promise.all([
      fit({ wasm: '/nothing.wasm' }),
      fit({ wasm: '/page.js' }),
      fit({ workerUrl: '/nothing.js' }),
      fit({ wasm: '/broken.wasm' }),
    ]);
    return failures.map(({ name, code }) => name + ' ' + code);
  })()`);
  assert.deepEqual(codes, ['INIT', 'INIT', 'WORKER', 'TRAP'].map((code) => `DevelopableError ${code}`));
}, [/404/]);

inPage('a picture comes onto each kind of canvas, from the page and from a worker', async (page) => {
  const result = await page.evaluate(`(async () => {
    await Promise.all([direct.init(), direct.load('unroll')]);
    const { input } = await developable.example('page', { size: 60 });
    input.data.fill(NaN, 0, 300);
    const surface = await developable.fit(input);
    const element = () => document.createElement('canvas');
    const kinds = { element, offscreen: () => new OffscreenCanvas(3, 3) };
    const found = { differing: [] };
    for (const style of ['shaded', 'curvature', 'patches']) {
      const picture = direct.picture(surface, { style, width: 90 });
      const made = await developable.picture(surface, { style, width: 90 });
      for (const one of [picture, made]) {
        if (!(one instanceof ImageData) || one.width !== 90) found.differing.push(style + ' is no picture');
      }
      for (const [kind, canvas] of Object.entries(kinds)) {
        for (const [api, { draw }] of Object.entries({ direct, developable })) {
          const drawn = canvas();
          await draw(drawn, surface, { style, width: 90 });
          const { width, height } = picture;
          const there = drawn.getContext('2d').getImageData(0, 0, width, height).data;
          const same = drawn.width === width && drawn.height === height && there.every((byte, i) => byte === picture.data[i]);
          if (!same || made.data.some((byte, i) => byte !== picture.data[i])) found.differing.push([style, kind, api].join());
        }
      }
      const { data } = picture;
      found[style] = [data[3], data[4 * 45 + 3], new Set(new Uint32Array(data.buffer)).size > 1, data.buffer.byteLength === data.length];
    }
    return found;
  })()`);
  // Nothing in the first rows of pixels, something elsewhere, memory of its own.
  const each = [0, 0, true, true];
  assert.deepEqual(result, { differing: [], shaded: each, curvature: each, patches: each });
});

inPage('a canvas that cannot be drawn on is refused, and the next one is drawn on', async (page) => {
  const codes = await page.evaluate(`(async () => {
    await Promise.all([direct.init(), direct.load('unroll')]);
    const element = () => document.createElement('canvas');
    const [taken, given, sent] = [element(), element(), new OffscreenCanvas(4, 4)];
    taken.getContext('bitmaprenderer');
    given.transferControlToOffscreen();
    new MessageChannel().port1.postMessage(sent, [sent]);
    const canvases = [taken, given, sent, document.body, null, { getContext: () => ({}) }, element()];
    const codes = [];
    for (const canvas of canvases) {
      for (const { draw } of [direct, developable]) {
        codes.push((await outcome((async () => draw(canvas, plane(8, 8)))())).code ?? 'drawn');
      }
    }
    return codes;
  })()`);
  assert.deepEqual(codes, [...new Array(12).fill('INPUT'), 'drawn', 'drawn']);
});

inPage('photos are ImageData, in and out', async (page) => {
  const result = await page.evaluate(`(async () => {
    await Promise.all([direct.init(), direct.load('files', 'unroll')]);
    const [width, height] = [24, 16];
    const photo = new ImageData(width, height);
    photo.data.forEach((_, i) => { photo.data[i] = i % 4 === 3 ? 255 : (7 * i) % 256; });
    const level = { width, height, data: new Float64Array(width * height) };
    const same = (a, b) => a.length === b.length && a.every((byte, i) => byte === b[i]);
    const found = {};
    for (const [name, api] of Object.entries({ direct, developable })) {
      const { data } = await api.readPhoto(await api.writePhoto(photo));
      const flat = await api.dewarp(level, photo);
      const shown = new ImageData(flat.data, flat.width);
      const hex = await api.fit(level);
      const { colors } = await api.paint(hex, photo);
      const first = photo.data.slice(0, 3).map((byte, i) => Math.round(255 * colors[i]) - byte);
      found[name] = [same(data, photo.data), shown.width === flat.width, flat.data.some((byte) => byte > 0), Math.max(...first)];
    }
    return found;
  })()`);
  assert.deepEqual(result, { direct: [true, true, true, 0], developable: [true, true, true, 0] });
});

test('a page that requires Trusted Types starts the worker under the policy `developable`', { skip }, async () => {
  const own = await serveFolders({
    folders: { '/pkg/': pkg, '/': site },
    policy: "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; img-src data:; "
      + "require-trusted-types-for 'script'; trusted-types developable",
  });
  after(() => own.close());
  const { page, incidents } = await openPage(browser, own.url);
  const reason = await page.evaluate('developable.fit(plane(9, 9)).then(({ report }) => report.stopReason)');
  assert.equal(reason, 'rounding');
  assert.deepEqual(incidents, []);
  await page.close();
});

test('a worker that closes itself ends its calls, and the next call has a new one', { skip }, async () => {
  await writeFile(join(site, 'closing.js'), `
    import '/pkg/worker.js';
    addEventListener('message', ({ data }) => data.path?.[0] === 'start' && setTimeout(() => self.close(), 50));
  `);
  const { page } = await openPage(browser, server.url);
  const outcomes = await page.evaluate(`(async () => {
    const worker = new developable.DevelopableWorker({ workerUrl: '/closing.js' });
    const { input, options } = await endless();
    const first = await worker.fit(input, options).catch(({ code, message }) => ({ code, message }));
    const next = await worker.writeImage(plane(3, 3));
    worker.dispose();
    return { first, length: next.length };
  })()`);
  assert.equal(outcomes.first.code, 'WORKER');
  assert.match(outcomes.first.message, /closed itself/);
  assert.ok(outcomes.length > 72);
  await page.close();
});
