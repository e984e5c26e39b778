/** Patterns to be cut out: lengths in the files, read by other programs, against the surface. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
// @ts-expect-error three.js has no types of its own
import { AnimationMixer, LoopOnce, Mesh, Vector3 } from 'three';
// @ts-expect-error
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { launch, skip } from './support/browser.mjs';
import { refuses, run, silent, succeeds, temporaryFolder } from './support/command.mjs';
import { extent, length, readDxf, readPdf } from './support/drawings.mjs';
import { error } from './support/error.mjs';
import { lattice } from './support/shapes.mjs';

after(() => developable.dispose());

const slope = 0.6;
const [rows, cols] = [101, 90];
/** A card of 89 by 100 rows, folded upright at x = 40.3: a ridge. */
const card = lattice(rows, cols, (x) => -slope * Math.abs(x - 40.3));
const scale = 3;
/** The card when it was flat, in millimetres. */
const flat = { width: scale * (cols - 1) * Math.hypot(1, slope), height: scale * (rows - 1) * Math.sqrt(0.75) };
const angle = (2 * Math.atan(slope) * 180) / Math.PI;

/** A pyramid: four faces, a cut from the apex to a corner. */
const pyramid = lattice(94, 81, (x, y) => -0.8 * Math.max(Math.abs(x - 40.2), Math.abs(y + 40.4)));

/** @param {number} found @param {number} expected @param {number} [share] */
function near(found, expected, share = 0.002) {
  assert.ok(Math.abs(found - expected) <= share * Math.abs(expected), `${found} is not ${expected}`);
}

before(() => Promise.all([direct.init(), direct.load('files', 'unroll')]));

test('patterns have a wasm of their own', async () => {
  assert.throws(() => direct.pattern(card), error('NOT_INITIALIZED', /load\('patterns'\)/));
  await direct.load('patterns');
});

test('a drawing in millimetres', async () => {
  const drawing = direct.pattern(card, { scale });
  const { sheets: [sheet], summary } = drawing;
  assert.deepEqual([drawing.sheets.length, sheet.name, sheet.patches.length], [1, 'Sheet 1', 2]);
  const [fold] = sheet.folds;
  assert.equal(fold.direction, 'mountain');
  near(fold.angle, angle, 0.01);
  near(fold.length, flat.height);
  near(length(fold.points), fold.length, 1e-9);
  near(summary.cutLength, 2 * (flat.width + flat.height));
  near(summary.mountainLength, flat.height);
  near(summary.area, flat.width * flat.height, 0.01);
  assert.deepEqual([summary.valleyLength, summary.seams, summary.folds, summary.tabs], [0, 0, 1, 0]);
  // The two sides of the fold are at most the default apart.
  assert.ok(summary.seamGap >= 0 && summary.seamGap <= 0.005 * flat.height, `${summary.seamGap}`);
  // The other way round it is a groove.
  const groove = lattice(rows, cols, (x) => slope * Math.abs(x - 40.3));
  assert.equal(direct.pattern(groove).sheets[0].folds[0].direction, 'valley');
});

test('SVG, measured by a browser', { skip }, async () => {
  const drawing = direct.pattern(card, { scale });
  const svg = direct.writeSvg(drawing, { title: 'a <card> & more' });
  const browser = await launch();
  try {
    const page = await browser.newPage();
    await page.setContent(`<body style="margin:0">${new TextDecoder().decode(svg)}</body>`);
    const found = await page.evaluate(`(() => {
      const millimetres = ({ width, height }) => [width, height].map((side) => (side * 25.4) / 96);
      const path = (layer) => document.querySelector('#' + layer + ' path');
      return {
        title: document.querySelector('svg > title').textContent,
        page: millimetres(document.querySelector('svg').getBoundingClientRect()),
        sheet: [path('cut').getBBox().width, path('cut').getBBox().height],
        shown: millimetres(path('cut').getBoundingClientRect()),
        around: path('cut').getTotalLength(),
        fold: path('mountain').getTotalLength(),
        angle: Number(path('mountain').dataset.angle),
        valleys: document.querySelectorAll('#valley path').length,
        texts: [...document.querySelectorAll('#label text')].map((text) => text.textContent.trim()),
      };
    })()`);
    assert.equal(found.title.trim(), 'a <card> & more');
    near(found.page[0], drawing.width, 1e-3);
    near(found.page[1], drawing.height, 1e-3);
    near(found.sheet[0], flat.width);
    near(found.sheet[1], flat.height);
    near(found.shown[0], flat.width, 0.005); // with the line's width
    near(found.around, 2 * (flat.width + flat.height));
    near(found.fold, flat.height);
    near(found.angle, angle, 0.01);
    assert.equal(found.valleys, 0);
    assert.deepEqual(found.texts.sort(), ['1', '2', `M ${Math.round(angle)}°`, 'Sheet 1'].sort());
  } finally {
    await browser.close();
  }
});

test('PDF on one page, measured by PDF.js', async () => {
  const drawing = direct.pattern(card, { scale });
  const pdf = direct.writePdf(drawing, { title: 'card' });
  const [page, ...more] = await readPdf(pdf);
  assert.equal(more.length, 0);
  near(page.size[0], drawing.width, 1e-5);
  // Below the drawing there is a foot with the scale line.
  near(page.size[1], drawing.height + 10, 1e-5);
  assert.ok(page.texts.some((text) => text.includes('print at 100 %') && text.includes('card')), page.texts.join());
  assert.equal(page.lines.filter(({ points }) => Math.abs(length(points) - 100) < 1e-3).length, 1);
  const [cut] = page.lines.filter(({ dashes, closed }) => dashes === 0 && closed);
  const [width, height] = extent(cut.points);
  near(width, flat.width);
  near(height, flat.height);
  near(length(cut.points, true), 2 * (flat.width + flat.height));
  const [fold] = page.lines.filter(({ dashes }) => dashes === 4);
  near(length(fold.points), flat.height);
  assert.ok(page.texts.includes(`M ${Math.round(angle)}°`), page.texts.join());
});

for (const [paper, sides] of /** @type {const} */ ([['a4', [210, 297]], ['letter', [215.9, 279.4]]])) {
  test(`pages of ${paper} give the whole back when they are laid on each other by their marks`, async () => {
    const drawing = direct.pattern(card, { scale });
    const pages = await readPdf(direct.writePdf(drawing, { stock: paper }));
    assert.equal(pages.length, drawing.summary[paper]);
    assert.ok(pages.length >= 4, `${pages.length} pages`);
    // Each cross is two lines with a common middle, upright and level; the scale line is longer.
    const sheets = pages.map(({ size, texts, lines, clip }) => {
      assert.deepEqual(size.map(Math.round).sort(), sides.map(Math.round));
      const middles = lines.flatMap(({ points: [p, q], points, dashes }) =>
        (points.length === 2 && dashes === 0 && p[1] === q[1] && Math.abs(q[0] - p[0]) < 20 ? [/** @type {[number, number]} */ ([(p[0] + q[0]) / 2, p[1]])] : []));
      assert.ok(middles.length >= 4);
      const name = texts.find((text) => /^[A-Z]+\d+$/.test(text)) ?? '';
      return { name, crosses: middles, clip: clip ?? [], drawn: lines.filter(({ points, dashes }) => points.length > 2 || dashes > 0) };
    });
    assert.equal(new Set(sheets.map(({ name }) => name)).size, pages.length);
    // From page to page: the crosses at the right of one are those at the left of the next.
    /** @param {[number, number][]} crosses @param {0 | 1} k @param {1 | -1} way */
    const edge = (crosses, k, way) => {
      const most = Math.max(...crosses.map((p) => way * p[k]));
      return crosses.filter((p) => way * p[k] > most - 1).sort((p, q) => p[1 - k] - q[1 - k]);
    };
    /** @type {Map<string, [number, number]>} */
    const shifts = new Map([[sheets[0].name, [0, 0]]]);
    for (let pass = 0; pass < sheets.length; pass += 1) {
      for (const sheet of sheets) {
        const shift = shifts.get(sheet.name);
        if (!shift) continue;
        const [, letters, number] = /** @type {RegExpExecArray} */ (/^([A-Z])(\d+)$/.exec(sheet.name));
        const right = `${String.fromCharCode(letters.charCodeAt(0) + 1)}${number}`;
        const below = `${letters}${Number(number) + 1}`;
        for (const [name, k, way] of /** @type {const} */ ([[right, 0, 1], [below, 1, -1]])) {
          const other = sheets.find((one) => one.name === name);
          if (!other || shifts.has(name)) continue;
          const [here] = edge(sheet.crosses, k, way);
          const [there] = edge(other.crosses, k, /** @type {1 | -1} */ (-way));
          shifts.set(name, [shift[0] + here[0] - there[0], shift[1] + here[1] - there[1]]);
        }
      }
    }
    assert.equal(shifts.size, sheets.length);
    // In the first page's place every page draws the same, and together they show all of it.
    /** @param {typeof sheets[number]} sheet @param {readonly [number, number][]} points */
    const placed = ({ name }, points) => {
      const [dx, dy] = /** @type {[number, number]} */ (shifts.get(name));
      return points.map(([x, y]) => /** @type {[number, number]} */ ([x + dx, y + dy]));
    };
    const whole = sheets[0].drawn;
    const parts = [];
    for (const sheet of sheets) {
      for (const [i, { points }] of sheet.drawn.entries()) {
        placed(sheet, points).forEach(([x, y], k) => {
          const [p, q] = whole[i].points[k];
          assert.ok(Math.hypot(x - p, y - q) < 0.01, `${sheet.name}: ${x} ${y}, ${p} ${q}`);
        });
      }
      const clip = placed(sheet, sheet.clip);
      parts.push([0, 1].flatMap((k) => [Math.min(...clip.map((p) => p[k])), Math.max(...clip.map((p) => p[k]))]));
    }
    for (const { points, closed } of whole) {
      const ring = closed ? [...points, points[0]] : points;
      for (let i = 1; i < ring.length; i += 1) {
        for (let t = 0; t <= 1; t += 1 / 64) {
          const [x, y] = [0, 1].map((k) => ring[i - 1][k] + t * (ring[i][k] - ring[i - 1][k]));
          assert.ok(parts.some(([l, r, b, u]) => x >= l && x <= r && y >= b && y <= u), `${x} ${y} is on no page`);
        }
      }
    }
    near(extent(whole.flatMap(({ points }) => points))[0], flat.width);
  });
}

test('DXF, read by another library', async () => {
  const drawing = direct.pattern(card, { scale });
  const dxf = direct.writeDxf(drawing);
  assert.deepEqual(direct.writeDxf(drawing), dxf, 'the same each time');
  const { layers, texts, unit } = readDxf(dxf);
  assert.equal(unit, 4);
  assert.deepEqual(Object.keys(layers).sort(), ['CUT', 'MOUNTAIN']);
  const [{ points, closed }] = layers.CUT;
  assert.equal(closed, true);
  near(extent(points)[0], flat.width);
  near(extent(points)[1], flat.height);
  near(length(layers.MOUNTAIN[0].points), flat.height);
  assert.ok(texts.some((text) => text.startsWith(`M ${Math.round(angle)}`)), texts.join());
});

test('what is wrong is said', async () => {
  const rough = lattice(12, 12, (x, y) => 40 * Math.abs(Math.sin(127.1 * x + 311.7 * y)));
  assert.throws(() => direct.pattern(rough, { faces: 0 }), error('NOT_FLAT', /around \(.*\).* limit of 1 %/));
  for (const options of [{ scale: -1 }, { scale: NaN }, { tabs: NaN }, { maxSeamGap: -1 }, { maxStrain: 0 }, { scale: 1e9 }]) {
    const [name] = Object.keys(options);
    assert.throws(() => direct.pattern(card, options), error('OPTION', new RegExp(name)));
  }
  assert.throws(() => direct.pattern(card, /** @type {any} */ ({ scales: 2 })), error('OPTION', /scales/));
  assert.throws(() => direct.pattern(card, { spacing: 2 }), error('OPTION', /spacing/));
  assert.throws(() => direct.pattern(lattice(2, 2, () => 0)), error('NO_INTERIOR'));
  assert.throws(() => direct.pattern(lattice(9, 9, () => NaN)), error('NO_INTERIOR'));
  const drawing = direct.pattern(card, { scale: 100 });
  assert.throws(() => direct.writePdf(drawing, { stock: 'a4' }), error('UNSUPPORTED', /pages/));
  assert.throws(() => direct.writePdf(drawing), error('UNSUPPORTED', /5\.08/));
  assert.throws(() => direct.writePdf(drawing, /** @type {any} */ ({ stock: 'a5' })), error('OPTION', /a4, letter/));
  for (const nothing of [undefined, {}, { ...drawing, sheets: 3 }]) {
    assert.throws(() => direct.writeSvg(/** @type {any} */ (nothing)), error('INPUT', /drawing/));
  }
  const broken = { ...drawing, width: NaN };
  assert.throws(() => direct.writeSvg(broken), error('UNSUPPORTED', /finite/));
  await assert.rejects(developable.pattern(card, { scale: 0 }), error('OPTION', /scale/));
});

/** @param {number[]} point @param {number[]} from @param {number[]} to */
function distanceToSegment([x, y], [a, b], [c, d]) {
  const share = ((x - a) * (c - a) + (y - b) * (d - b)) / ((c - a) ** 2 + (d - b) ** 2 || 1);
  const t = Math.min(Math.max(share, 0), 1);
  return Math.hypot(x - a - t * (c - a), y - b - t * (d - b));
}

/** A barrel vault through a lower one: three sheets with curved edges. */
const vaults = lattice(94, 81, height);

/** @param {number} x @param {number} y */
function height(x, y) {
  const arc = (/** @type {number} */ v) => Math.sqrt(3136 - v ** 2);
  return Math.max(arc(x - 40) - 4, arc(y + 40));
}

test('curved edges are curves in each format', { skip }, async () => {
  const drawing = direct.pattern(vaults, { stock: 'a4' });
  assert.ok(drawing.summary.mismatch < 0.004, `${drawing.summary.mismatch}`);
  const cuts = drawing.sheets.flatMap((sheet) => sheet.cuts);
  const around = cuts.map((cut) => length(cut, true));
  // As many pages as its sheets take, all of them whole, in Inkscape's words as well.
  assert.equal(drawing.pages?.pages.length, drawing.summary.a4);
  const svg = new TextDecoder().decode(direct.writeSvg(drawing));
  assert.equal(svg.match(/<inkscape:page /g)?.length, drawing.summary.a4);
  const paths = [...svg.matchAll(/<path d="([^"]*)"/g)].map(([, data]) => data);
  assert.ok(paths.some((data) => /C/.test(data)) && paths.some((data) => /L/.test(data)));
  const browser = await launch();
  try {
    const page = await browser.newPage();
    await page.setContent(`<body style="margin:0">${svg}</body>`);
    const found = await page.evaluate("[...document.querySelectorAll('#cut path')].map((path) => path.getTotalLength())");
    found.forEach((/** @type {number} */ own, /** @type {number} */ i) => near(own, around[i], 1e-3));
  } finally {
    await browser.close();
  }
  const pages = await readPdf(direct.writePdf(drawing));
  assert.equal(pages.length, drawing.summary.a4);
  const [{ lines }] = pages;
  const drawn = lines.filter(({ closed }) => closed);
  drawn.forEach((line, i) => near(length(line.points, true), around[i], 1e-3));
  assert.ok(drawn.some(({ corners, points }) => corners < points.length / 4));
  const { layers } = readDxf(direct.writeDxf(drawing));
  layers.CUT.forEach(({ points }, i) => near(length(points, true), around[i], 1e-3));
  assert.ok(layers.CUT.some(({ corners, points }) => corners < points.length / 4));
});

test('kerf, allowance, marks and numbers beside small pieces', () => {
  const plain = direct.pattern(card, { scale });
  /** @param {typeof plain} drawing */
  const box = ({ sheets: [{ bounds: [low, high] }] }) => [0, 1].map((k) => high[k] - low[k]);
  for (const [options, grown] of /** @type {const} */ ([[{ kerf: 0.4 }, 0.4], [{ allowance: 8 }, 16], [{ allowance: 8, kerf: 0.4 }, 16.4]])) {
    const drawing = direct.pattern(card, { scale, ...options });
    box(drawing).forEach((side, k) => assert.ok(Math.abs(side - box(plain)[k] - grown) < 0.02, `${side} ${box(plain)[k]}`));
    const edges = drawing.sheets[0].edges.length;
    assert.equal(edges, 'allowance' in options ? 1 : 0);
    const { layers } = readDxf(direct.writeDxf(drawing));
    if (edges > 0) near(length(layers.EDGE[0].points, true), plain.summary.cutLength);
  }
  const marked = direct.pattern(vaults, { scale: 4, marks: 30 });
  // Half of them on each side; each begins on the outline and runs 3 mm inwards.
  const marks = marked.sheets.flatMap((sheet) => sheet.marks.map((line) => ({ sheet, ends: [line[0], line[3]] })));
  const { seamLength, seams } = marked.summary;
  assert.ok(marks.length % 2 === 0 && Math.abs(marks.length / 2 - seamLength / 30 + seams) <= seams, `${marks.length} ${seamLength}`);
  for (const { sheet, ends: [foot, tip] } of marks) {
    near(Math.hypot(tip[0] - foot[0], tip[1] - foot[1]), 3, 1e-6);
    const away = sheet.cuts.flatMap((cut) => cut.map((from, i) => distanceToSegment(foot, from, cut[(i + 1) % cut.length])));
    assert.ok(Math.min(...away) < 0.05, `${Math.min(...away)}`);
    assert.ok(inside(tip, sheet.cuts[0]) && !inside([2 * foot[0] - tip[0], 2 * foot[1] - tip[1]], sheet.cuts[0]));
  }
  const small = direct.pattern(pyramid, { scale: 0.08 });
  const [{ leaders, labels, cuts }] = small.sheets;
  const numbers = labels.filter(({ kind }) => kind === 'patch');
  assert.ok(leaders.length > 0 && numbers.length === 4);
  assert.equal(numbers.filter(({ place }) => !inside(place, cuts[0])).length, leaders.length);
  for (const line of leaders) assert.ok(inside(line[0], cuts[0]) && !inside(line[3], cuts[0]));
});

/** @param {readonly number[]} point @param {readonly (readonly [number, number])[]} ring */
function inside([x, y], ring) {
  return ring.filter(([ax, ay], i) => {
    const [bx, by] = ring[(i + 1) % ring.length];
    return (ay > y) !== (by > y) && x < ax + ((bx - ax) * (y - ay)) / (by - ay);
  }).length % 2 === 1;
}

test('sheets go from flat to built, as three.js has it', async () => {
  const { assembly, sheets } = direct.pattern(vaults, { scale: 2, assembly: true });
  assert.ok(assembly);
  const { steps, model, picture } = assembly;
  assert.deepEqual(steps.map(({ sheet }) => sheet).sort(), sheets.map((_, i) => i));
  assert.deepEqual(steps[0].joints, []);
  for (const { joints } of steps.slice(1)) assert.ok(joints.length > 0);
  const { scene, animations: [clip] } = await new GLTFLoader().parseAsync(/** @type {ArrayBuffer} */ (model.buffer), '');
  assert.equal(clip.name, 'Assembly');
  const mixer = new AnimationMixer(scene);
  const action = mixer.clipAction(clip).setLoop(LoopOnce, 1);
  action.clampWhenFinished = true;
  action.play();
  const places = (/** @type {number} */ time) => {
    mixer.setTime(time);
    scene.updateMatrixWorld(true);
    /** @type {any[]} three's vectors */
    const found = [];
    scene.traverse((/** @type {any} */ part) => {
      if (!(part instanceof Mesh)) return;
      for (let i = 0; i < part.geometry.attributes.position.count; i += 1) {
        found.push(part.localToWorld(part.getVertexPosition(i, new Vector3())).multiplyScalar(500));
      }
    });
    return found;
  };
  const start = places(0);
  const level = start.map(({ y }) => y);
  assert.ok(Math.max(...level) - Math.min(...level) < 1e-3, 'flat');
  const end = places(clip.duration);
  assert.ok(end.length > 5000);
  // +y is up, and the rows of the lattice go down; creases are smoothed, and corners are beyond the outermost vertices.
  for (const { x, y, z } of end) assert.ok(Math.abs(y - height(x, -z)) < 0.1, `${x} ${y} ${z}`);
  // Corners of a triangle are as far from each other when they lie flat, but on creases, where a sheet ends within it.
  let first = 0;
  const [edges, kept] = [[], []].map(() => /** @type {number[]} */ ([]));
  scene.traverse((/** @type {any} */ part) => {
    if (!(part instanceof Mesh)) return;
    const { index, attributes: { position } } = part.geometry;
    for (let i = 0; i < index.count; i += 3) {
      const [a, b] = [0, 1].map((k) => first + index.getX(i + k));
      edges.push(a);
      if (Math.abs(start[a].distanceTo(start[b]) / end[a].distanceTo(end[b]) - 1) < 0.02) kept.push(a);
    }
    first += position.count;
  });
  assert.ok(kept.length > 0.95 * edges.length, `${kept.length} of ${edges.length}`);
  const svg = new TextDecoder().decode(picture);
  assert.equal(svg.match(/<path /g)?.length, sheets.length);
  assert.equal(svg.match(/<polyline /g)?.length ?? 0, sheets.reduce((sum, { folds }) => sum + folds.length, 0));
  assert.ok(/class="patch"[^>]*>\s*3\s*</.test(svg) && /class="seam"[^>]*>\s*a\s*</.test(svg), svg.slice(-900));
  assert.equal(direct.pattern(vaults).assembly, undefined);
});

test('plans at several λ', async () => {
  const wavy = lattice(26, 22, (x, y) => -0.6 * Math.abs(x - 10.3) + 0.2 * Math.sin(1.9 * x) * Math.sin(2.3 * y));
  const told = [];
  const { plans, chosen } = await developable.explorePattern(wavy, {
    lambdas: [3e3, 3e6], smallest: [0.3, 0.02], pattern: { scale: 2, maxStrain: 0.2 }, onPlan: (plan) => told.push(plan),
  });
  assert.equal(chosen, undefined);
  assert.equal(told.length, 4);
  assert.deepEqual(plans.map(({ lambda, smallest }) => [lambda, smallest]), [[3e6, 0.02], [3e6, 0.3], [3e3, 0.02], [3e3, 0.3]]);
  assert.ok(plans[0].distance < plans[2].distance && plans[0].distance === plans[1].distance);
  for (const { drawing, problem } of plans) assert.ok((drawing === undefined) !== (problem === undefined));
  const counts = plans.map(({ drawing }) => drawing?.sheets.length ?? Infinity);
  const least = Math.min(...counts);
  const few = await developable.explorePattern(wavy, {
    lambdas: [3e3, 3e6], smallest: [0.02, 0.3], sheets: least, pattern: { scale: 2, maxStrain: 0.2 },
  });
  assert.equal(few.plans.length, counts.indexOf(least) + 1);
  assert.equal(few.chosen, few.plans.at(-1));
  await assert.rejects(developable.explorePattern(wavy, /** @type {any} */ ({ lambdas: 3 })), error('OPTION', /lambdas/));
  await assert.rejects(developable.explorePattern(wavy, { pattern: { scale: -1 } }), error('OPTION', /scale/));
  await assert.rejects(developable.explorePattern(wavy, { signal: AbortSignal.abort() }), { name: 'AbortError' });
});

test('the command', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'card.npy'), direct.writeImage(card));
  const from = 'pattern card.npy --lattice hex --no-data 1e9 --as-is';
  assert.deepEqual(await run(folder, `${from} -o card.svg --scale ${scale} --report card.json`), silent);
  const drawing = direct.pattern(card, { scale });
  assert.deepEqual(new Uint8Array(await readFile(join(folder, 'card.svg'))), direct.writeSvg(drawing, { title: 'card' }));
  assert.match(await readFile(join(folder, 'card.svg'), 'utf8'), /<title>\s*card\s*<\/title>/);
  assert.match(new TextDecoder().decode(direct.writeSvg(drawing)), /<title>\s*Pattern\s*<\/title>/);
  const report = JSON.parse(await readFile(join(folder, 'card.json'), 'utf8'));
  // A report is asked for, and so are its sheets folded back.
  const { summary } = direct.pattern(card, { scale, refold: true });
  assert.deepEqual(report, { ...summary, assembly: [{ sheet: 0, joints: [] }], assumptions: [] });
  assert.ok(/** @type {number} */ (summary.refolding) < 1e-3);
  assert.deepEqual(await run(folder, `${from} -o card.pdf --scale ${scale} --stock letter`), silent);
  assert.equal((await readPdf(await readFile(join(folder, 'card.pdf')))).length, drawing.summary.letter);
  assert.deepEqual(await run(folder, `${from} -o card.dxf --tabs 5`), silent);
  assert.equal(readDxf(await readFile(join(folder, 'card.dxf'))).unit, 4);
  assert.deepEqual(await run(folder, 'pattern card.npy --lattice hex --no-data 1e9 -o fitted.json --lambda big'), silent);
  const fitted = JSON.parse(await readFile(join(folder, 'fitted.json'), 'utf8'));
  near(fitted.sheets[0].folds[0].length, flat.height / scale, 0.01);
  assert.deepEqual(await run(folder, `${from} -o made.svg --assembly made.glb --marks 20 --kerf 0.2`), silent);
  assert.equal(String(await readFile(join(folder, 'made.glb'))).slice(0, 4), 'glTF');
  await writeFile(join(folder, 'pyramid.npy'), direct.writeImage(pyramid));
  const { stderr } = await run(folder, 'pattern pyramid.npy --lattice hex --as-is -o pyramid.svg');
  assert.match(stderr, /the angles of the pieces around a point differ .* by at most [\d.]+°/);
  await writeFile(join(folder, 'small.npy'), direct.writeImage(lattice(24, 20, (x) => -0.6 * Math.abs(x - 9.3))));
  const small = 'pattern small.npy --lattice hex --no-data 1e9';
  const table = await succeeds(folder, `${small} --explore`);
  assert.match(table.stdout, /^lambda +smallest +sheets .*\n(.*\n){18}$/);
  const one = await run(folder, `${small} -o one.json --sheets 1 --report one-report.json`);
  assert.deepEqual([one.status, one.stdout], [0, '']);
  assert.match(one.stderr, /1 sheet with --lambda \d/);
  assert.equal(JSON.parse(await readFile(join(folder, 'one-report.json'), 'utf8')).sheets, 1);
  await refuses(folder, [
    [`${small} --explore -o plans.svg`, /--explore writes a table/],
    [`${small} -o few.svg --sheets 2 --lambda big`, /leave --lambda out/],
    [`${small} -o few.svg --assembly few.obj`, /\.glb or \.svg/],
    [`${from} -o card.png`, /\.svg, \.pdf, \.dxf or \.json/],
    [`${from} -o card.svg --stock 40x`, /Sheet 1 takes/, 3],
    [`${from} -o card.pdf --stock a5`, /--stock must be a4, letter, WIDTHxHEIGHT/],
    [`${from} -o card.svg --scale -2`, /--scale is -2/],
    [`${from} -o card.svg --tabs none`, /--tabs must be a number/],
    [`${from} -o card.pdf --scale 100 --stock a4`, /pages/, 3],
    ['unroll card.npy -o card.obj --scale 2', /--scale is not for "unroll"/],
  ]);
});
