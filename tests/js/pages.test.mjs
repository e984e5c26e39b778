/** Photos of curled pages made flat by their edges; directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { refuses, run, succeeds, temporaryFolder } from './support/command.mjs';
import { readPdf } from './support/drawings.mjs';
import { error } from './support/error.mjs';
import { withExif } from './support/exif.mjs';
import { photoOf } from './support/shapes.mjs';

after(() => developable.dispose());

/**
 * An A4 page, 80° of a circle about an upright axis, 43 cm from a camera that is tilted by 12°.
 * Millimetres and pixels.
 */
const [width, height, focal, distance, tilt] = [480, 640, 480, 430, (12 * Math.PI) / 180];
const radius = 210 / 1.4;

/** Where a place on the page is seen, from its upper left corner as shares. @param {number} s @param {number} t */
function seen(s, t) {
  const angle = 1.4 * (s - 0.5);
  const [x, y, z] = [radius * Math.sin(angle), 297 * (t - 0.5), -radius * (Math.cos(angle) - 0.85)];
  const [down, ahead] = [y * Math.cos(tilt) - z * Math.sin(tilt), y * Math.sin(tilt) + z * Math.cos(tilt)];
  return /** @type {[number, number]} */ (
    [(focal * x) / (distance + ahead) + 239.5, (focal * down) / (distance + ahead) + 319.5]);
}

/** @param {number} t */
const across = (t) => Array.from({ length: 21 }, (_, i) => seen(i / 20, t));

const edges = { top: across(0), bottom: across(1) };

/** Red from left to right, green from top to bottom: each pixel says where it is. */
const photo = photoOf(width, height, (x, y) => [x / 2, y / 3, 0, 255]);

await direct.init();
await direct.load('files', 'images', 'unroll', 'meshes');

test('a curled page is flat, in millimetres', () => {
  const options = /** @type {const} */ ({ focalLength: focal, page: 'a4', dots: 1, light: 'keep' });
  const flat = direct.dewarpPage(photo, edges, options);
  assert.deepEqual([flat.width, flat.height, flat.unit, flat.resolution], [210, 297, 'mm', 1]);
  // No line of text checks the bend.
  assert.equal(flat.verdict, 'unchecked');
  assert.equal(flat.report.verdict, 'unchecked');
  assert.ok(flat.report.error > 0 && flat.report.error < 0.5 && flat.report.errorBound < 1, JSON.stringify(flat.report));
  assert.ok(flat.size.every((side, k) => Math.abs(side - [210, 297][k]) < 0.5), String(flat.size));
  for (const [col, row] of [[0, 0], [209, 0], [70, 200], [105, 296]]) {
    const [x, y] = seen((col + 0.5) / 210, (row + 0.5) / 297);
    const i = row * 210 + col;
    assert.ok(Math.hypot(flat.map[2 * i] - x, flat.map[2 * i + 1] - y) < 0.5, `${col} ${row}`);
    const [red, green] = flat.data.subarray(4 * i);
    assert.ok(Math.abs(red - x / 2) < 1.5 && Math.abs(green - y / 3) < 1.5, `${col} ${row}: ${red} ${green}`);
  }
});

test('the focal length may be that of the photo, and what is said counts more', () => {
  const film35 = (focal * Math.hypot(36, 24)) / Math.hypot(width, height);
  for (const [options, given] of /** @type {const} */ ([[{}, { ...photo, film35 }], [{ focalLength: focal }, { ...photo, film35: 3 * film35 }]])) {
    const { report } = direct.dewarpPage(given, edges, { ...options, findLines: false });
    assert.ok(Math.abs(report.focalLength / focal - 1) < 0.05, JSON.stringify(report));
  }
});

test('edges may be those of a spread, and Bézier curves', () => {
  // Cut along its middle ruling, it is a spread.
  const half = (/** @type {number} */ k) => ({
    top: edges.top.slice(10 * k, 10 * k + 11),
    bottom: edges.bottom.slice(10 * k, 10 * k + 11),
  });
  const spread = direct.dewarpPage(photo, [half(0), half(1)], { focalLength: focal, page: [105, 297], dots: 1 });
  assert.deepEqual([spread.width, spread.height], [210, 297]);
  const middle = seen(0.5, 0.5 / 297);
  assert.ok(Math.hypot(spread.map[2 * 105] - middle[0], spread.map[211] - middle[1]) < 1.2);

  // A straight cubic: a page that is flat.
  const line = (/** @type {number} */ y) => ({ beziers: [0, 1, 2, 3].map((k) => /** @type {[number, number]} */ ([60 + 120 * k, y])) });
  const flat = direct.dewarpPage(photo, { top: line(60), bottom: line(580) }, { focalLength: focal });
  assert.equal(flat.verdict, 'flat');
  assert.ok(Math.abs(flat.size[1] - 520 / 360) < 0.01, String(flat.size));
});

test('what is no page, and what is not known', async () => {
  const by = (/** @type {unknown} */ given, options = {}) => () => direct.dewarpPage(photo, /** @type {any} */ (given), options);
  assert.throws(by({ top: edges.bottom, bottom: edges.top }), error('EDGES', /exchange/));
  assert.throws(by({ top: edges.top }), error('INPUT', /top.*bottom/));
  assert.throws(by({ ...edges, left: edges.top }), error('INPUT'));
  assert.throws(by({ ...edges, middle: [] }), error('INPUT', /middle/));
  assert.throws(by([]), error('INPUT', /spread/));
  assert.throws(by([edges, edges, edges]), error('INPUT', /spread/));
  assert.throws(by({ ...edges, top: [[1, 2], [3]] }), error('INPUT', /point 1 of the top edge/));
  assert.throws(by({ ...edges, top: [[1, 2], [3, '4']] }), error('INPUT', /point 1 of the top edge/));
  assert.throws(by({ ...edges, top: { beziers: 3 } }), error('INPUT', /beziers/));
  assert.throws(by({ ...edges, top: [[1, 2], [NaN, 3]] }), error('NOT_FINITE'));
  assert.throws(by(edges, { focalLength: 0 }), error('OPTION', /focalLength/));
  assert.throws(by(edges, { focalLength: focal, fieldOfView: 60 }), error('OPTION', /one of them/));
  assert.throws(by(edges, { page: 'a3' }), error('OPTION', /page/));
  assert.notEqual(direct.dewarpPage(photo, edges, { focalLength: focal, page: [100, 100] }).verdict, 'unrolled');
  assert.throws(by(edges, { ruler: { from: [0, 0] } }), error('OPTION', /ruler/));
  await assert.rejects(developable.dewarpPage(photo, { top: edges.bottom, bottom: edges.top }), error('EDGES'));
});

/** An edge list as JSON. */
const file = JSON.stringify(edges);

test('the focal length of a photo file', async () => {
  const jpeg = await readFile(new URL('../data/colour.jpg', import.meta.url));
  assert.equal(direct.readPhoto(jpeg).film35, undefined);
  assert.equal(direct.readPhoto(withExif(jpeg, { film35: 26 })).film35, 26);
  assert.equal((await developable.readPhoto(withExif(jpeg, { film35: 28 }))).film35, 28);
});

test('the command', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(photo));
  await writeFile(join(folder, 'edges.json'), file);
  await writeFile(join(folder, 'swapped.json'), JSON.stringify({ top: edges.bottom, bottom: edges.top }));
  await writeFile(join(folder, 'broken.json'), '{');

  const told = 'dewarp photo.png --edges edges.json --focal-length 480 --page a4 --dots 1 -o page.png --map map.npy --report report.json';
  assert.match((await run(folder, told)).stderr, /no line of text checks how the page is bent/);
  const flat = direct.readPhoto(await readFile(join(folder, 'page.png')));
  assert.deepEqual([flat.width, flat.height], [210, 297]);
  const map = await readFile(join(folder, 'map.npy'));
  assert.ok(map.toString('latin1', 0, 128).includes('(297, 210, 2)'));
  const [x, y] = seen(0.5 / 210, 0.5 / 297);
  const at = map.length - 8 * 210 * 297;
  assert.ok(Math.hypot(map.readFloatLE(at) - x, map.readFloatLE(at + 4) - y) < 0.5);
  const report = JSON.parse(await readFile(join(folder, 'report.json'), 'utf8'));
  assert.ok(report.verdict === 'unchecked' && report.unit === 'mm' && report.error < report.errorBound, JSON.stringify(report));

  assert.equal((await run(folder, 'dewarp photo.png --edges edges.json --field-of-view 67.4 --page 210x297 -o page.png')).status, 0);

  // Corners alone.
  await writeFile(join(folder, 'corners.json'), JSON.stringify({
    top: [[60, 60], [420, 60]], bottom: [[60, 580], [420, 580]],
  }));
  const corners = await succeeds(folder, 'dewarp photo.png --edges corners.json --focal-length 480 -o page.png');
  assert.match(corners.stderr, /outline may be wrong/, 'the photo shows no edge between them');

  await refuses(folder, [
    ['dewarp photo.png --edges swapped.json -o f.png', /exchange/, 3],
    ['dewarp photo.png --edges broken.json -o f.png', /broken\.json.*JSON/, 3],
    ['dewarp photo.png --edges none.json -o f.png', /none\.json/, 3],
    ['dewarp photo.png --edges edges.json --focal-length 0 -o f.png', /--focal-length is 0/],
    ['dewarp photo.png --edges edges.json --focal-length 480 --field-of-view 60 -o f.png', /one of them/],
    ['dewarp photo.png --edges edges.json --page a3 -o f.png', /--page must be/],
    ['dewarp photo.png --edges edges.json --lambda big -o f.png', /--lambda is for heights/],
    ['dewarp photo.png --edges edges.json -o edges.json', /\.png/],
    ['dewarp photo.png --texture photo.png --field-of-view 60 -o f.png', /--field-of-view is for a photo alone/],
  ]);
});

test('lines of text are found where the photo shows print', () => {
  const data = new Uint8ClampedArray(4 * width * height).fill(230);
  // Lines of blocks for letters, in millimetres from the upper left corner.
  for (let foot = 30; foot < 280; foot += 16) {
    for (let x = 20; x < 190; x += x % 5 < 1 ? 9 : 6) {
      for (let u = x; u < x + 4; u += 0.3) {
        for (let v = foot - 6; v < foot; v += 0.3) {
          const [col, row] = seen(u / 210, v / 297).map(Math.round);
          data.fill(40, 4 * (row * width + col), 4 * (row * width + col) + 3);
        }
      }
    }
  }
  const page = { width, height, data };
  const known = /** @type {const} */ ({ focalLength: focal, page: 'a4', dots: 1 });
  const flat = direct.dewarpPage(page, edges, known);
  const { lines, linesFound, linesDisagreement } = flat.report;
  assert.equal(flat.verdict, 'unrolled');
  assert.ok(linesFound >= 12 && lines === linesFound && linesDisagreement < 0.2, JSON.stringify(flat.report));
  assert.deepEqual([flat.lines.length, flat.lines[0].length], [1, linesFound]);
  // As points of the photo, which may be given back.
  const again = direct.dewarpPage(page, { ...edges, lines: flat.lines[0] }, known);
  assert.deepEqual([again.report.lines, again.report.linesFound, again.lines.flat().length], [linesFound, 0, 0]);
  const none = direct.dewarpPage(page, edges, { ...known, findLines: false });
  assert.deepEqual([none.report.lines, none.report.linesFound, none.lines.flat().length], [0, 0, 0]);
  // Whose edges are a doubtful outline's, the page is no surer than that.
  const doubtful = direct.dewarpPage(page, edges, { ...known, doubtfulOutline: true });
  assert.deepEqual([doubtful.verdict, doubtful.report.doubt], ['doubtful', 'outline']);
  assert.ok(doubtful.report.errorBound > flat.report.errorBound);
  assert.throws(() => direct.dewarpPage(page, edges, /** @type {any} */ ({ findLines: 'yes' })), error('OPTION', /findLines/));
});

/** A photo with each pixel repeated. @param {typeof photo} photo @param {number} times */
function enlarged({ width, height, data }, times) {
  const [from, to] = [new Uint32Array(data.buffer), new Uint32Array(width * height * times * times)];
  for (let i = 0; i < to.length; i += 1) {
    const [x, y] = [i % (width * times), Math.floor(i / (width * times))].map((at) => Math.floor(at / times));
    to[i] = from[y * width + x];
  }
  return { width: width * times, height: height * times, data: new Uint8ClampedArray(to.buffer) };
}

test('a page is found at one resolution, and flattened at any', async () => {
  // 6 times 640 pixels are more than those in which pages are found, 3 times are half of that.
  const [small, large] = [3, 6].map((times) => enlarged(photo, times));
  /** @param {number} times @returns {[import('../../pkg/types.js').PageEdges, { focalLength: number }]} */
  const known = (times) => {
    const at = (/** @type {[number, number][]} */ line) => line.map((point) => point.map((v) => times * (v + 0.5) - 0.5));
    return [/** @type {any} */ ({ top: at(edges.top), bottom: at(edges.bottom) }), { focalLength: times * focal }];
  };
  const image = /** @type {const} */ ({ page: 'a4', light: 'keep' });
  const [byEdges, focalSmall] = known(3);
  const preview = direct.dewarpPage(small, byEdges, { ...focalSmall, ...image, dots: 1 });
  const [largeEdges, focalLarge] = known(6);
  const whole = direct.dewarpPage(large, largeEdges, { ...focalLarge, ...image, dots: 1 });
  assert.deepEqual([whole.warp.columns, whole.warp.rows], [preview.warp.columns, preview.warp.rows]);
  assert.ok(whole.warp.places.every((place, i) => Math.abs(place - preview.warp.places[i]) < 1e-6));
  const close = (/** @type {number} */ a, /** @type {number} */ b) => assert.ok(Math.abs(a / b - 1) < 1e-9, `${a} for ${b}`);
  close(whole.report.focalLength, 2 * preview.report.focalLength);
  close(whole.report.residual, 2 * preview.report.residual);
  close(whole.report.error, preview.report.error);

  // The file of the whole photo by the preview's page: the same places, to a tenth of a pixel of the photo.
  const file = direct.flattenPhoto(large, preview, { light: 'keep', dots: 1 });
  assert.deepEqual([file.width, file.height, file.size, file.unit], [210, 297, preview.size, 'mm']);
  assert.ok(file.map.every((at, i) => Math.abs(at - 2 * (preview.map[i] + 0.5) + 0.5) < 0.1));
  assert.ok(file.data.every((value, i) => Math.abs(value - preview.data[i]) <= 2));
  const fine = direct.flattenPhoto(large, preview, { light: 'keep' });
  assert.ok(fine.width > 1000 && fine.resolution > 5, String(fine.width));
  // As a program keeps the page: by its size and warp alone.
  const { size, unit, warp } = structuredClone(preview);
  assert.deepEqual(direct.flattenPhoto(large, { size, unit, warp }, { light: 'keep', dots: 1 }), file);
  assert.throws(() => direct.flattenPhoto(large, /** @type {any} */ ({ size })), error('INPUT', /dewarpPage/));
  assert.throws(() => direct.flattenPhoto(large, { size, unit, warp: { ...warp, rows: 3 } }), error('SHAPE', /warp/));
  assert.throws(() => direct.flattenPhoto(large, preview, /** @type {any} */ ({ page: 'a4' })), error('OPTION', /page/));
});

test('lines of text, and all four edges', async () => {
  /** @param {number} t @param {number} [bent] down the page, by its middle */
  const line = (t, bent = 0) => Array.from({ length: 12 }, (_, i) => {
    const s = 0.1 + (0.8 * i) / 11;
    return seen(s, t + bent * Math.sin(Math.PI * s));
  });
  const levels = [0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85];
  const known = { focalLength: focal, dots: 1 };
  const side = Array.from({ length: 9 }, (_, i) => seen(0, i / 8));
  /** @param {any} changed */
  const by = (changed) => () => direct.dewarpPage(photo, { ...edges, ...changed }, known);
  assert.throws(by({ lines: 1 }), error('INPUT', /`lines` must be a list/));
  assert.throws(by({ lines: [[[1, 2, 3]]] }), error('INPUT', /point 0 of line 0 of the text/));
  assert.throws(by({ lines: [[[1, 2], [9, 9]]] }), error('EDGES', /line 0 of the text.*not between/));
  assert.throws(by({ lines: Array.from({ length: 501 }, () => line(0.5)) }), error('TOO_LARGE', /500/));
  assert.throws(by({ left: side }), error('INPUT', /or all four/));
  assert.throws(by({ line: [] }), error('INPUT', /lines/));
  await assert.rejects(developable.dewarpPage(photo, { ...edges, lines: [/** @type {any} */ ('a')] }, known), error('INPUT', /line 0 of the text/));

  const folder = await temporaryFolder();
  await writeFile(join(folder, 'photo.png'), direct.writePhoto(photo));
  await writeFile(join(folder, 'edges.json'), JSON.stringify({ ...edges, lines: levels.map((t) => line(t, 0.03)) }));
  const told = await run(folder, ['dewarp', 'photo.png', '--edges', 'edges.json', '--focal-length', String(focal), '-o', 'page.png']);
  assert.equal(told.status, 0);
  assert.match(told.stderr, /its edges and lines of text disagree \(by .*correct an edge that leaves the page/);
});

/** A white page with lines of text on a dark table, seen from above. */
const sheet = photoOf(600, 700, (x, y) => {
  const onPage = x >= 100 && x < 500 && y >= 80 && y < 646;
  const onText = x >= 140 && x < 460 && y >= 120 && y < 500 && y % 16 < 5 && x % 40 < 32;
  const grey = onPage ? (onText ? 60 : 230) : 70;
  return [grey, grey, grey, 255];
});

test('photos come as files, corners as points, and options without edges', async () => {
  const known = /** @type {const} */ ({ focalLength: 700, page: 'a4', dots: 1, findLines: false });
  const flat = direct.dewarpPage(sheet, undefined, known);
  assert.deepEqual([flat.width, flat.height, flat.outline], [210, 297, direct.findPage(sheet)]);
  assert.deepEqual(direct.dewarpPage(sheet, known), flat);
  assert.throws(() => direct.dewarpPage(sheet, /** @type {any} */ ({ pages: 'a4' })), error('OPTION', /pages.*page/));

  const corners = /** @type {const} */ ([[99.5, 79.5], [499.5, 79.5], [499.5, 645.5], [99.5, 645.5]]);
  const [a, b, c, d] = corners;
  const byCorners = direct.dewarpPage(sheet, corners, known);
  assert.deepEqual(byCorners, direct.dewarpPage(sheet, { top: [a, b], bottom: [d, c], left: [a, d], right: [b, c] }, known));
  // The edges are traced in the photo, or straight if that is asked for.
  const asGiven = { ...known, traceEdges: false };
  const straight = direct.dewarpPage(sheet, corners, asGiven);
  const points = (/** @type {typeof flat} */ { edges: [{ top, left }] }) => [top, left].map((edge) => (Array.isArray(edge) ? edge.length : 0));
  assert.deepEqual(points(straight), [2, 2]);
  assert.ok(points(byCorners).every((count) => count > 50), `${points(byCorners)}`);
  assert.deepEqual(straight.edges, [{ top: [a, b], bottom: [d, c], left: [a, d], right: [b, c] }]);

  const png = direct.writePhoto(sheet);
  const server = createServer((_, response) => response.end(png));
  await new Promise((listening) => server.listen(0, '127.0.0.1', () => listening(undefined)));
  const { port } = /** @type {import('node:net').AddressInfo} */ (server.address());
  const address = `http://127.0.0.1:${port}/`;
  try {
    for (const source of [png, new Uint8Array(png).buffer, new Blob([png]), new File([png], 'a.png'), new Response(png), address, new URL(address)]) {
      assert.deepEqual(await developable.readPhoto(source), direct.readPhoto(png));
    }
    assert.deepEqual(await developable.dewarpPage(new Response(png), corners, asGiven), straight);
    assert.deepEqual(await developable.findPage(new Blob([png])), flat.outline);
    assert.deepEqual(direct.dewarpPage(png, corners, asGiven), straight);
  } finally {
    server.close();
  }
  await assert.rejects(developable.readPhoto(new Response('', { status: 404 })), error('INPUT', /404/));

  // A rectangle seen straight on is flat whatever the focal length is.
  const level = (/** @type {number} */ y) => Array.from({ length: 12 }, (_, i) => /** @type {[number, number]} */ ([99.5 + (400 * i) / 11, y]));
  const edgesOnly = direct.dewarpPage(sheet, { top: level(79.5), bottom: level(645.5) }, { page: 'a4' });
  assert.equal(edgesOnly.verdict, 'flat');
  assert.match(developable.describePage(edgesOnly.report), /only the perspective/);
  assert.match(direct.describePage({ ...flat.report, verdict: 'doubtful', doubt: 'crumpled', error: 1.234 }), /doubtful: it is crumpled.*1\.2 %/);
});

/** The same page under a warm lamp, with a shadow across it. */
const shaded = {
  ...sheet,
  data: sheet.data.map((value, i) => {
    const [x, y, k] = [(i >> 2) % sheet.width, Math.floor((i >> 2) / sheet.width), i % 4];
    if (k === 3) return 255;
    return value * [1, 0.9, 0.7][k] * (1 - 0.5 * Math.min(Math.max((x + y - 800) / 6, 0), 1));
  }),
};

test('light is evened on documents, kept where that is wished, and pages become black and white', () => {
  const known = /** @type {const} */ ({ focalLength: 700, page: 'a4', dots: 2, findLines: false });
  const [even, kept, ink] = [{}, { light: 'keep' }, { ink: true }].map((more) => direct.dewarpPage(shaded, undefined, { ...known, .../** @type {{}} */ (more) }));
  assert.deepEqual([even.light, kept.light, ink.light], ['even', 'keep', 'even']);
  /** The smallest value of each colour on the page below its text. @param {{ width: number, height: number, data: Uint8ClampedArray }} flat */
  const darkest = ({ width, height, data }) => {
    const least = [255, 255, 255];
    for (let y = Math.ceil(0.78 * height); y < height - 12; y += 1) {
      for (let x = 12; x < width - 12; x += 1) for (let k = 0; k < 3; k += 1) least[k] = Math.min(least[k], data[4 * (y * width + x) + k]);
    }
    return least;
  };
  // The edge of the shadow is sharper than a pixel: a trace of it is left.
  assert.ok(Math.min(...darkest(even)) > 205, String(darkest(even)));
  assert.ok(Math.max(...darkest(kept)) < 140, String(darkest(kept)));
  assert.deepEqual(darkest(ink), [255, 255, 255]);
  const counts = new Map();
  for (let i = 0; i < ink.data.length; i += 4) counts.set(ink.data.slice(i, i + 4).join(), (counts.get(ink.data.slice(i, i + 4).join()) ?? 0) + 1);
  assert.deepEqual([...counts.keys()].sort(), ['0,0,0,255', '255,255,255,255']);
  assert.throws(() => direct.dewarpPage(shaded, undefined, /** @type {any} */ ({ light: 'bright' })), error('OPTION', /even or keep/));
});

/** The table on which the sheet lies, without a page. */
const table = { ...sheet, data: sheet.data.map((_, i) => (i % 4 === 3 ? 255 : 70 + ((i >> 2) % 3))) };

test('the command makes one PDF of several photos, and names those without a page, which lose none of the others', async () => {
  const folder = await temporaryFolder();
  for (const [name, one] of Object.entries({ a: sheet, b: table, c: shaded })) await writeFile(join(folder, `${name}.png`), direct.writePhoto(one));
  const { status, stderr } = await run(folder, 'dewarp a.png b.png c.png gone.png -o book.pdf --ink --page letter --report report.json');
  assert.equal(status, 1);
  assert.match(stderr, /^developable: b\.png: no page was found in the photo/m);
  assert.match(stderr, /^developable: cannot read gone\.png: there is no such file/m);
  assert.match(stderr, /developable: book\.pdf: 2 of 4 photos\ndevelopable: not in book\.pdf: b\.png, gone\.png\n$/);
  const file = await readFile(join(folder, 'book.pdf'));
  assert.match(file.toString('latin1'), /\/Title \(book\)/);
  const book = await readPdf(file);
  assert.equal(book.length, 2);
  for (const { size } of book) assert.ok(size.every((side, k) => Math.abs(side - [215.9, 279.4][k]) < 1), String(size));
  const reports = JSON.parse(await readFile(join(folder, 'report.json'), 'utf8'));
  assert.deepEqual(reports.map((/** @type {any} */ { input, light, failure }) => [input, light, failure !== undefined]),
    [['a.png', 'even', false], ['b.png', undefined, true], ['c.png', 'even', false], ['gone.png', undefined, true]]);
  // One photo without a format is on A4.
  await succeeds(folder, 'dewarp c.png -o one.pdf --light keep');
  const [{ size }] = await readPdf(await readFile(join(folder, 'one.pdf')));
  assert.ok(size.every((side, k) => Math.abs(side - [210, 297][k]) < 1), String(size));
  await refuses(folder, [
    ['dewarp a.png c.png -o book.pdf --map map.npy', /--map is for one photo/],
    ['dewarp a.png c.png -o c.png', /one file for several inputs/],
    ['dewarp a.png c.png -o book.pdf --lambda big', /--lambda is for heights/],
    ['dewarp a.png -o one.png --light dim', /--light must be even or keep/],
    ['dewarp b.png gone.png -o none.pdf', /none of the photos was flattened/, 3],
  ]);
});

test('a photo without a page is refused', () => {
  assert.equal(direct.findPage(table).verdict, 'notFound');
  assert.throws(() => direct.dewarpPage(table), error('NO_PAGE', /trace its edges, or take the photo again/));
});

