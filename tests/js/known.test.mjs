/** What may be known besides the heights: confidence, constraints, occlusions; and what is minimised. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { error } from './support/error.mjs';
import { cylinder, deviation, image, lattice, noisy, plane, rms } from './support/shapes.mjs';

await direct.init();

/** The vertices of a surface with a height, each with its place. @param {direct.Surface} surface */
function* vertices({ rows, cols, spacing, origin, heights }) {
  for (let i = 0; i < rows * cols; i += 1) {
    if (Number.isNaN(heights[i])) continue;
    const row = Math.floor(i / cols);
    const x = origin[0] + ((i % cols) - (row % 2) / 2) * spacing;
    yield { x, y: origin[1] - row * spacing * Math.sqrt(0.75), z: heights[i], i };
  }
}

/** Constraints of `f` at the pixels where it is not NaN. @param {number} width @param {number} height */
function points(width, height, /** @type {(x: number, y: number) => number} */ f, pixelSize = 1) {
  const { data, ...frame } = image(width, height, f, pixelSize);
  return { ...frame, constraints: data };
}

/** Two planes with a jump between them, on the lattice. */
const step = lattice(24, 30, (x, y) => plane(x, y) + (x > 14.2 ? 6 : 0));

test('three points give their plane, at every pixel', () => {
  const pins = new Set(['1,1', '20,2', '8,15']);
  const design = points(24, 18, (x, y) => (pins.has([x - 0.5, y - 0.5].join()) ? plane(x, y) : NaN));
  const surface = direct.fit(design);
  const { constrained, free, interior, boundary, objective } = surface.report;
  assert.equal(constrained + free, interior + boundary);
  assert.equal(constrained, 3);
  // Up to half a pixel from where the pixels are: that is where the vertices are.
  assert.ok(objective < 1e-6, `${objective}`);
  assert.equal(surface.image?.data.length, 24 * 18);
  for (const [i, z] of surface.image?.data.entries() ?? []) {
    const [x, y] = [(i % 24) + 0.5, 18 - Math.floor(i / 24) - 0.5];
    assert.ok(Math.abs(z - plane(x, y)) < 0.3, `pixel ${i}: ${z}`);
  }
});

test('constraints on the lattice are met exactly, and a plane through them is found', () => {
  const whole = lattice(15, 17, plane, 0.5);
  const chosen = [18, 30, 127, 210, 233];
  const constraints = whole.heights.map((z, i) => (chosen.includes(i) ? z : NaN));
  const { heights: _, ...frame } = whole;
  const surface = direct.fit({ ...frame, constraints });
  for (const i of chosen) assert.ok(Math.abs(surface.heights[i] - whole.heights[i]) < 1e-12);
  assert.ok(deviation(surface.heights, whole.heights) < 1e-5);
  assert.equal(surface.report.constrained, chosen.length);
  // A value in the place of NaN, and a mask for the outline.
  const zeros = constraints.map((z) => (Number.isNaN(z) ? 0 : z));
  const mask = whole.heights.map((_, i) => (i % 17 > 0 ? 1 : 0));
  const cut = direct.fit({ ...frame, constraints: zeros, noData: 0, mask: Uint8Array.from(mask) });
  for (const [i, z] of cut.heights.entries()) assert.equal(Number.isNaN(z), i % 17 === 0);
});

test('constraints of an image are in its steps, and take the place of its heights', () => {
  const levels = { ...image(26, 22, () => 10), heightScale: 0.5 };
  const constraints = levels.data.map((_, i) => (i === 26 * 11 + 13 ? 16 : NaN));
  const surface = direct.fit({ ...levels, constraints }, { lambda: 'big' });
  const pinned = [...vertices(surface)].filter(({ z }) => Math.abs(z - 8) < 1e-9);
  assert.deepEqual([surface.report.constrained, pinned.length], [1, 1]);
  assert.ok(Math.hypot(pinned[0].x - 13.5, pinned[0].y - 10.5) < 0.6);
  // In the corner nothing of it is left.
  assert.ok(Math.abs((surface.image?.data[0] ?? NaN) - 5) < 0.1);
});

test('heights without confidence do not count', () => {
  const clean = image(30, 24, plane);
  const spoilt = (/** @type {number} */ i) => i % 30 >= 10 && i % 30 < 16 && i > 240 && i < 480;
  const input = {
    ...clean,
    data: clean.data.map((z, i) => (spoilt(i) ? 40 * Math.sin(i) : z)),
    // From one pixel further on, for between the two the confidence is in between.
    confidence: clean.data.map((_, i) => ([i - 31, i - 30, i - 29, i - 1, i, i + 1, i + 29, i + 30, i + 31].some(spoilt) ? 0 : 2.5)),
  };
  const surface = direct.fit(input);
  assert.ok(surface.image);
  assert.ok(deviation(surface.image.data, clean.data) < 0.02, `${deviation(surface.image.data, clean.data)}`);
  assert.ok(surface.report.free > 20);
  assert.ok(deviation(direct.fit({ ...input, confidence: undefined }).image?.data ?? [], clean.data) > 1);
});

test('confidence is a factor of lambda', () => {
  const rough = lattice(24, 24, noisy((x, y) => cylinder(24)(x, -y), 0.4));
  const options = { gap: 1e-4 };
  const doubled = direct.fit({ ...rough, confidence: new Float32Array(576).fill(4) }, { ...options, lambda: 1e5 });
  const plain = direct.fit(rough, { ...options, lambda: 4e5 });
  assert.ok(Math.abs(doubled.report.objective - plain.report.objective) < 3e-4 * plain.report.objective);
  assert.ok(rms(doubled.heights, plain.heights) < 0.02);
});

test('confidence, mask and occlusions may be what is read of a file', () => {
  const rough = lattice(12, 12, noisy((x, y) => cylinder(12)(x, -y), 0.4));
  const levels = rough.heights.map((_, i) => [0, 51, 255, NaN][i % 4]);
  const file = { width: 12, height: 12, data: levels, dataType: 'u8' };
  const plain = direct.fit({ ...rough, confidence: levels.map((level) => (level || 0) / 255) }, { lambda: 1e5 });
  assert.deepEqual(direct.fit({ ...rough, confidence: file }, { lambda: 1e5 }).heights, plain.heights);
  // Floats are factors already.
  const factors = { ...file, data: levels.map((level) => (level || 0) / 255), dataType: 'f64' };
  assert.deepEqual(direct.fit({ ...rough, confidence: factors }, { lambda: 1e5 }).heights, plain.heights);
  const half = { ...file, data: levels.map((_, i) => (i % 12 < 8 ? 7 : NaN)) };
  const masked = direct.fit({ ...rough, mask: half, occlusions: { data: new Float64Array(144) } }, { lambda: 1e5 });
  assert.deepEqual(masked.heights.map((z) => Number(!Number.isNaN(z))), half.data.map((flag) => Number(flag === 7)));
  assert.throws(() => direct.fit({ ...rough, mask: /** @type {any} */ ({}) }), error('INPUT', /mask must be a flat array/));
  assert.throws(() => direct.fit({ ...rough, confidence: /** @type {any} */ ({ width: 12 }) }), error('INPUT', /data of the confidence must be a flat array/));
});

test('a jump stays where the surface is torn there', () => {
  const torn = direct.fit(step, { occlusionThreshold: 100, paper: true, lambda: 'small' });
  const smoothed = direct.fit(step, { paper: true, lambda: 'small' });
  assert.ok(deviation(torn.heights, step.heights) < 1e-4, `${deviation(torn.heights, step.heights)}`);
  assert.ok(deviation(smoothed.heights, step.heights) > 0.1);
  assert.ok(torn.report.occluded > 20 && smoothed.report.occluded === 0);
  assert.ok(torn.report.objective < 1e-6 && smoothed.report.objective > 1);
  const found = direct.occlusions(step, { threshold: 100 });
  const given = direct.fit({ ...step, occlusions: found.vertices, brokenEdges: found.edges }, { paper: true, lambda: 'small' });
  assert.equal(given.report.occluded, torn.report.occluded);
  assert.deepEqual(given.heights, torn.heights);
  const edges = direct.fit({ ...step, brokenEdges: found.edges }, { paper: true, lambda: 'small' });
  assert.deepEqual(edges.heights, torn.heights);
});

test('small holes are bridged, at the pixels and on the lattice', () => {
  const dead = (/** @type {number} */ x, /** @type {number} */ y) => Math.floor(7 * x + 11 * y) % 6 === 0;
  const truth = cylinder(40);
  const holed = (/** @type {number} */ x, /** @type {number} */ y) => (dead(x, y) ? NaN : truth(x, y));
  const pixels = image(40, 40, holed);
  const bridged = direct.fit(pixels);
  const missing = pixels.data.filter(Number.isNaN).length;
  const there = bridged.image.data.filter((z) => !Number.isNaN(z)).length;
  assert.ok(missing > 200 && bridged.report.bridged > missing / 2);
  assert.ok(there > 1600 - missing / 10, `${there} of 1600 pixels, ${missing} were missing`);
  const off = direct.fit(pixels, { bridge: false });
  assert.equal(off.report.bridged, 0);
  const holes = (/** @type {Float64Array} */ data) => Array.from(data, Number.isNaN);
  assert.deepEqual(holes(off.image.data), holes(pixels.data));
  const vertices = direct.fit(lattice(40, 40, (x, y) => holed(x, -y)), { bridge: 2 });
  assert.ok(vertices.report.bridged > 100);
  const mask = Uint8Array.from(pixels.data, (z) => Number(!Number.isNaN(z)));
  assert.equal(direct.fit({ ...pixels, mask }).report.bridged, 0);
  assert.throws(() => direct.fit(pixels, { bridge: 17 }), error('OPTION', /bridge.*from 1 to 16/s));
});

test('occlusions are found at the jump and nowhere else', () => {
  const found = direct.occlusions(step, { threshold: 100 });
  assert.deepEqual([found.rows, found.cols, found.spacing, found.origin], [24, 30, 1, [0, 0]]);
  assert.equal(found.image, undefined);
  assert.equal(found.count, found.vertices.reduce((sum, flag) => sum + flag, 0));
  for (const [i, flag] of found.vertices.entries()) {
    const row = Math.floor(i / 30);
    const x = (i % 30) - (row % 2) / 2;
    assert.equal(flag !== 0, found.edges[i] !== 0);
    if (flag) assert.ok(Math.abs(x - 14.2) <= Math.sqrt(3), `vertex ${i}`);
    else if (row > 1 && row < 22) assert.ok(Math.abs(x - 14.2) > 0.5, `vertex ${i}`);
  }
  // Without a scale the jump of 6 is one of a curvature of 12, or so.
  assert.equal(direct.occlusions(step, { threshold: 30, normalize: false }).count, 0);
  assert.ok(direct.occlusions(step, { threshold: 3, normalize: false }).count > 20);
  assert.equal(direct.occlusions(lattice(9, 9, plane)).count, 0);
});

test('occlusions in an image come at its pixels as well', () => {
  const jump = image(40, 20, (x, y) => plane(x, y) + (x > 20 ? 9 : 0));
  const found = direct.occlusions(jump, { threshold: 150 });
  assert.equal(found.image?.length, 800);
  const flagged = [...(found.image ?? []).entries()].filter(([, flag]) => flag).map(([i]) => i % 40);
  assert.ok(flagged.length > 30 && flagged.every((col) => col >= 17 && col <= 22), String(flagged));
  const coarse = direct.occlusions(jump, { threshold: 40, spacing: 2 });
  assert.ok(coarse.cols < 25 && coarse.image?.length === 800);
  // And go in as pixels.
  const { report } = direct.fit({ ...jump, occlusions: found.image }, { lambda: 'small' });
  assert.ok(Math.abs(report.occluded - found.count) < 8);
  const plain = direct.fit(jump, { lambda: 'small' });
  assert.ok(report.objective < plain.report.objective / 10);
});

test('each energy is minimised and named', () => {
  const input = image(40, 40, noisy(cylinder(40), 0.3));
  const all = /** @type {const} */ (['nuclear', 'frobenius', 'squaredNuclear', 'secondFormOfInput', 'secondForm']);
  for (const energy of all) {
    const { report } = direct.fit(input, { energy, gap: 0.05 });
    assert.equal(report.energy, energy);
    assert.ok(report.dualBound <= report.objective && (report.gap ?? NaN) <= 0.05, `${energy}: ${report.gap}`);
    assert.ok(Math.abs(report.fidelity + report.nuclearNorm - report.objective) <= 1e-9 * report.objective);
  }
});

test('reweighted passes give back what the norm has shrunk', () => {
  const clean = image(50, 50, cylinder(50));
  const input = image(50, 50, noisy(cylinder(50), 0.2));
  const once = direct.fit(input, { paper: true, lambda: 'small' });
  const thrice = direct.fit(input, { paper: true, lambda: 'small', reweighting: 2 });
  assert.deepEqual([once.report.reweighting, thrice.report.reweighting], [0, 2]);
  assert.ok(once.image && thrice.image);
  assert.ok(rms(thrice.image.data, clean.data) < rms(once.image.data, clean.data));
});

test('wrong inputs and options are named', () => {
  const ramp = image(12, 10, plane);
  const hex = lattice(10, 12, plane);
  /** @param {object} input @param {object} [options] */
  const fit = (input, options) => () => direct.fit(/** @type {any} */ (input), options);
  const design = { width: 12, height: 10, constraints: ramp.data };
  const one = ramp.data.map((z, i) => (i === 50 ? z : NaN));
  assert.throws(fit({ ...design, constraints: one }), error('UNDERDETERMINED', /three/));
  assert.throws(fit({ width: 12, height: 10 }), error('INPUT', /constraints/));
  assert.throws(fit({ ...design, data: null }), error('INPUT', /data.*null/));
  assert.throws(fit({ ...design, constraints: 'none' }), error('INPUT', /constraints.*"none"/));
  assert.throws(fit({ ...design, constraints: [1, 2] }), error('SHAPE', /constraints.*120/));
  assert.throws(fit({ ...hex, constraints: [1, 2] }), error('SHAPE', /constraints.*120/));
  assert.throws(fit({ ...design, constraints: ramp.data.map((z, i) => (i === 14 ? Infinity : z)) }), error('NOT_FINITE', /constraints.*row 1, column 2/));
  assert.throws(fit({ ...design, confidence: ramp.data }), error('INPUT', /confidence/));
  assert.throws(fit({ ...ramp, confidence: [1] }), error('SHAPE', /confidence/));
  for (const input of [ramp, hex]) {
    const spoilt = (/** @type {number} */ value) => Array.from({ length: 120 }, (_, i) => (i === 14 ? value : 1));
    assert.throws(fit({ ...input, confidence: spoilt(-0.5) }), error('OPTION', /confidence.*-0\.5.*row 1, column 2/));
    assert.throws(fit({ ...input, confidence: spoilt(NaN) }), error('NOT_FINITE', /confidence.*row 1, column 2/));
    assert.throws(fit({ ...input, confidence: spoilt(Infinity) }), error('NOT_FINITE', /confidence.*row 1, column 2/));
    assert.throws(fit({ ...input, occlusions: [1] }), error('SHAPE', /occlusions/));
    assert.throws(fit({ ...input, occlusions: new Uint8Array(7) }), error('SHAPE', /occlusions/));
  }
  assert.throws(fit({ ...hex, brokenEdges: new Uint8Array(7) }), error('SHAPE', /edges/));
  assert.throws(fit({ ...ramp, brokenEdges: new Uint8Array(120) }), error('INPUT', /brokenEdges/));

  assert.throws(fit(ramp, { energy: 'isotropic' }), error('OPTION', /energy.*isotropic.*squaredNuclear/));
  for (const bad of [-1, 1.5, '2', 21]) assert.throws(fit(ramp, { reweighting: bad }), error('OPTION', /reweighting/));
  for (const bad of [-1, 0, '2', NaN]) assert.throws(fit(ramp, { tieBreak: bad }), error('OPTION', /tieBreak/));
  for (const bad of [-1, 0, 'many', NaN]) assert.throws(fit(ramp, { occlusionThreshold: bad }), error('OPTION', /occlusionThreshold/));
  assert.throws(fit(ramp, { tiebreak: 1 }), error('OPTION', /tiebreak.*tieBreak/));
  assert.throws(fit(ramp, /** @type {any} */ (null)), error('OPTION', /object.*null/));

  /** @param {object} [options] */
  const look = (options) => () => direct.occlusions(ramp, options);
  for (const bad of [-1, 0, 'auto', NaN]) assert.throws(look({ threshold: bad }), error('OPTION', /`threshold`/));
  assert.throws(look({ lambda: 1 }), error('OPTION', /lambda.*threshold/));
  assert.throws(look(/** @type {any} */ (null)), error('OPTION', /object/));
  assert.throws(() => direct.occlusions(design), error('INPUT', /heights/));
  assert.throws(() => direct.occlusions(hex, { spacing: 1 }), error('OPTION', /spacing/));
});

test('smooth bends come closer to the truth with the energy for them, and its numbers are told', () => {
  const bend = (/** @type {number} */ x, /** @type {number} */ y) => 4 * Math.sin(0.15 * x + 0.05 * y);
  const truth = lattice(60, 60, bend);
  const input = lattice(60, 60, noisy(bend, 0.3));
  const [nuclear, huber] = ['nuclear', 'huber'].map((energy) =>
    direct.fit(input, { lambda: 1e5, energy: /** @type {direct.Energy} */ (energy) }));
  assert.equal(nuclear.report.huber, undefined);
  const miss = (/** @type {direct.Surface} */ { heights }) => rms(heights, truth.heights);
  assert.ok(miss(huber) < 0.8 * miss(nuclear), `${miss(huber)} ${miss(nuclear)}`);
  const { creases, ...numbers } = huber.report.huber ?? assert.fail('nothing is told');
  assert.deepEqual(numbers, { bendRadius: 0.1, flatness: 0.3, creaseRadius: 0.1, creasePasses: 0 });
  assert.equal(creases, 0);
  const own = { bendRadius: 0.2, flatness: 0.5, creaseRadius: 0.3, creasePasses: 1 };
  const { report } = direct.fit(input, { lambda: 1e5, energy: 'huber', ...own });
  assert.deepEqual({ ...report.huber, creases: 0, creasePasses: 1 }, { ...own, creases: 0 });
  for (const [name, bad] of Object.entries({ bendRadius: 0, flatness: 2, creaseRadius: -1, creasePasses: 21 })) {
    assert.throws(() => direct.fit(input, { energy: 'huber', [name]: bad }), error('OPTION', new RegExp(name)));
  }
});

test('lambda by itself follows the noise, and tells how it came about', () => {
  const faces = (/** @type {number} */ x, /** @type {number} */ y) => Math.max(0.3 * x, 0.5 * (30 - y));
  const [quiet, loud] = [0.1, 1].map((noise) =>
    direct.fit(lattice(60, 60, noisy(faces, noise)), { lambda: 'auto', energy: 'huber' }).report);
  assert.equal(quiet.lambdaChoice?.reason, 'prediction');
  const sigmas = [quiet, loud].map(({ lambdaChoice }) => lambdaChoice?.sigma ?? 0);
  assert.ok(Math.abs(sigmas[1] / sigmas[0] - 10) < 0.5, `${sigmas}`);
  // The noise of pixels is that of the heights, whose levels are a fiftieth of the unit.
  const rough = noisy(faces, 1);
  const levels = image(80, 60, (x, y) => Math.round(50 * rough(x, y)));
  const { lambdaChoice } = direct.fit({ ...levels, heightScale: 1 / 50 }, { lambda: 'auto' }).report;
  assert.ok(Math.abs((lambdaChoice?.sigma ?? 0) / sigmas[1] - 1) < 0.1, `${lambdaChoice?.sigma} ${sigmas}`);
  assert.ok(quiet.lambda > 3 * loud.lambda && loud.lambda > 1);
  assert.equal(quiet.lambdaChoice?.step, undefined);
  assert.ok((quiet.gap ?? 1) <= 0.01);
  const plain = direct.fit(lattice(30, 30, plane), { lambda: 'auto' }).report;
  assert.deepEqual([plain.lambda, plain.lambdaChoice?.reason], [1e7, 'noNoise']);
  assert.equal(direct.fit(lattice(30, 30, faces), { energy: 'nuclear', lambda: 1e6 }).report.lambdaChoice, undefined);
});

test('of a scan about which nothing is said, lambda follows the noise, and bends stay smooth', () => {
  const scan = lattice(60, 60, noisy((/** @type {number} */ x) => 9 * Math.sin(x / 20), 0.3));
  const silent = direct.fit(scan);
  const said = direct.fit(scan, { lambda: 'auto', energy: 'huber' });
  assert.deepEqual(silent.heights, said.heights);
  assert.deepEqual([silent.report.energy, silent.report.lambdaChoice], [said.report.energy, said.report.lambdaChoice]);
  const solver = new direct.Solver(scan, { lambda: 'big' });
  solver.restart({ gap: 0.02 });
  while (solver.advance(100));
  assert.equal(solver.surface().report.energy, 'huber');
  solver.dispose();

  const held = scan.heights.map((z, i) => (i % 37 === 0 ? z : NaN));
  const design = direct.fit({ rows: scan.rows, cols: scan.cols, spacing: scan.spacing, constraints: held }, { gap: 0.1 });
  assert.deepEqual([design.report.energy, design.report.lambda, design.report.lambdaChoice?.reason], ['nuclear', 1e6, 'unknown']);
});
