/** Whole meshes, without a view: directly, in a worker and by the command. */
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as developable from '../../pkg/index.js';
import * as direct from '../../pkg/direct.js';
import { refuses, run, silent, succeeds, temporaryFolder } from './support/command.mjs';
import { error } from './support/error.mjs';
import { boxTo } from './support/shapes.mjs';

after(() => developable.dispose());

/** A repeatable number about normal, of variance 1. */
function noise() {
  let state = 5;
  const uniform = () => {
    state = (state * 1103515245 + 12345) % 2 ** 31;
    return state / 2 ** 31;
  };
  return () => Array.from({ length: 12 }, uniform).reduce((sum, x) => sum + x, -6);
}

/**
 * A bottle lying along z: a pipe of radius 1 that goes on to a cone, open at both ends, with noise along its normals.
 * @param {number} around @param {number} sigma
 */
function bottle(around, sigma) {
  const rows = Math.round(around / 2);
  const random = noise();
  const positions = [];
  const triangles = [];
  for (let j = 0; j <= rows; j++) {
    const z = (3 * j) / rows;
    for (let i = 0; i < around; i++) {
      const angle = (2 * Math.PI * (i + (j % 2) / 2)) / around;
      const r = radius(z) + sigma * random();
      positions.push(r * Math.cos(angle), r * Math.sin(angle), z);
      if (j === rows) continue;
      const [a, b] = [j * around + i, j * around + ((i + 1) % around)];
      const [c, d] = [a + around, b + around];
      triangles.push(...(j % 2 === 0 ? [a, b, c, b, d, c] : [a, d, c, a, b, d]));
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** @param {number} z */
const radius = (z) => (z < 2 ? 1 : 1 - (z - 2) / 2);

/** Root mean square of how far vertices are from the bottle. @param {Float64Array} positions */
function off(positions) {
  let squares = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = positions.subarray(i, i + 3);
    squares += (Math.hypot(x, y) - radius(z)) ** 2;
  }
  return Math.sqrt((3 * squares) / positions.length);
}

const sigma = 0.02;
const noisy = bottle(46, sigma);

test('fits to meshes have a wasm of their own', async () => {
  assert.throws(() => direct.fitMesh(noisy), error('NOT_INITIALIZED', /load\('fitmesh'\)/));
  await Promise.all([direct.init(), direct.load('files', 'meshes', 'fitmesh')]);
});

test('a whole mesh comes out smoother, and all else of it as it was', async () => {
  const count = noisy.positions.length / 3;
  const colors = Float32Array.from({ length: 3 * count }, (_, i) => (i % 7) / 7);
  const uvs = Float32Array.from({ length: 2 * count }, (_, i) => (i % 5) / 5);
  const before = noisy.positions.slice();
  /** @type {import('../../pkg/types.js').Progress[]} */
  const news = [];
  const mesh = { ...noisy, colors, uvs, unit: /** @type {const} */ ('mm') };
  const found = await developable.fitMesh(mesh, { onProgress: (progress) => void news.push(progress) });
  assert.ok(off(found.positions) < 0.4 * sigma, `${off(found.positions)}`);
  assert.deepEqual(noisy.positions, before);
  assert.deepEqual([found.triangles, found.colors, found.uvs, found.unit], [noisy.triangles, colors, uvs, 'mm']);
  const { report } = found;
  assert.equal(report.vertices, count);
  assert.equal(report.border, 2 * 46);
  assert.ok(report.sigma !== undefined && Math.abs(report.sigma / sigma - 1) < 0.15, String(report.sigma));
  const last = report.passes[report.passes.length - 1];
  assert.ok(last.gap !== undefined && last.gap <= 0.01 && last.dualBound <= last.objective);
  assert.equal(report.volume, undefined);
  assert.ok(news.length > 0);
  // The same here, and the result is an input again.
  const own = direct.fitMesh(mesh);
  assert.deepEqual(own.positions, found.positions);
  assert.ok(direct.fitMesh(own, { lambda: 'medium' }).report.passes.length > 0);
  assert.ok((await developable.sampleMesh(found, { view: 'best-fit' })).rows > 10);
});

test('vertices are held, and trusted more or less', () => {
  const count = noisy.positions.length / 3;
  const held = Array.from({ length: count }, (_, i) => i % 50 === 7);
  const found = direct.fitMesh(noisy, { held });
  for (let i = 0; i < count; i++) {
    const same = [0, 1, 2].every((k) => found.positions[3 * i + k] === noisy.positions[3 * i + k]);
    assert.equal(same, held[i], `vertex ${i}`);
  }
  // A dent that is not to be trusted goes.
  const dented = { ...noisy, positions: noisy.positions.slice(), confidence: new Float32Array(count).fill(1) };
  const dent = [607, 608, 667];
  for (const i of dent) {
    for (const k of [0, 1]) dented.positions[3 * i + k] *= 0.9;
    dented.confidence[i] = 0;
  }
  /** @param {{ positions: Float64Array }} mesh */
  const depth = ({ positions }) => 1 - Math.min(...dent.map((i) => Math.hypot(positions[3 * i], positions[3 * i + 1])));
  const [trusting, wary] = [direct.fitMesh({ ...dented, confidence: undefined }), direct.fitMesh(dented)];
  assert.ok(depth(wary) < 0.5 * depth(trusting), `${depth(wary)} ${depth(trusting)}`);
});

test('what is wrong is told, and nothing is harmed', async () => {
  const { positions, triangles } = noisy;
  const thrice = Uint32Array.from([...triangles, triangles[3000], triangles[3001], 999]);
  assert.ok(direct.fitMesh({ positions, triangles: thrice }).report.repairs.branched > 0);
  const alone = { positions: positions.slice(0, 9), triangles: Uint32Array.of(0, 1, 2) };
  assert.throws(() => direct.fitMesh(alone, { lambda: 1e6 }), error('TOPOLOGY', /inside/));
  await assert.rejects(developable.fitMesh(alone, { lambda: 1e6 }), error('TOPOLOGY', /inside/));
  const cloud = { positions, triangles: new Uint32Array() };
  assert.throws(() => direct.fitMesh(cloud), error('UNSUPPORTED', /no triangles/));
  assert.throws(() => direct.fitMesh(noisy, { held: [true] }), error('SHAPE', /held/));
  assert.throws(() => direct.fitMesh(noisy, { creasePasses: 30 }), error('OPTION', /creasePasses/));
  const unknown = /** @type {object} */ ({ energy: 'nuclear' });
  assert.throws(() => direct.fitMesh(noisy, unknown), error('OPTION', /energy/));
});

test('an abort stops it, or keeps the best surface so far', async () => {
  const large = bottle(150, sigma);
  const stopping = new AbortController();
  const reason = new Error('enough');
  const wait = developable.fitMesh(large, { signal: stopping.signal, gap: 1e-6, onProgress: () => stopping.abort(reason) });
  await assert.rejects(wait, reason);
  const keeping = new AbortController();
  const kept = await developable.fitMesh(large, {
    signal: keeping.signal,
    onAbort: 'keep',
    gap: 1e-6,
    onProgress: () => keeping.abort(),
  });
  assert.equal(kept.report.stopReason, 'cancelled');
  assert.ok(kept.positions.every(Number.isFinite));
});

test('the command fits whole meshes, and says so where a view would lose much', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'scan.ply'), direct.writePly(noisy));
  const done = await run(folder, ['fit', 'scan.ply', '--unit', 'mm', '-o', 'whole.ply', '--surface', '--report', 'r.json']);
  assert.deepEqual(done, silent);
  const report = JSON.parse(await readFile(join(folder, 'r.json'), 'utf8'));
  assert.equal(report.vertices, noisy.positions.length / 3);
  const found = direct.readMesh(await readFile(join(folder, 'whole.ply')));
  assert.ok(off(found.positions) < 0.4 * sigma);
  for (const output of ['whole.obj', 'whole.stl', 'whole.glb']) {
    assert.equal((await run(folder, ['fit', 'scan.ply', '--unit', 'mm', '-o', output, '--surface'])).stderr, '');
    const other = direct.readMesh(await readFile(join(folder, output)));
    assert.equal(other.triangles.length, noisy.triangles.length, output);
  }
  const seen = await run(folder, ['fit', 'scan.ply', '-o', 'seen.ply', '--view', '-x']);
  assert.equal(seen.status, 0);
  const [, share] = /(\d+) % of the area of scan\.ply is not seen/.exec(seen.stderr) ?? [];
  assert.ok(Number(share) > 35 && Number(share) < 65, seen.stderr);
  await refuses(folder, [
    ['fit scan.ply -o x.ply --surface --view -z', /--view is for heights/],
    ['fit scan.ply -o x.ply --surface --energy huber', /--energy is for heights/],
    ['fit scan.ply -o x.npy --surface', /\.obj, \.ply, \.stl or \.glb/],
  ]);
  assert.match((await run(folder, ['fit', 'scan.png', '-o', 'x.ply', '--surface'])).stderr, /--surface is for meshes/);
});

/** Three triangles along one edge, of areas 1/2, √2/2 and √2/2. */
const branched = { positions: Float64Array.of(0, 0, 0, 0, 0, 1, 1, 0, 0.5, -1, 1, 0.5, -1, -1, 0.5), triangles: Uint32Array.of(0, 1, 2, 1, 0, 3, 0, 1, 4) };

/** Areas of the bottle's two parts. */
const [pipe, cone] = [4 * Math.PI, 1.5 * Math.PI * Math.hypot(1, 0.5)];

test('patterns of a whole mesh at several λ', async () => {
  const smallest = [0.02];
  /** @type {import('../../pkg/types.js').PatternPlan[]} */
  const told = [];
  const { plans, chosen } = await developable.explorePattern(noisy, { smallest, pattern: { scale: 10 }, onPlan: (plan) => told.push(plan) });
  assert.equal(chosen, undefined);
  assert.deepEqual(told, plans);
  const { report, positions } = await developable.fitMesh(noisy);
  const close = (/** @type {number} */ one, /** @type {number} */ other) => assert.ok(Math.abs(one / other - 1) < 1e-9, `${one} for ${other}`);
  [1, 0.3, 0.1, 0.03].forEach((share, k) => close(plans[k].lambda, share * report.lambda));
  const steps = Array.from({ length: positions.length / 3 }, (_, i) => Math.hypot(...[0, 1, 2].map((k) => positions[3 * i + k] - noisy.positions[3 * i + k])));
  close(plans[0].distance, Math.sqrt(steps.reduce((sum, step) => sum + step ** 2, 0) / steps.length));
  plans.forEach(({ distance }, k) => assert.ok(k === 0 || distance > plans[k - 1].distance, 'the smoother, the farther'));
  for (const { drawing } of plans) {
    assert.ok(drawing && drawing.summary.strain <= 0.01);
    // In square millimetres.
    assert.ok(Math.abs(drawing.summary.area / (100 * (pipe + cone)) - 1) < 0.05, `${drawing.summary.area}`);
  }
  const sheets = plans[0].drawing?.sheets.length;
  const few = await developable.explorePattern(noisy, { lambdas: [1e3, report.lambda], smallest, sheets });
  assert.equal(few.plans.length, 1);
  assert.equal(few.chosen, few.plans[0]);
  assert.equal(few.plans[0].lambda, report.lambda);
  await assert.rejects(developable.explorePattern(noisy, /** @type {any} */ ({ lambdas: 3 })), error('OPTION', /lambdas/));
  await assert.rejects(developable.explorePattern(noisy, /** @type {any} */ ({ solver: { spacing: 1 } })), error('OPTION', /spacing/));
  await assert.rejects(developable.explorePattern(branched, { lambdas: [1e6] }), error('TOPOLOGY', /inside/));
  await assert.rejects(developable.explorePattern(noisy, { signal: AbortSignal.abort() }), { name: 'AbortError' });
});

test('the command traces rulings of whole meshes', async () => {
  await direct.load('meshes');
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'scan.ply'), direct.writePly(noisy));
  const done = await run(folder, ['rulings', 'scan.ply', '--unit', 'mm', '-o', 'r.obj', '--surface', '--separation', '0.4', '--report', 'r.json']);
  assert.deepEqual([done.status, done.stdout], [0, ''], done.stderr);
  assert.match(done.stderr, /^developable: scan\.ply has no exact faces, .* off a smooth surface by 0\.02 .*\n$/);
  /** @type {{ lines: import('../../pkg/types.js').Ruling[] }} */
  const { lines } = JSON.parse(await readFile(join(folder, 'r.json'), 'utf8'));
  assert.ok(lines.length >= 12, String(lines.length));
  const obj = await readFile(join(folder, 'r.obj'), 'utf8');
  const points = [...obj.matchAll(/^v (\S+) (\S+) (\S+)$/gm)].map((match) => match.slice(1).map(Number));
  const drawn = [...obj.matchAll(/^l (.*)$/gm)].map(([, numbers]) => numbers.split(' ').map((n) => points[Number(n) - 1]));
  assert.deepEqual(drawn, lines.map((line) => line.points));
  const told = await run(folder, ['rulings', 'scan.ply', '--surface', '--as-is', '--separation', '0.8']);
  assert.deepEqual([told.status, Object.keys(JSON.parse(told.stdout))], [0, ['lines']]);
  assert.match((await run(folder, ['rulings', 'scan.ply', '--surface', '--min-confidence', '7'])).stderr, /--min-confidence is 7/);
});

test('the command lays whole meshes flat', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'scan.ply'), direct.writePly(noisy));
  const text = async (/** @type {string} */ name) => readFile(join(folder, name), 'utf8');
  const drawn = await succeeds(folder, ['pattern', 'scan.ply', '-o', 'a.svg', '--surface', '--scale', '10', '--report', 'a.json']);
  assert.match(drawn.stderr, /sheets?, strained by .* slits? besides the creases/);
  const { sheets, strain } = JSON.parse(await text('a.json'));
  assert.ok(sheets >= 1 && sheets <= 4 && strain <= 0.01, `${sheets} sheets, ${strain}`);
  assert.match(await text('a.svg'), /<svg/);
  const flat = await run(folder, ['unroll', 'scan.ply', '--unit', 'mm', '-o', 'flat.obj', '--surface', '--report', 'flat.json']);
  assert.deepEqual([flat.status, flat.stdout], [0, ''], flat.stderr);
  assert.match(flat.stderr, /^developable: scan\.ply has no exact faces, .* off a smooth surface by 0\.02 .*\n$/);
  const report = JSON.parse(await text('flat.json'));
  assert.equal(report.sheets, sheets);
  const ofPatches = report.patches.reduce((/** @type {number} */ sum, /** @type {{ area: number }} */ { area }) => sum + area, 0);
  assert.ok(Math.abs(ofPatches / report.area - 1) < 1e-9, `${ofPatches} ${report.area}`);
  const mesh = direct.readMesh(await readFile(join(folder, 'flat.obj')));
  assert.ok(mesh.positions.every((x, i) => i % 3 !== 2 || x === 0));
  const told = await run(folder, ['analyze', 'scan.ply', '--surface', '--as-is']);
  assert.equal(told.status, 0);
  assert.deepEqual(Object.keys(JSON.parse(told.stdout)), ['input']);
  assert.match((await run(folder, ['pattern', 'scan.ply', '-o', 'a.svg', '--surface', '--view', '-z'])).stderr, /--view is for heights/);
  const table = await run(folder, ['pattern', 'scan.ply', '--surface', '--explore']);
  assert.match(table.stdout, /^ *lambda  smallest  sheets .*\n( *[1-9][.\d]*e\+\d  .* %  .*\n){12}$/);
  const few = await run(folder, ['pattern', 'scan.ply', '-o', 'few.svg', '--surface', '--sheets', '9', '--scale', '10']);
  assert.match(few.stderr, /sheets? with --lambda \d+(\.\d+)? and --smallest 0\.005, 0\.0\d+ from the input/);
  assert.match(await readFile(join(folder, 'few.svg'), 'utf8'), /<svg/);
  assert.match((await run(folder, ['pattern', 'scan.ply', '--surface', '--explore', '--lambda', '3'])).stderr, /leave --lambda out/);
});

test('a block of 2 × 1 × 0.5, as programs for inches write it, is drawn once its unit is said', async () => {
  await direct.init();
  await direct.load('meshes');
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'block.stl'), direct.writeStl(boxTo([2, 1, 0.5])));
  assert.match((await run(folder, ['info', 'block.stl'])).stdout, /^unit: +not known$[^]*^assumed: +.*side of 2 is too short for millimetres, and may be inches or metres \(--unit/m);
  const asked = ['pattern', 'block.stl', '--surface', '--as-is', '-o', 'block.svg', '--report', 'block.json'];
  await refuses(folder, [[asked, /nothing says in what unit.*--unit mm, cm, m or inch.*--scale/]]);
  const area = async (/** @type {string[]} */ ...said) => {
    await succeeds(folder, [...asked, ...said]);
    return JSON.parse(await readFile(join(folder, 'block.json'), 'utf8')).area;
  };
  // Two faces each of 2 × 1, 2 × 0.5 and 1 × 0.5 square inches.
  assert.ok(Math.abs(await area('--unit', 'inch') - 7 * 25.4 ** 2) < 0.1);
  assert.ok(Math.abs(await area('--scale', '10') - 700) < 0.1);
});

test('a mesh of which one side hides much is taken whole without a flag, and so is what has no noise', async () => {
  await direct.init();
  await direct.load('meshes');
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'box.stl'), direct.writeStl(boxTo([30, 20, 10])));
  // Open, and seen entirely from above: two rectangles that meet at an edge.
  const positions = Float64Array.of(0, 0, 0, 40, 0, 0, 0, 30, 10, 40, 30, 10, 0, 60, 0, 40, 60, 0);
  const gable = { positions, triangles: Uint32Array.of(0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4) };
  await writeFile(join(folder, 'gable.stl'), direct.writeStl(gable));
  const area = async (/** @type {string} */ file, /** @type {string[]} */ ...more) => {
    const { stderr } = await succeeds(folder, ['pattern', file, '-o', 'x.svg', '--report', 'x.json', '--unit', 'mm', ...more]);
    return [JSON.parse(await readFile(join(folder, 'x.json'), 'utf8')).area, stderr];
  };
  const [whole, words] = await area('box.stl');
  assert.ok(Math.abs(whole - 2 * (600 + 300 + 200)) < 1e-6, String(whole));
  assert.match(words, /box\.stl is taken as it is: each of its faces is kept \(--lambda auto removes noise first\)/);
  const [left, smoothed] = await area('box.stl', '--lambda', 'auto');
  assert.ok(Math.abs(left - whole) < 1e-6, String(left));
  assert.match(smoothed, /box\.stl has no noise/);
  // Few faces are those of a model, however rough, unless a fit is asked for.
  const height = (/** @type {number} */ x, /** @type {number} */ y) => 0.02 * (x - 4.5) ** 2 * (y - 4.5) + ((Math.sin(12.9898 * (10 * y + x)) * 43758.5453) % 0.3);
  const rough = Float64Array.from(Array.from({ length: 100 }, (_, i) => [i % 10, Math.floor(i / 10), height(i % 10, Math.floor(i / 10))]).flat());
  const squares = Array.from({ length: 81 }, (_, i) => 10 * Math.floor(i / 9) + (i % 9));
  const corners = Uint32Array.from(squares.flatMap((a) => [a, a + 1, a + 11, a, a + 11, a + 10]));
  await writeFile(join(folder, 'rough.stl'), direct.writeStl({ positions: rough, triangles: corners }));
  const [kept, said] = await area('rough.stl');
  assert.match(said, /each of its faces is kept \(--lambda auto/);
  const [fitted, told] = await area('rough.stl', '--lambda', 'auto');
  assert.match(told, /rough\.stl has no exact faces, .* by 0\.\d+/);
  assert.ok(fitted < 0.95 * kept, `${fitted} ${kept}`);
  assert.ok(Math.abs((await area('gable.stl'))[0] - 2 * 40 * Math.hypot(30, 10)) < 1e-6);
  for (const size of ['60', '60mm', '6 cm']) assert.ok(Math.abs((await area('box.stl', '--size', size))[0] - 4 * 2200) < 1e-6, size);
  // A side is taken where it is asked for, and what else is there is said.
  const [above, warned] = await area('box.stl', '--view', '+z');
  assert.ok(Math.abs(above - 600) < 60, String(above));
  assert.match(warned, /[67]\d % of the area of box\.stl is not seen/);
  const fit = await run(folder, ['fit', 'box.stl', '-o', 'fitted.stl', '--unit', 'mm']);
  assert.match(fit.stderr, /box\.stl has no noise that is worth removing: it is left as it is/);
  assert.doesNotMatch(fit.stderr, /mended/);
  const places = Array.from({ length: 25 }, (_, i) => `v ${10 * (i % 5)} ${10 * Math.floor(i / 5)} 0`);
  const faces = Array.from({ length: 16 }, (_, i) => i + 1 + Math.floor(i / 4)).flatMap((i) => [`f ${i} ${i + 1} ${i + 6}`, i === 8 ? `f ${i} ${i + 5} ${i + 6}` : `f ${i} ${i + 6} ${i + 5}`]);
  await writeFile(join(folder, 'turned.obj'), [...places, ...faces, ''].join('\n'));
  const turned = await run(folder, ['fit', 'turned.obj', '--surface', '-o', 'turned.ply']);
  assert.match(turned.stderr, /triangles of turned\.obj that are mended for the fit: 1 on the wrong side\n/);
  const { triangles } = await direct.readMesh(await readFile(join(folder, 'fitted.stl')), { unit: 'mm' });
  assert.equal(triangles.length, 36);
});

test('what is fitted before it is laid flat is said, with the noise that was found', async () => {
  await direct.init();
  await direct.load('meshes');
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'bottle.stl'), direct.writeStl(noisy));
  const words = async (/** @type {string[]} */ ...more) =>
    (await run(folder, ['rulings', 'bottle.stl', '-o', 'x.json', '--surface', '--unit', 'mm', ...more])).stderr;
  const [, found] = /bottle\.stl has no exact faces, .* by ([\d.]+) in the file's unit/.exec(await words()) ?? [];
  assert.ok(Math.abs(Number(found) / sigma - 1) < 0.2, found);
  assert.doesNotMatch(await words('--as-is'), /fitted/);
});

test('a box is laid flat as it is, at the size that is asked for', async () => {
  const box = boxTo([30, 20, 10]);
  assert.deepEqual(await developable.recognizeMesh(box), { kind: 'faces' });
  const { summary, sheets } = await developable.pattern(box, { size: 60, tabs: 5 });
  // Twice as large; the shortest cut leaves the five longest edges that make a tree: four of 30 are not all of them.
  assert.equal(summary.sheets, 1);
  assert.equal(summary.folds, 5);
  assert.equal(summary.strain, 0);
  assert.ok(Math.abs(summary.area - 4 * 2 * (600 + 300 + 200)) < 1e-6, String(summary.area));
  assert.equal(summary.untabbed, 0);
  assert.equal(sheets[0].folds.every(({ angle }) => Math.abs(angle - 90) < 1e-9), true);
  const plain = await developable.pattern(box, { plain: true });
  assert.deepEqual(plain.sheets[0].labels.map(({ kind }) => kind), ['sheet']);
  await assert.rejects(developable.pattern(box, { size: 60, scale: 2 }), { code: 'OPTION' });
});
