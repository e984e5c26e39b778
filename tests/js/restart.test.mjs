/** Solving again from where a solver stands. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { cylinder, deviation, image, lattice, noisy, plane } from './support/shapes.mjs';

await direct.init();
const rough = image(80, 70, noisy(cylinder(80), 0.4));

/** @param {direct.Solver} solver */
function solved(solver) {
  while (solver.advance(20));
  return solver.surface();
}

test('what is left out has its default again', () => {
  const solver = new direct.Solver(rough, { lambda: 'small', energy: 'frobenius', gap: 0.1 });
  solved(solver);
  solver.restart();
  const { lambdaChoice, energy, gap } = solved(solver).report;
  assert.equal(energy, 'huber');
  assert.ok(lambdaChoice !== undefined);
  assert.ok((gap ?? NaN) <= 0.01);
  solver.dispose();
});

test('another spacing, or other occlusions, make another input of the same image', () => {
  const step = image(40, 24, (x, y) => plane(x, y) + (x > 20 ? 9 : 0));
  const solver = new direct.Solver(step);
  assert.equal(solved(solver).report.occluded, 0);
  solver.restart({ occlusionThreshold: 150 });
  const torn = solved(solver);
  // Those on the border would not have had a Hessian anyway.
  const { count } = direct.occlusions(step, { threshold: 150 });
  assert.ok(torn.report.occluded <= count && torn.report.occluded > count - 8);
  assert.ok(torn.report.objective < 1e-6);
  solver.restart({ spacing: 2 });
  const coarse = solved(solver);
  assert.ok(coarse.spacing === 2 && coarse.cols <= 21 && coarse.report.occluded === 0);
  assert.equal(coarse.image?.data.length, 960);
  solver.dispose();
});

test('another input: of the same shape, of another one, of another kind', () => {
  const solver = new direct.Solver(rough);
  solved(solver);
  solver.restartWith({ ...rough, data: rough.data.map((z) => z + 3) });
  const raised = solved(solver);
  const fresh = direct.fit({ ...rough, data: rough.data.map((z) => z + 3) });
  assert.ok(deviation(raised.image?.data ?? [], fresh.image?.data ?? []) < 0.3);
  solver.restartWith(image(20, 30, plane));
  const { image: out } = solved(solver);
  assert.ok(out?.width === 20 && deviation(out.data, image(20, 30, plane).data) < 1e-9);
  const hex = lattice(20, 22, plane);
  solver.restartWith(hex, { lambda: 'big' });
  const field = solved(solver);
  assert.equal(field.image, undefined);
  assert.ok(deviation(field.heights, hex.heights) < 1e-9);
  solver.dispose();
});

test('an error leaves the solver as it was', () => {
  const solver = new direct.Solver(rough);
  const before = solved(solver);
  assert.throws(() => solver.restart({ lambda: -1 }), { code: 'OPTION', message: /lambda/ });
  assert.throws(() => solver.restart(/** @type {any} */ (null)), { code: 'OPTION' });
  assert.throws(() => solver.restart({ occlusionThreshold: -1 }), { code: 'OPTION', message: /occlusionThreshold/ });
  assert.throws(() => solver.restartWith(/** @type {any} */ ({})), { code: 'INPUT' });
  assert.throws(() => solver.restartWith({ ...rough, width: 3 }), { code: 'SHAPE' });
  assert.throws(() => solver.restartWith(image(2, 2, plane)), { code: 'NO_INTERIOR' });
  const { heights, report } = solver.surface();
  assert.deepEqual(heights, before.heights);
  assert.equal(report.stopReason, 'gap');
  solver.restart({ lambda: 2e6 });
  assert.equal(solved(solver).report.lambda, 2e6);
  solver.dispose();
  assert.throws(() => solver.restart(), { code: 'DISPOSED' });
  assert.throws(() => solver.restartWith(rough), { code: 'DISPOSED' });
});

