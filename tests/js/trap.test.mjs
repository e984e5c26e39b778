/** What happens when the wasm crashes. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { DevelopableWorker } from '../../pkg/index.js';
import { wasmFile } from './support/paths.mjs';
import { cylinder, image, noisy, plane } from './support/shapes.mjs';
import { limited, trapping } from './support/wasm-surgery.mjs';

const ramp = image(12, 10, plane);
const sound = await readFile(wasmFile);
const broken = trapping(sound, 'solver_surface');

test('the direct API is unusable after a trap, and says so', async () => {
  await direct.init(broken);
  const solver = new direct.Solver(ramp);
  const other = new direct.Solver(ramp);
  const trap = { name: 'DevelopableError', code: 'TRAP', message: /unreachable/ };
  assert.throws(() => solver.surface(), trap);
  assert.throws(() => other.progress(), trap);
  assert.throws(() => direct.fit(ramp), trap);
  solver.dispose();
  other.dispose();
  assert.throws(() => solver.progress(), { code: 'DISPOSED' });
});

test('a worker is replaced after a trap', async () => {
  const worker = new DevelopableWorker({ wasm: /** @type {any} */ (broken) });
  await worker.init();
  assert.equal(worker.connected, true);
  const calls = await Promise.allSettled([worker.fit(ramp), worker.fit(ramp), worker.fit(ramp)]);
  for (const call of calls) {
    assert.equal(call.status, 'rejected');
    assert.equal(call.reason.code, 'TRAP');
  }
  assert.equal(worker.connected, false);
  // The next call finds a fresh worker, which gets as far as the first one did.
  await worker.init();
  assert.equal(worker.connected, true);
  await assert.rejects(worker.fit(ramp), { code: 'TRAP' });
  worker.dispose();
});

test('where memory is short there is an error that says so, and the next call works', async () => {
  const input = image(120, 120, noisy(cylinder(120), 1));
  const outcomes = new Set();
  // From too little for the input to enough for all.
  for (let kib = 256; kib <= 16384; kib = Math.ceil(1.7 * kib)) {
    const worker = new DevelopableWorker({ wasm: limited(sound, kib) });
    const outcome = await worker.fit(input).then(() => 'done', (error) => {
      assert.match(error.message, /memory/);
      return error.code;
    });
    outcomes.add(outcome);
    if (kib > 500) assert.equal((await worker.fit(ramp)).report.stopReason, 'rounding');
    worker.dispose();
  }
  assert.deepEqual([...outcomes].sort(), ['OUT_OF_MEMORY', 'done']);
});
