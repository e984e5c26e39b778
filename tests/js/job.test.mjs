/** The solves of a worker, looked at from inside: here the iterations can be counted. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Solver, init } from '../../pkg/direct.js';
import { Job } from '../../pkg/job.js';
import { service } from '../../pkg/service.js';
import { endless } from './support/shapes.mjs';
import { until } from './support/waiting.mjs';

await init();

/** A solver that counts: iterations, and batches of them. */
class Counted extends Solver {
  iterations = 0;
  batches = 0;
  /**
   * @override
   * @param {number} milliseconds
   */
  advance(milliseconds) {
    const more = super.advance(milliseconds);
    this.batches += 1;
    this.iterations = this.progress().cgIterations;
    return more;
  }
}

function counted() {
  const { input, options } = endless();
  return new Counted(input, options);
}

/**
 * Waits until solvers have had some batches each.
 * @param {number} count
 * @param {...Counted} solvers
 */
const batches = (count, ...solvers) =>
  until(`${count} batches`, () => solvers.every((solver) => solver.batches >= count));

/** Lets another job have some batches: jobs take turns, so that each one that goes on has had as many. */
async function othersTurns() {
  const solver = counted();
  const job = new Job(() => solver, Infinity);
  try {
    await batches(4, solver);
  } finally {
    job.drop();
  }
}

test('a dropped job does not iterate any more', async (t) => {
  const solver = counted();
  const job = new Job(() => solver, 60);
  t.after(() => job.drop());
  // Before the first iteration there is news as well.
  for (let begun = false; !begun;) {
    const { progress, surface } = await job.next();
    assert.equal(surface, undefined);
    begun = progress.cgIterations > 0;
  }
  const news = job.next();
  job.drop();
  await assert.rejects(news, { code: 'DISPOSED' });
  const { iterations } = solver;
  assert.equal(solver.disposed, true);
  await othersTurns();
  assert.equal(solver.iterations, iterations);
});

test('a finished job gives its best surface and is done', async () => {
  const solver = counted();
  const job = new Job(() => solver, Infinity);
  await batches(2, solver);
  const news = job.next();
  job.finish();
  const { surface } = await news;
  assert.equal(surface?.report.stopReason, 'cancelled');
  const report = /** @type {import('../../pkg/types.js').Surface} */ (surface).report;
  assert.equal(report.cgIterations, solver.iterations);
  assert.equal(solver.disposed, true);
});

test('the event loop gets its turn between batches, and two jobs share the thread', async (t) => {
  const [a, b] = [counted(), counted()];
  const jobs = [new Job(() => a, 60), new Job(() => b, 60)];
  t.after(() => jobs.forEach((job) => job.drop()));
  let turns = 0;
  const timer = setInterval(() => (turns += 1), 1);
  await batches(8, a, b);
  clearInterval(timer);
  for (const job of jobs) job.drop();
  assert.ok(turns >= 3, `${turns} turns`);
  assert.ok(a.iterations > 0 && b.iterations > 0);
  const ratio = a.iterations / b.iterations;
  assert.ok(ratio > 0.3 && ratio < 3, `${a.iterations} and ${b.iterations} iterations`);
});

test('a job that is dropped before its turn is never begun', async () => {
  let begun = 0;
  const job = new Job(() => {
    begun += 1;
    return counted();
  }, 60);
  const news = job.next();
  job.drop();
  await assert.rejects(news, { code: 'DISPOSED' });
  await othersTurns();
  assert.equal(begun, 0);
});

test('a job can leave its solver as it is', async () => {
  const solver = counted();
  /** @type {unknown[]} */
  const released = [];
  const job = new Job(() => solver, 60, (its) => void released.push(its));
  await job.next();
  job.drop();
  job.drop();
  await othersTurns();
  assert.deepEqual([solver.disposed, released.length, released[0] === solver], [false, 1, true]);
  solver.dispose();
});

test('stopping what is not there is harmless, waiting for it an error', async () => {
  service.stop(1, false);
  service.stop(1, true);
  await assert.rejects(service.next(1), { code: 'DISPOSED' });
});
