/** The solves of a worker, looked at from inside: here the iterations can be counted. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { Solver, init } from '../../pkg/direct.js';
import { Job } from '../../pkg/job.js';
import { service } from '../../pkg/service.js';
import { endless } from './support/shapes.mjs';

await init();

/** A solver that counts: iterations, and the longest time it kept the thread. */
class Counted extends Solver {
  iterations = 0;
  longest = 0;
  /**
   * @override
   * @param {number} milliseconds
   */
  advance(milliseconds) {
    const start = performance.now();
    const more = super.advance(milliseconds);
    this.longest = Math.max(this.longest, performance.now() - start);
    this.iterations = this.progress().cgIterations;
    return more;
  }
}

function counted() {
  const { input, options } = endless();
  return new Counted(input, options);
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
  await sleep(200);
  assert.equal(solver.iterations, iterations);
});

test('a finished job gives its best surface and is done', async () => {
  const solver = counted();
  const job = new Job(() => solver, Infinity);
  await sleep(200);
  const news = job.next();
  job.finish();
  const { surface } = await news;
  assert.equal(surface?.report.stopReason, 'cancelled');
  const report = /** @type {import('../../pkg/types.js').Surface} */ (surface).report;
  assert.equal(report.cgIterations, solver.iterations);
  assert.equal(solver.disposed, true);
});

test('the event loop gets its turn between batches, and two jobs share the thread', async () => {
  const [a, b] = [counted(), counted()];
  const jobs = [new Job(() => a, 60), new Job(() => b, 60)];
  let turns = 0;
  const timer = setInterval(() => (turns += 1), 1);
  await sleep(600);
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
  await sleep(50);
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
  await sleep(50);
  assert.deepEqual([solver.disposed, released.length, released[0] === solver], [false, 1, true]);
  solver.dispose();
});

test('stopping what is not there is harmless, waiting for it an error', async () => {
  service.stop(1, false);
  service.stop(1, true);
  await assert.rejects(service.next(1), { code: 'DISPOSED' });
});
