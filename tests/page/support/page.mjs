/** Tests on the page in Chromium, each on a fresh page that is watched all the time. */
import assert from 'node:assert/strict';
import { mkdtemp, readdir, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { chromium } from 'playwright-core';
import { isolation, serve } from '../../../tools/serve.mjs';
import { bundlePage } from '../../../tools/site.mjs';
import { pkg, www } from '../../../tools/util/paths.mjs';
import { args, executablePath, skip } from '../../js/support/browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

/** The page's first example, so small that it is solved at once: for tests of what is opened after it. */
const SMALL_EXAMPLE = '#example=cylinder&size=64&noise=0.02';

/** What of the page is folded at first. */
const ALL_PARTS = ['view-more', 'settings-more', 'mesh-more', 'file-more', 'edges-more'];

/** Where the page is served as `npm start` serves it, file by file; elsewhere it is bundled, as on the site. */
const SOURCES = 'sources/';

/** Time for anything to happen, on a machine that may be busy. */
const PATIENCE = 60_000;

const VIEWPORT = { width: 1280, height: 900 };

/** All that the page may keep in the browser, by its names in Chromium's protocol. */
const STORAGE_TYPES = 'cookies,local_storage,indexeddb,cache_storage,service_workers,file_systems';

/** The browser with a folder of its own, whose caches make each start but the first cheaper. @type {Promise<import('playwright-core').BrowserContext> | undefined} */
let shared;
/** @type {string | undefined} */
let profile;
/** @type {string | undefined} */
let ownBundle;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;

if (!skip) {
  before(async () => {
    // `npm test` has bundled it for all files.
    const bundle = process.env.DEVELOPABLE_PAGE || (ownBundle = await mkdtemp(join(tmpdir(), 'developable-page-')));
    if (ownBundle) await bundlePage(ownBundle);
    server = await serve({
      port: 0,
      // The files don't change during a test run: they may be cached, with the code that was compiled from them.
      headers: { ...isolation, 'Cache-Control': 'max-age=3600' },
      folders: { '/': bundle, '/pkg/': pkg, [`/${SOURCES}`]: www, [`/${SOURCES}pkg/`]: pkg },
    });
  });
  after(async () => {
    await (await shared)?.close();
    await server?.close();
    for (const folder of [profile, ownBundle]) if (folder) await rm(folder, { recursive: true, force: true, maxRetries: 5 });
  });
}

/** The browser of all tests. */
const sharedContext = () => (shared ??= launched());

async function launched() {
  profile = await mkdtemp(join(tmpdir(), 'developable-profile-'));
  const context = await chromium.launchPersistentContext(profile, {
    // Tabs share a process, and the wasm that it has compiled; without a graphics card each frame of a movement costs as much as a test.
    executablePath, args: [...args, '--enable-unsafe-swiftshader', '--process-per-site'], viewport: VIEWPORT, reducedMotion: 'reduce',
  });
  context.setDefaultTimeout(PATIENCE);
  // The first tab keeps that process and its wasm for the tabs of all tests.
  const [first] = context.pages();
  await first.goto(server.url);
  await first.evaluate(async (files) => {
    const compiled = files.map(async (file) => WebAssembly.compileStreaming(fetch(file)));
    Object.assign(globalThis, { compiled: await Promise.all(compiled) });
  }, (await readdir(join(pkg, 'wasm'))).filter((name) => name.endsWith('.wasm')).map((name) => `${server.url}pkg/wasm/${name}`));
  return context;
}

/**
 * Deletes what earlier tests left in the browser: storage and permissions.
 * @param {Page} page
 */
async function forget(page) {
  await page.context().clearPermissions();
  const protocol = await page.context().newCDPSession(page);
  await protocol.send('Storage.clearDataForOrigin', { origin: new URL(server.url).origin, storageTypes: STORAGE_TYPES });
  await protocol.detach();
}

/**
 * A test on a page of its own. It also fails when the page writes to the console, throws,
 * breaks its security policy (which Chromium reports as errors) or asks any other origin.
 * @param {string} name
 * @param {(page: Page) => Promise<void>} body
 * @param {{ drawn?: boolean, moving?: boolean, size?: import('playwright-core').ViewportSize, pixels?: number, phone?: boolean, start?: string, sources?: boolean, unfolded?: string[] }} [options]
 *   whether there is WebGL, which takes long without a graphics card: not unless said otherwise; whether anything moves by itself:
 *   not unless said otherwise; the size of the page; how many pixels of the device each of its pixels is wide; whether it is on a phone, under a finger; the part of the address after the #, which is a small example unless said
 *   otherwise; whether the page is served file by file; which parts are unfolded, all that are remembered unless said otherwise
 */
export function pageTest(name, body, { drawn = false, moving = false, size, pixels = 1, phone = false, start = SMALL_EXAMPLE, sources = false, unfolded = ALL_PARTS } = {}) {
  inChromium(name, async (page) => {
    const incidents = watch(page);
    if (moving) await page.emulateMedia({ reducedMotion: 'no-preference' });
    if (size) await page.setViewportSize(size);
    if (pixels > 1 || phone) await showOnDevice(page, pixels, phone);
    await page.addInitScript((parts) => localStorage.setItem('developable: unfolded', JSON.stringify(parts)), unfolded);
    if (!drawn) await page.addInitScript(withoutWebGL);
    await page.goto(server.url + (sources ? SOURCES : '') + start);
    await settled(page);
    // An untouched canvas is 300 pixels wide.
    if (drawn && start) await page.waitForFunction(() => document.querySelector('canvas#space-canvas:not([width="300"], :not([width]))'));
    await body(page);
    assert.deepEqual(incidents, []);
  });
}

/**
 * A test that begins at the doors, with nothing open.
 * @type {typeof pageTest}
 */
export const doorTest = (name, body, options) => pageTest(name, body, { start: '', ...options });

/** The tabs that tests share, with WebGL and without, each with what went wrong in it. @type {Map<boolean, { page: Page, incidents: string[] }>} */
const sharedTabs = new Map();

/**
 * A test in a tab that other tests have used before: it goes to an address, as a user does, and the page shows what that says. For tests that
 * change neither the page's own code nor the browser.
 * @param {string} name
 * @param {(page: Page) => Promise<void>} body
 * @param {{ drawn?: boolean, start?: string }} [options]
 */
export function sharedTest(name, body, { drawn = false, start = SMALL_EXAMPLE } = {}) {
  test(name, { skip, timeout: 4 * PATIENCE }, async () => {
    const tab = sharedTabs.get(drawn) ?? await newTab(drawn);
    const { page, incidents } = tab;
    // Where a test fails, the next one has a new tab.
    sharedTabs.delete(drawn);
    try {
      // Behind another tab a frame takes a second or two.
      await page.bringToFront();
      await page.goto(`${server.url}#`);
      await page.locator('#home').waitFor();
      if (start) {
        await page.goto(server.url + start);
        // The page has taken up the address.
        await page.locator('#home').waitFor({ state: 'hidden' });
      }
      await settled(page);
      await body(page);
      assert.deepEqual(incidents, []);
    } catch (error) {
      await page.close();
      throw error;
    }
    sharedTabs.set(drawn, tab);
  });
}

/**
 * Such a test that begins at the doors.
 * @type {typeof sharedTest}
 */
export const sharedDoorTest = (name, body, options) => sharedTest(name, body, { start: '', ...options });

/** A tab for several tests. @param {boolean} drawn whether there is WebGL */
async function newTab(drawn) {
  const page = await (await sharedContext()).newPage();
  await forget(page);
  const incidents = watch(page);
  await page.addInitScript((parts) => localStorage.setItem('developable: unfolded', JSON.stringify(parts)), ALL_PARTS);
  if (!drawn) await page.addInitScript(withoutWebGL);
  await page.goto(`${server.url}#`);
  return { page, incidents };
}

/**
 * Shows a tab as another device does, by the browser's protocol: Playwright has this for whole contexts only.
 * @param {Page} page
 * @param {number} deviceScaleFactor
 * @param {boolean} mobile
 */
async function showOnDevice(page, deviceScaleFactor, mobile) {
  const protocol = await page.context().newCDPSession(page);
  const { width, height } = page.viewportSize() ?? VIEWPORT;
  await protocol.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor, mobile });
  await protocol.send('Emulation.setTouchEmulationEnabled', { enabled: mobile });
}

/** Takes WebGL from a page. */
function withoutWebGL() {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = /** @type {any} */ (function (/** @type {any[]} */ ...given) {
    // @ts-expect-error the canvas
    return String(given[0]).startsWith('webgl') ? null : getContext.apply(this, given);
  });
}

/**
 * A test of how the page starts when something is missing.
 * @param {string} name
 * @param {(page: Page) => Promise<unknown>} spoil takes it away before the page is loaded
 * @param {(page: Page) => Promise<void>} body
 */
export function brokenStartTest(name, spoil, body) {
  inChromium(name, async (page) => {
    /** @type {string[]} */
    const uncaught = [];
    page.on('pageerror', (error) => uncaught.push(error.message));
    await spoil(page);
    await page.goto(`${server.url}${SOURCES}#example=roof`);
    await page.locator('#page[data-phase="failed"]').waitFor();
    await body(page);
    assert.deepEqual(uncaught, []);
  });
}

/**
 * A test in a tab of its own, which shows nothing yet and finds nothing kept.
 * @param {string} name
 * @param {(page: Page) => Promise<void>} body
 */
export function inChromium(name, body) {
  test(name, { skip, timeout: 4 * PATIENCE }, async () => {
    const context = await sharedContext();
    const page = await context.newPage();
    try {
      await forget(page);
      await body(page);
    } finally {
      // With its last tab the browser would end.
      const kept = [context.pages()[0], ...[...sharedTabs.values()].map((tab) => tab.page)];
      await Promise.all(context.pages().filter((one) => !kept.includes(one)).map((one) => one.close()));
    }
  });
}

/**
 * Collects what must not happen.
 * @param {Page} page
 */
function watch(page) {
  const home = new URL(server.url).origin;
  /** @type {string[]} */
  const incidents = [];
  page.on('console', (message) => {
    // Chromium's own, where it draws WebGL without a graphics card.
    if (message.text().includes('GL Driver Message')) return;
    if (message.type() !== 'log') incidents.push(`${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => incidents.push(`uncaught: ${error.message}`));
  page.on('requestfailed', (request) => {
    // Aborted is what the page itself gives up: by a reload, or with a worker that it ends.
    if (request.failure()?.errorText !== 'net::ERR_ABORTED') incidents.push(`failed: ${request.url()}`);
  });
  page.on('request', (request) => {
    const { origin } = new URL(request.url());
    if (origin !== home) incidents.push(`request to ${request.url()}`);
  });
  return incidents;
}

/**
 * Waits until all workers have ended that were started in the meantime: no answer of theirs can come any more.
 * @param {Page} page
 * @param {Set<import('playwright-core').Worker>} before workers that stay
 */
export async function ended(page, before) {
  for (let worker; (worker = page.workers().find((one) => !before.has(one)));) await worker.waitForEvent('close');
}

/**
 * Waits for what is being opened, for the run under way, and for the start before the first one, to end.
 * @param {Page} page
 */
export async function settled(page) {
  await page.locator('#page[data-phase="idle"]:not([data-opening])').waitFor();
  // The headline counts the pieces after the run.
  await page.locator('#verdict:not([aria-busy="true"])').waitFor({ state: 'attached' });
  await painted(page);
}

/**
 * Does something that starts a run, and waits for its end.
 * @param {Page} page
 * @param {() => Promise<unknown>} act
 */
export async function runBy(page, act) {
  await settled(page);
  await workBy(page, '#page[data-phase="running"]', act);
  await settled(page);
}

/**
 * Does something that makes an element match a selector for a while, and waits until it no longer does.
 * @param {Page} page
 * @param {string} working
 * @param {() => Promise<unknown>} act
 */
export async function workBy(page, working, act) {
  // The watch is set before the act, in a call of its own, or quick work is over before it is seen.
  const ended = await page.evaluateHandle((working) => {
    const element = /** @type {HTMLElement} */ (document.querySelector(working.replace(/\[.*/, '')));
    let began = false;
    const promise = new Promise((resolve) => {
      new MutationObserver((_, observer) => {
        if (element.matches(working)) began = true;
        else if (began) {
          observer.disconnect();
          resolve(null);
        }
      }).observe(element, { attributes: true });
    });
    return { promise };
  }, working);
  await act();
  await ended.evaluate(({ promise }) => promise);
}

/**
 * Types a λ.
 * @param {Page} page
 * @param {string} lambda
 */
export async function typeLambda(page, lambda) {
  await page.getByLabel('λ as a number').fill(lambda);
  await page.getByLabel('λ as a number').press('Tab');
}

/**
 * Chooses one of several as a user does, by its label: once it can be, and has come to rest.
 * @param {import('playwright-core').Locator} radio
 */
export async function choose(radio) {
  const label = radio.locator('..');
  await label.and(label.page().locator('label:has(input:enabled)')).click();
  assert.ok(await radio.isChecked(), 'what was chosen is not the choice');
}

/**
 * Goes to the photos of pages, where an example is shown.
 * @param {Page} page
 */
export async function enterPages(page) {
  await page.getByRole('link', { name: 'developable' }).click();
  await page.locator('[data-example="page"]').click();
}

/**
 * Waits until what was asked for is drawn.
 * @param {Page} page
 */
export async function painted(page) {
  await page.evaluate(() => new Promise((resolve) => {
    requestAnimationFrame(() => requestAnimationFrame(resolve));
  }));
}

/**
 * The text beside a name in the report.
 * @param {Page} page
 * @param {string} name
 */
export async function reported(page, name) {
  const row = page.locator('#report-table tr').filter({ has: page.locator('th', { hasText: new RegExp(`^${name}$`) }) });
  return (await row.locator('td').first().innerText()).trim();
}

/**
 * The value beside a name among the figures of a part of the page.
 * @param {Page} page
 * @param {string} part its selector
 * @param {string | RegExp} name
 */
export const figure = (page, part, name) =>
  page.locator(`${part} .figures div`).filter({ has: page.locator('dt', { hasText: name }) }).locator('dd');

/** Waits for the view that was chosen. @param {Page} page */
export const viewed = (page) => page.locator('#stage[data-busy="false"]:has(#analysis)').waitFor({ state: 'attached' });

/** Waits until a mesh is solved whole. @param {Page} page */
export const solvedWhole = (page) => page.locator('[data-whole] #stage[data-busy="false"]').waitFor();

/** Opens the dialog of sheets, and waits for their picture, which is returned. @param {Page} page */
export async function openSheets(page) {
  await page.locator('#end-sheets').click();
  return sheetsDrawn(page);
}

/** The picture of the sheets, once it is drawn. @param {Page} page */
export async function sheetsDrawn(page) {
  const image = page.locator('.preview[aria-busy="false"] img');
  await image.waitFor();
  return image;
}

/**
 * What a canvas, or the side of the picture with the input or the result, shows, as a hash and as the mean difference in brightness between
 * horizontal neighbours that are both covered.
 * @param {Page} page
 * @param {string} what a selector, `input` or `result`
 */
export async function look(page, what) {
  await painted(page);
  const side = ['input', 'result'].indexOf(what);
  return page.locator(side < 0 ? what : '#space-canvas').evaluate((canvas, side) => {
    if (!(canvas instanceof HTMLCanvasElement)) throw new Error('not a canvas');
    const { height } = canvas;
    const width = side < 0 ? canvas.width : canvas.width >> 1;
    // From a copy, as reading changes how a canvas is kept.
    const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    if (!copy) throw new Error('no canvas to copy to');
    copy.drawImage(canvas, side === 1 ? width - canvas.width : 0, 0);
    const { data } = copy.getImageData(0, 0, width, height);
    let [hash, covered, pairs, sum] = [0, 0, 0, 0];
    for (let i = 0; i < data.length; i += 4) {
      hash = (Math.imul(hash, 31) + data[i] + 256 * data[i + 3]) | 0;
      if (data[i + 3] === 255) covered++;
      if (i % (4 * width) === 0 || data[i + 3] < 255 || data[i - 1] < 255) continue;
      sum += Math.abs(data[i] - data[i - 4]);
      pairs++;
    }
    return { hash, covered: covered / (width * height), roughness: sum / pairs };
  }, side);
}

/**
 * Drops a file onto the middle of the page.
 * @param {Page} page
 * @param {string} name
 * @param {Buffer} bytes
 */
export function drop(page, name, bytes) {
  return dropAll(page, { [name]: bytes });
}

/**
 * Drops several files at once.
 * @param {Page} page
 * @param {Record<string, Buffer>} files
 */
export async function dropAll(page, files) {
  const contents = Object.entries(files).map(([name, bytes]) => ({ name, content: bytes.toString('base64') }));
  const transfer = await page.evaluateHandle((all) => {
    const transfer = new DataTransfer();
    for (const { name, content } of all) {
      const data = Uint8Array.from(atob(content), (character) => character.charCodeAt(0));
      transfer.items.add(new File([data], name));
    }
    return transfer;
  }, contents);
  for (const type of ['dragenter', 'dragover', 'drop']) {
    await page.dispatchEvent('main', type, { dataTransfer: transfer });
  }
}

/**
 * Drops a file that can be read, and waits until it is solved, unless it has to be asked about first.
 * @param {Page} page
 * @param {string} name
 * @param {Buffer} bytes
 */
export async function open(page, name, bytes) {
  await drop(page, name, bytes);
  // Where nothing can be solved it is soon hidden again.
  await page.locator('#input-caption', { hasText: name.replace(/\.\w+$/, '') }).waitFor({ state: 'attached' });
  await settled(page);
}

/**
 * Drops a mesh of which much is hidden from one side, and waits until it is solved whole.
 * @param {Page} page
 * @param {string} name
 * @param {Buffer} bytes
 */
export async function openWhole(page, name, bytes) {
  await drop(page, name, bytes);
  await page.locator('#mesh-name', { hasText: name.replace(/\.\w+$/, '') }).waitFor();
  await solvedWhole(page);
}

/**
 * Drops such a mesh, and waits until it is solved from one side.
 * @param {Page} page
 * @param {string} name
 * @param {Buffer} bytes
 */
export async function openFromOneSide(page, name, bytes) {
  await openWhole(page, name, bytes);
  await choose(page.getByRole('radio', { name: 'From one side', exact: true }));
  await settled(page);
}

/**
 * The result as a 3D file, as the dialog saves it.
 * @param {Page} page
 * @param {string} format
 */
export async function save(page, format) {
  await page.locator('#end-file').click();
  return saveAs(page, format);
}

/**
 * What the open dialog saves.
 * @param {Page} page
 * @param {string} format
 */
export async function saveAs(page, format) {
  await page.locator('#save-formats').getByRole('radio', { name: new RegExp(`^${format} `) }).check();
  await page.locator('#save-size', { hasText: new RegExp(`${format === 'JPEG' ? 'jpg' : format === 'Warp map' ? 'json' : format.toLowerCase().replace('solid ', 'solid.')}, .*(bytes|kB|MB)`) }).waitFor();
  const file = await downloaded(page, () => page.locator('#save-now').click());
  await page.locator('#save-dialog').getByRole('button', { name: 'Close' }).click();
  return file;
}

/**
 * @param {Page} page
 * @param {() => Promise<unknown>} act what starts the download
 */
export async function downloaded(page, act) {
  const [download] = await Promise.all([page.waitForEvent('download'), act()]);
  const pieces = [];
  for await (const piece of await download.createReadStream()) pieces.push(piece);
  return { name: download.suggestedFilename(), bytes: Buffer.concat(pieces) };
}
