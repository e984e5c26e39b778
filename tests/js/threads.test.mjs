/** Fits on several threads: the same bits, and one thread where there cannot be more. */
import assert from 'node:assert/strict';
import { cp, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import * as direct from '../../pkg/direct.js';
import { DevelopableWorker } from '../../pkg/index.js';
import { runProcess, temporaryFolder } from './support/command.mjs';
import { pkg } from './support/paths.mjs';
import { cylinder, image, noisy } from './support/shapes.mjs';

const folder = await temporaryFolder();

// Threads are not limited by the cores of the machine that tests.
Object.defineProperty(globalThis, 'navigator', { value: { hardwareConcurrency: 64 }, configurable: true });

/** Large enough for three bands of rows. */
const large = image(190, 190, noisy(cylinder(190), 0.4));
const options = { lambda: 1e6 };

/** @param {number} threads */
async function fitOn(threads) {
  const worker = new DevelopableWorker({ threads });
  try {
    const { heights, report } = await worker.fit(large, options);
    return { heights, report };
  } finally {
    worker.dispose();
  }
}

test('any number of threads gives the same bits as the wasm for one thread', async () => {
  await direct.init();
  const one = direct.fit(large, options);
  for (const threads of [1, 2, 3]) {
    const { heights, report } = await fitOn(threads);
    assert.deepEqual(report.threads, threads);
    assert.equal(report.threadLimit, 'options');
    assert.deepEqual(heights, one.heights, `${threads} threads`);
    // Sums over the lattice are added in another order.
    for (const name of /** @type {const} */ (['objective', 'dualBound'])) {
      assert.ok(Math.abs(report[name] / one.report[name] - 1) < 1e-12, `${name} ${report[name]}`);
    }
  }
});

test('a solve is stopped, and the next one runs on all threads again', async () => {
  const worker = new DevelopableWorker({ threads: 2 });
  try {
    const stop = new AbortController();
    const stopped = worker.fit(large, { ...options, gap: 1e-9, signal: stop.signal, onProgress: () => stop.abort() });
    await assert.rejects(stopped, { name: 'AbortError' });
    const { report } = await worker.fit(large, options);
    assert.deepEqual([report.threads, report.stopReason], [2, 'gap']);
  } finally {
    worker.dispose();
  }
});

test('a small surface has one thread, and the report says why', async () => {
  const worker = new DevelopableWorker({ threads: 2 });
  try {
    const { report } = await worker.fit(image(40, 40, cylinder(40)), options);
    assert.deepEqual([report.threads, report.threadLimit], [1, 'vertices']);
  } finally {
    worker.dispose();
  }
});

test('numbers of threads that cannot be are refused', async () => {
  for (const threads of [0, -1, 1.5, 65, NaN, '2']) {
    assert.throws(() => new DevelopableWorker(/** @type {any} */ ({ threads })), { code: 'OPTION', message: /`threads`.*from 1 to 64/ });
  }
});

/** What makes a helper crash: no stack at all, and one that has overflowed into the guard below it. */
const FATAL_STACKS = {
  missing: '{ ...start, stack: 0 }',
  overflowed: '(new Uint8Array(start.memory.buffer).fill(0, start.stack - (1 << 20) - 8, start.stack - (1 << 20)), start)',
};

for (const [what, start] of Object.entries(FATAL_STACKS)) test(`a helper whose stack is ${what} ends the solve with an error`, async () => {
  const script = `
    import { Solver } from ${JSON.stringify(pathToFileURL(join(pkg, 'direct.js')).href)};
    import { startSharedSolver } from ${JSON.stringify(pathToFileURL(join(pkg, 'shared-solver.js')).href)};
    import { spawn } from ${JSON.stringify(pathToFileURL(join(pkg, 'thread.js')).href)};
    import { wrap } from ${JSON.stringify(pathToFileURL(join(pkg, 'wire.js')).href)};
    const [start] = await startSharedSolver(1);
    const helper = spawn();
    helper.hold(true);
    await wrap(helper.endpoint).becomeHelper(${start});
    const data = Float64Array.from({ length: 300 * 300 }, (_, i) => Math.abs(i % 300 - 75) + Math.sin(i));
    try {
      for (;;) {
        const solver = new Solver({ width: 300, height: 300, data }, { lambda: 1e6 });
        while (solver.advance(1000));
        solver.dispose();
      }
    } catch ({ code, message }) {
      console.log(code, message);
    }
    helper.terminate();
  `;
  const { stdout, stderr } = await runProcess(folder, ['--input-type=module', '-e', script], { program: [process.execPath] });
  assert.match(stdout, /^TRAP [^]*a helper of the team has crashed/, stderr);
});

/**
 * The numbers of threads, and why there were not more, of a fit in a process of its own, which has to end by itself.
 * @param {object} [where]
 * @param {string} [where.packageFolder]
 * @param {string} [where.first] what the process does first
 * @param {string} [where.init] the options of `init`
 */
async function fitElsewhere({ packageFolder = pkg, first = '', init = '{ threads: 2 }' } = {}) {
  const script = `
    ${first}
    const { fit, init } = await import(${JSON.stringify(pathToFileURL(join(packageFolder, 'index.js')).href)});
    await init(${init});
    const data = Float64Array.from({ length: 150 * 150 }, (_, i) => Math.abs(i % 150 - 75) + Math.sin(i));
    const { report } = await fit({ width: 150, height: 150, data }, { lambda: 1e6 });
    console.log(report.threads, report.threadLimit);
  `;
  const { status, stdout, stderr } = await runProcess(folder, ['--input-type=module', '-e', script], { program: [process.execPath] });
  assert.equal(status, 0, stderr);
  return stdout.trim();
}

test('a process with helpers ends by itself', async () => {
  assert.equal(await fitElsewhere(), '2 options');
});

test('without shared memory there is one thread', async () => {
  // As in a page that is not isolated. Node's own workers need the rest.
  assert.equal(await fitElsewhere({ first: 'globalThis.crossOriginIsolated = false;' }), '1 isolation');
  const withoutMemory = 'const { Memory } = WebAssembly; WebAssembly.Memory = function (type) { if (type.shared) throw new RangeError(); return new Memory(type); };';
  assert.equal(await fitElsewhere({ first: withoutMemory }), '1 isolation');
});

test('without the wasm for several threads there is one thread', async () => {
  const packageFolder = join(folder, 'without');
  await cp(pkg, packageFolder, { recursive: true, filter: (path) => !path.endsWith(join('threads', 'threads_bg.wasm')) });
  assert.equal(await fitElsewhere({ packageFolder }), '1 build');
});

test('a helper that does not start in time is left out', async () => {
  // The solver's thread is the first, and the others never answer.
  const script = join(folder, 'worker.mjs');
  await writeFile(script, `
    import { threadId } from 'node:worker_threads';
    if (threadId > 1) setInterval(() => {}, 1000);
    else await import(${JSON.stringify(pathToFileURL(join(pkg, 'worker.js')).href)});
  `);
  const init = `{ threads: 3, workerUrl: ${JSON.stringify(script)} }`;
  assert.equal(await fitElsewhere({ init }), '1 system');
});

test('the command takes a number of threads', async () => {
  const values = Float32Array.from({ length: 150 * 150 }, (_, i) => Math.abs(i % 150 - 75) + Math.sin(i));
  await direct.load('files');
  await writeFile(join(folder, 'in.npy'), direct.writeImage({ width: 150, height: 150, data: Float64Array.from(values) }));
  const args = ['fit', 'in.npy', '-o', 'out.npy', '--lambda', '1e6', '--report', 'report.json', '--threads'];
  const { status, stderr } = await runProcess(folder, [...args, '2']);
  assert.equal(status, 0, stderr);
  const report = JSON.parse(await readFile(join(folder, 'report.json'), 'utf8'));
  assert.deepEqual([report.threads, report.threadLimit], [2, 'options']);
  const refused = await runProcess(folder, [...args, '0']);
  assert.equal(refused.status, 2);
  assert.match(refused.stderr, /--threads .*from 1 to 64/);
});
