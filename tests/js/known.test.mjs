/** What may be known besides the heights: confidence, constraints, occlusions; and what is minimised. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { error } from './support/error.mjs';
import { cylinder, deviation, image, lattice, noisy, plane, rms } from './support/shapes.mjs';

await direct.init();

/** Two planes with a jump between them, on the lattice. */
const step = lattice(24, 30, (x, y) => plane(x, y) + (x > 14.2 ? 6 : 0));

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

  assert.throws(fit(ramp, { bridge: 17 }), error('OPTION', /bridge.*from 1 to 16/s));
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

