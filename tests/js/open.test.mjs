/** Solvers that stay in the worker. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { Solver, init } from '../../pkg/direct.js';
import * as developable from '../../pkg/index.js';
import { WarmSolver } from '../../pkg/warm-solver.js';
import { wasmFile } from './support/paths.mjs';
import { cylinder, deviation, endless, image, noisy, plane } from './support/shapes.mjs';
import { Listener } from './support/waiting.mjs';
import { trapping } from './support/wasm-surgery.mjs';

const { DevelopableWorker } = developable;
const ramp = image(12, 10, plane);
const rough = image(80, 70, noisy(cylinder(80), 0.4));
const forever = { lambda: /** @type {const} */ ('small'), gap: 1e-12, maxIterations: 1e9 };

after(() => developable.dispose());

/** How a promise ends. @param {Promise<unknown>} promise */
const outcome = (promise) => promise.then(() => 'done', (error) => (error instanceof developable.DevelopableError ? error.code : error.name));

test('the first solve is cold, later ones are warm, and all are right', async () => {
  const solver = await developable.open(rough);
  const first = await solver.fit({ lambda: 1e6 });
  assert.equal(first.report.stopReason, 'gap');
  const fresh = await developable.fit(rough, { lambda: 1.2e6 });
  const second = await solver.fit({ lambda: 1.2e6 });
  assert.ok(second.report.iterations < fresh.report.iterations, `${second.report.iterations} against ${fresh.report.iterations}`);
  assert.ok(Math.abs(second.report.objective - fresh.report.objective) <= 0.011 * fresh.report.objective);
  assert.ok(first.image && first.heights.length === second.heights.length, 'the first one is still there');
  assert.equal(solver.disposed, false);
  solver.dispose();
});

test('the newest wish wins', async () => {
  const solver = await developable.open(rough);
  const told = new Listener();
  const ended = outcome(solver.fit({ ...forever, onProgress: told.hear }));
  await told.more();
  // Of many at once only the last one is worked on.
  const calls = Array.from({ length: 40 }, (_, i) => solver.fit({ lambda: 1e6 * (1 + i / 40) }));
  const ends = Promise.all(calls.map(outcome));
  const last = await calls[39];
  assert.equal(last.report.lambda, 1e6 * (1 + 39 / 40));
  assert.equal(await ended, 'REPLACED');
  assert.deepEqual(await ends, [...new Array(39).fill('REPLACED'), 'done']);
  const { count } = told;
  const next = new Listener();
  const later = outcome(solver.fit({ ...forever, onProgress: next.hear }));
  await next.more(3);
  assert.equal(told.count, count, 'nothing more is told of what was replaced');
  solver.dispose();
  assert.equal(await later, 'DISPOSED');
});

test('a first solve begins while the caller is busy', async () => {
  const large = image(150, 150, (x, y) => Math.abs(x - y) + 3 * Math.sin(x * y));
  const solved = async (/** @type {number} */ busyMs) => {
    const opened = developable.open(large);
    const surface = opened.then((solver) => solver.fit({ lambda: 1e6 }));
    // What is sent goes out in promises, without the event loop.
    for (let i = 0; i < 50; i++) await undefined;
    const start = performance.now();
    while (performance.now() - start < busyMs);
    const free = performance.now();
    await surface;
    (await opened).dispose();
    return performance.now() - free;
  };
  await solved(0);
  const alone = await solved(0);
  const rest = await solved(3 * alone);
  assert.ok(rest < alone / 2, `${rest} of ${alone} ms`);
});

test('what is overtaken before its turn is never set up', async () => {
  await init();
  const kept = new WarmSolver(/** @type {any} */ ({ ...rough, kind: 'image' }), init);
  let made = 0;
  const restart = Solver.prototype.restart;
  Solver.prototype.restart = function (options) {
    made += 1;
    return restart.call(this, options);
  };
  try {
    const first = await kept.start({}, Infinity).next();
    assert.ok(first.surface);
    const jobs = Array.from({ length: 10 }, () => kept.start({}, Infinity));
    const news = await Promise.allSettled(jobs.map((job) => job.next()));
    assert.deepEqual(news.map(({ status }) => status), [...new Array(9).fill('rejected'), 'fulfilled']);
    assert.equal(made, 1);
  } finally {
    Solver.prototype.restart = restart;
    kept.dispose();
  }
});

test('an abort rejects, or keeps the best so far, and the solver stays', async () => {
  const solver = await developable.open(rough);
  const controller = new AbortController();
  const told = new Listener();
  const ended = outcome(solver.fit({ ...forever, signal: controller.signal, onProgress: told.hear }));
  await told.more();
  controller.abort();
  // The rejection does not wait for the worker.
  const answered = developable.example('cylinder', { size: 8 }).then(() => 'answered');
  assert.equal(await Promise.race([ended, answered]), 'AbortError');
  await answered;
  const kept = await solver.fit({ ...forever, signal: AbortSignal.timeout(200), onAbort: 'keep' });
  assert.equal(kept.report.stopReason, 'cancelled');
  assert.equal(await outcome(solver.fit({ signal: AbortSignal.abort() })), 'AbortError');
  assert.equal((await solver.fit()).report.stopReason, 'gap');
  // A call that is over before it begins does not end the one under way.
  const going = solver.fit({ ...forever, signal: AbortSignal.timeout(300), onAbort: 'keep' });
  assert.equal(await outcome(solver.fit({ signal: AbortSignal.abort() })), 'AbortError');
  assert.equal((await going).report.stopReason, 'cancelled');
  solver.dispose();
});

test('another input takes the place of the one before', async () => {
  const solver = await developable.open(rough);
  await solver.fit();
  const raised = { ...rough, data: rough.data.map((z) => z + 3) };
  const length = raised.data.length;
  await solver.replace(raised, { transfer: true });
  assert.equal(raised.data.length, 0);
  const surface = await solver.fit();
  const mean = (/** @type {Float64Array} */ data) => data.reduce((sum, z) => sum + z, 0) / length;
  assert.ok(Math.abs(mean(surface.image?.data ?? new Float64Array()) - mean(rough.data) - 3) < 0.05);
  await solver.replace(ramp);
  const { image: out } = await solver.fit();
  assert.ok(out?.width === 12 && deviation(out.data, ramp.data) < 1e-9);
  solver.dispose();
});

test('wrong inputs and options reject, and can be put right', async () => {
  const early = await outcome(developable.open(/** @type {any} */ ({})));
  assert.equal(early, 'INPUT');
  const solver = await developable.open(rough);
  await assert.rejects(solver.fit(/** @type {any} */ (null)), { code: 'OPTION', message: /object/ });
  await assert.rejects(solver.fit({ lambda: -1 }), { code: 'OPTION', message: /lambda/ });
  await assert.rejects(solver.fit(/** @type {any} */ ({ transfer: true })), { code: 'OPTION', message: /transfer/ });
  assert.equal((await solver.fit()).report.stopReason, 'gap');
  await solver.replace({ ...rough, width: 7 });
  await assert.rejects(solver.fit(), { code: 'SHAPE' });
  await solver.replace(rough);
  assert.equal((await solver.fit({ lambda: 2e6 })).report.lambda, 2e6);
  solver.dispose();
});

test('after disposal there is an error, and the memory can be used again', async () => {
  const solver = await developable.open(rough);
  const told = new Listener();
  const pending = outcome(solver.fit({ ...forever, onProgress: told.hear }));
  await told.more();
  solver.dispose();
  solver.dispose();
  solver[Symbol.dispose]();
  assert.equal(solver.disposed, true);
  assert.equal(await pending, 'DISPOSED');
  await assert.rejects(solver.fit(), { code: 'DISPOSED' });
  await assert.rejects(solver.replace(ramp), { code: 'DISPOSED' });
  assert.ok((await developable.fit(ramp)).image, 'the worker is none the worse for it');
});

test('with its worker, a solver ends for good', async () => {
  const worker = new DevelopableWorker();
  const solver = await worker.open(rough);
  const pending = outcome(solver.fit(forever));
  worker.dispose();
  assert.equal(await pending, 'DISPOSED');
  await assert.rejects(solver.fit(), { code: 'DISPOSED' });
  solver.dispose();

  const broken = new DevelopableWorker({ wasm: trapping(await readFile(wasmFile), 'solver_surface') });
  const lost = await broken.open(ramp);
  await assert.rejects(lost.fit(), { code: 'TRAP' });
  await assert.rejects(lost.fit(), { code: 'WORKER', message: /open its input again/ });
  await assert.rejects(lost.replace(ramp), { code: 'WORKER' });
  const other = await broken.open(ramp); // in a new worker
  await assert.rejects(other.fit(), { code: 'TRAP' });
  broken.dispose();
});

test('solvers of one worker take turns, and occlusions can be looked at in between', async () => {
  const { input } = endless(100);
  const [a, b] = await Promise.all([developable.open(input), developable.open(rough)]);
  const controller = new AbortController();
  const long = a.fit({ ...forever, signal: controller.signal, onAbort: 'keep' });
  const step = image(30, 20, (x, y) => plane(x, y) + (x > 15 ? 9 : 0));
  const found = await developable.occlusions(step, { threshold: 150 });
  assert.equal((await b.fit()).report.stopReason, 'gap');
  controller.abort();
  assert.ok(found.count > 15 && found.image?.length === 600 && found.vertices instanceof Uint8Array);
  assert.equal((await long).report.stopReason, 'cancelled');
  await assert.rejects(developable.occlusions(step, { threshold: -1 }), { code: 'OPTION', message: /threshold/ });
  a.dispose();
  b.dispose();
});
