/** The promise API in Node, where the solver runs in a worker thread. */
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { subscribe, unsubscribe } from 'node:diagnostics_channel';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { yieldToEventLoop } from '../../pkg/event-loop.js';
import * as developable from '../../pkg/index.js';
import { filesWasmFile, pkg, wasmFile } from './support/paths.mjs';
import { deviation, endless, image, lattice, noisy, plane } from './support/shapes.mjs';
import { Listener, rest } from './support/waiting.mjs';

const { DevelopableWorker } = developable;
const ramp = image(12, 10, plane);

after(() => developable.dispose());

test('a plane comes back, image or lattice, in any kind of array', async () => {
  const surface = await developable.fit(ramp);
  assert.ok(surface.image && deviation(surface.image.data, ramp.data) < 1e-9);
  const list = await developable.fit({ ...ramp, data: [...ramp.data] });
  assert.deepEqual(list.heights, surface.heights);
  const field = lattice(9, 11, plane);
  assert.ok(deviation((await developable.fit(field)).heights, field.heights) < 1e-9);
});

test('errors arrive with their code, as errors of the package', async () => {
  /** @param {string} code @param {RegExp} message */
  const error = (code, message) => (/** @type {unknown} */ thrown) => {
    assert.ok(thrown instanceof developable.DevelopableError && thrown instanceof Error);
    assert.equal(thrown.code, code);
    assert.match(thrown.message, message);
    assert.match(String(thrown.stack), /[/]pkg[/]/);
    return true;
  };
  await assert.rejects(developable.fit({ ...ramp, width: 11 }), error('SHAPE', /120/));
  await assert.rejects(developable.fit(/** @type {any} */ ({})), error('INPUT', /lattice/));
  await assert.rejects(developable.fit(ramp, /** @type {any} */ ({ gapp: 1 })), error('OPTION', /gapp/));
  await assert.rejects(developable.fit(ramp, /** @type {any} */ ({ onAbort: 'stop' })), error('OPTION', /onAbort/));
  const wrong = /** @type {any[]} */ ([null, 7, 'fast']);
  for (const options of wrong) await assert.rejects(developable.fit(ramp, options), error('OPTION', /object/));
  for (const options of wrong) await assert.rejects(developable.open(ramp, options), error('OPTION', /object/));
  for (const options of [null, 7]) await assert.rejects(developable.init(/** @type {any} */ (options)), error('OPTION', /object/));
  assert.throws(() => new DevelopableWorker(/** @type {any} */ (null)), error('OPTION', /object/));
  for (const signal of [null, 7, {}]) {
    await assert.rejects(developable.fit(ramp, { signal: /** @type {any} */ (signal) }), error('OPTION', /signal/));
  }
  await assert.rejects(developable.fit(ramp, { onProgress: /** @type {any} */ ('log') }), error('OPTION', /onProgress/));
  await assert.rejects(developable.fit(ramp, /** @type {any} */ ({ f: () => {} })), error('OPTION', /unknown option `f`/));
  await assert.rejects(developable.read(new Uint8Array(9)), error('UNSUPPORTED', /./));
  await assert.rejects(developable.example(/** @type {any} */ ('torus')), error('OPTION', /torus/));
});

test('any call can be aborted: its work ends, and calls beside it go on', async () => {
  const worker = new DevelopableWorker();
  after(() => worker.dispose());
  const { input } = await worker.example('roof', { size: 400 });
  const beside = worker.unroll(image(40, 40, plane));
  const controller = new AbortController();
  const reason = new Error('enough');
  // It would take minutes.
  const laid = worker.unroll(input, { maxIterations: 1e6, tolerance: 1e-300, signal: controller.signal });
  setTimeout(() => controller.abort(reason), 300);
  await assert.rejects(laid, (error) => error === reason);
  await beside;
  await rest(); // no thread goes on with it
  await assert.rejects(worker.unroll(input, { signal: AbortSignal.abort(reason) }), (error) => error === reason);
  const unharmed = await worker.unroll(image(40, 40, plane), { signal: new AbortController().signal });
  assert.deepEqual(unharmed.places, (await beside).places);
  await assert.rejects(worker.unroll(input, { signal: /** @type {any} */ ('now') }), { code: 'OPTION', message: /signal/ });
});

test('calls that can be aborted wait for one another, and use no further threads', async () => {
  const { input } = await developable.example('roof', { size: 400 });
  const worker = new DevelopableWorker({ threads: 2 });
  let started = 0;
  const count = () => void (started += 1);
  subscribe('worker_threads', count);
  after(() => {
    worker.dispose();
    unsubscribe('worker_threads', count);
  });
  const short = () => worker.unroll(image(40, 40, plane), { signal: new AbortController().signal });
  const long = ({ signal } = new AbortController()) => worker.unroll(input, { maxIterations: 1e6, tolerance: 1e-300, signal });
  await Promise.all(Array.from({ length: 6 }, short));
  assert.equal(started, 2);

  // An abort leaves the idle worker to the next call.
  const stopping = new AbortController();
  const stopped = assert.rejects(long(stopping), { name: 'AbortError' });
  await short();
  const before = started;
  stopping.abort();
  await stopped;
  await short();
  assert.equal(started, before);

  // An abort ends the wait, and so does the end of the worker.
  const waiting = new AbortController();
  const running = [long(), long()];
  const queued = [long(waiting), long()];
  const aborted = assert.rejects(queued[0], { name: 'AbortError' });
  const disposed = [...running, queued[1]].map((call) => assert.rejects(call, { code: 'DISPOSED' }));
  await yieldToEventLoop();
  waiting.abort();
  await aborted;
  worker.dispose();
  await Promise.all(disposed);
});

test('an abort rejects at once and stops the work', async () => {
  const { input, options } = endless();
  const controller = new AbortController();
  const told = new Listener();
  const solve = developable.fit(input, { ...options, signal: controller.signal, onProgress: told.hear });
  solve.catch(() => {});
  await told.more(2);
  const reason = new Error('enough');
  controller.abort(reason);
  // Neither waits for the solve, which has no end of its own; the rejection does not wait for the worker either.
  const answered = developable.example('cylinder', { size: 8 }).then(() => 'answered');
  await assert.rejects(Promise.race([solve, answered]), (error) => error === reason);
  await answered;
  const last = told.count;
  await rest();
  assert.equal(told.count, last);
});

test('an abort before the start, or while the worker starts, works as well', async () => {
  await assert.rejects(developable.fit(ramp, { signal: AbortSignal.abort() }), { name: 'AbortError' });
  const worker = new DevelopableWorker();
  const { input, options } = endless();
  const controller = new AbortController();
  const solve = worker.fit(input, { ...options, signal: controller.signal });
  controller.abort();
  await assert.rejects(solve, { name: 'AbortError' });
  await worker.init();
  await rest();
  worker.dispose();
});

test('an abort can keep the best surface so far', async () => {
  const { input, options } = endless();
  const surface = await developable.fit(input, { ...options, signal: AbortSignal.timeout(400), onAbort: 'keep' });
  const { stopReason, objective, dualBound, iterations } = surface.report;
  assert.equal(stopReason, 'cancelled');
  assert.ok(iterations > 0 && dualBound <= objective);
  const none = await developable.fit(input, { ...options, signal: AbortSignal.abort(), onAbort: 'keep' });
  assert.equal(none.report.stopReason, 'cancelled');
});

test('a signal outlives the solve without harm', async () => {
  const controller = new AbortController();
  const surface = await developable.fit(ramp, { signal: controller.signal });
  controller.abort();
  assert.equal(surface.report.stopReason, 'rounding');
  assert.ok((await developable.fit(ramp)).image);
});

test('progress comes several times a second, and at the end', async () => {
  /** @type {developable.Progress[]} */
  const told = [];
  const { input, options } = endless();
  const surface = await developable.fit(input, {
    ...options,
    maxIterations: 400,
    onProgress: (progress) => told.push(progress),
  });
  const last = told.at(-1);
  assert.equal(last?.iteration, surface.report.iterations);
  assert.equal(last?.gap, surface.report.gap);
  for (let i = 1; i < told.length; i += 1) {
    assert.ok(told[i].cgIterations >= told[i - 1].cgIterations);
  }
  // All but the last are spaced, by the solver's clock: a busy machine may deliver one late, and the
  // next at once. Timers are not exact.
  const spaces = told.slice(1, -1).map((progress, i) => 1000 * (progress.elapsed - told[i].elapsed));
  assert.ok(spaces.every((space) => space > 40), String(spaces));
});

test('an error in onProgress ends the solve and comes out', async () => {
  const { input, options } = endless();
  const mine = new Error('mine');
  const onProgress = () => {
    throw mine;
  };
  await assert.rejects(developable.fit(input, { ...options, onProgress }), (error) => error === mine);
  await developable.example('cylinder', { size: 8 });
  await rest();
});

test('a rejected promise of onProgress ends the solve and comes out', async () => {
  const { input, options: without } = endless();
  // Where nobody hears of the rejection the solve ends all the same.
  const options = { ...without, maxIterations: 400 };
  const mine = new Error('mine');
  /** @type {unknown[]} */
  const unhandled = [];
  /** @param {unknown} reason */
  const listen = (reason) => unhandled.push(reason);
  process.on('unhandledRejection', listen);
  const isMine = (/** @type {unknown} */ error) => error === mine;
  const late = async () => {
    await yieldToEventLoop();
    throw mine;
  };
  const solver = await developable.open(input);
  for (const onProgress of [async () => Promise.reject(mine), late]) {
    await assert.rejects(developable.fit(input, { ...options, onProgress }), isMine);
    // The last news of all comes with the surface.
    await assert.rejects(developable.fit(ramp, { onProgress }), isMine);
    await assert.rejects(solver.fit({ ...options, onProgress }), isMine);
  }
  solver.dispose();
  const onPlan = async () => Promise.reject(mine);
  await assert.rejects(developable.explorePattern(ramp, { lambdas: [1e6], smallest: [0.1], onPlan }), isMine);
  // The process hears of rejections that nobody has handled before it goes on to its timers.
  await new Promise((resolve) => setImmediate(resolve));
  process.off('unhandledRejection', listen);
  assert.deepEqual(unhandled, []);
});

test('the promises of onProgress are awaited one after the other', async () => {
  const { input, options } = endless();
  let [running, most, calls] = [0, 0, 0];
  await developable.fit(input, {
    ...options,
    maxIterations: 400,
    onProgress: async () => {
      calls += 1;
      running += 1;
      most = Math.max(most, running);
      await yieldToEventLoop();
      running -= 1;
    },
  });
  assert.deepEqual([running, most], [0, 1], 'the last one has ended as well');
  assert.ok(calls > 0);
});

test('solves on one worker take turns', async () => {
  const { input, options } = endless();
  const controller = new AbortController();
  const long = developable.fit(input, { ...options, signal: controller.signal, onAbort: 'keep' });
  // The other one has no end of its own, and came first.
  const [a, b] = await Promise.all([developable.fit(ramp), developable.fit(image(40, 40, noisy(plane, 0.1)))]);
  assert.equal(a.report.stopReason, 'rounding');
  assert.equal(b.report.stopReason, 'gap');
  controller.abort();
  assert.equal((await long).report.stopReason, 'cancelled');
});

test('arrays are copied, or handed over when asked for', async () => {
  const input = { ...ramp, data: ramp.data.slice(), mask: new Uint8Array(120).fill(1) };
  await developable.fit(input);
  assert.equal(input.data.length, 120);
  const part = new Float64Array(130).subarray(10);
  part.set(ramp.data);
  await developable.fit({ ...ramp, data: part }, { transfer: true });
  assert.equal(part.length, 120, 'a part of a buffer is copied');
  await developable.fit(input, { transfer: true });
  assert.equal(input.data.length, 0);
  assert.equal(input.mask.length, 0);
  const shared = new Float64Array(new SharedArrayBuffer(960));
  shared.set(ramp.data);
  const { image: out } = await developable.fit({ ...ramp, data: shared }, { transfer: true });
  assert.ok(out && deviation(out.data, ramp.data) < 1e-9);
});

test('arrays stay the caller\'s where options or shapes are refused', async () => {
  /** @type {[object, RegExp][]} */
  const refused = [
    [{ nope: 1 }, /unknown option/],
    [{ lambda: -1 }, /`lambda` is -1/],
    [{ gap: 2 }, /`gap` is 2/],
    [{ spacing: -1 }, /`spacing` is -1/],
    [{ bridge: 99 }, /`bridge` is 99/],
    [{ occlusionThreshold: 0 }, /`occlusionThreshold` is 0/],
    [{ energy: 'nuclear', flatness: 0.3 }, /`flatness`/],
    [{ schedule: 'paper', gap: 0.1 }, /`gap`/],
  ];
  const input = { ...ramp, data: ramp.data.slice(), mask: new Uint8Array(120).fill(1) };
  for (const [options, message] of refused) {
    await assert.rejects(developable.fit(input, { transfer: true, ...options }), { code: 'OPTION', message });
    assert.deepEqual([input.data.length, input.mask.length], [120, 120], JSON.stringify(options));
  }
  const short = { ...input, mask: new Uint8Array(119) };
  const shape = { code: 'SHAPE', message: /^mask: there are 119 values, and its shape of \d+ × \d+ \(rows × columns\) needs 120/ };
  await assert.rejects(developable.fit(short, { transfer: true }), shape);
  await assert.rejects(developable.open(short, { transfer: true }), shape);
  assert.deepEqual([short.data.length, short.mask.length], [120, 119]);
  const photo = { width: 8, height: 8, data: new Uint8Array(256).fill(255) };
  const edges = { top: [[1, 1], [6, 1]], bottom: [[1, 6], [6, 6]] };
  for (const call of [
    ...[{ dots: 0 }, { grid: 0 }, { tolerance: 0 }, { crop: [[0, 0], [1, 1]] }, { extent: [0, 0, 0, 1] }].map((options) =>
      () => developable.dewarp(ramp, photo, /** @type {any} */ ({ transfer: true, ...options }))),
    ...[{ dots: -1 }, { focalLength: 0 }, { fieldOfView: -1 }, { film35: Infinity }].map((options) =>
      () => developable.dewarpPage(photo, /** @type {any} */ (edges), { transfer: true, ...options })),
    ...[{ quality: 0 }, { quality: 101 }, { dotsPerMillimetre: 0 }].map((options) =>
      () => developable.writePhoto(photo, { transfer: true, format: 'jpeg', ...options })),
  ]) {
    await assert.rejects(call(), { code: 'OPTION' });
    assert.equal(photo.data.length, 256);
  }
  // Two calls cannot both have it.
  const [first, second] = await Promise.allSettled([1, 2].map(() => developable.fit(input, { transfer: true })));
  assert.equal(first.status, 'fulfilled');
  assert.equal(second.status, 'rejected');
  assert.match(second.status === 'rejected' ? second.reason.message : '', /no memory any more/);
});

test('files are read and written', async () => {
  const surface = await developable.fit(ramp);
  assert.ok(surface.image);
  const file = await developable.writeImage(ramp);
  for (const form of [file, file.buffer, new Blob([file]), Buffer.from(file)]) {
    const read = await developable.read(form);
    assert.deepEqual([read.format, read.width, read.height, read.dataType], ['npy', 12, 10, 'f64']);
    assert.equal(deviation(read.data, ramp.data), 0);
  }
  const png = await developable.read(await developable.writeImage({ ...ramp, pixelSize: 0.5 }, { format: 'png' }));
  assert.deepEqual([png.format, png.dataType, png.pixelSize], ['png', 'u16', 0.5]);
  assert.ok(deviation(png.data.map((v) => v * png.heightScale), ramp.data) < 1e-3);
  const obj = new TextDecoder().decode(await developable.writeObj(surface));
  const vertices = [...obj.matchAll(/^v (\S+) (\S+) (\S+)/gm)].map((match) => match.slice(1).map(Number));
  assert.ok(vertices.length > 50 && vertices.every(([x, y, z]) => Math.abs(z - plane(x, y)) < 1e-9));
  assert.equal((await developable.writeImage(surface)).length, 128 + 8 * surface.image.data.length);
  assert.equal((await developable.writeImage({ ...surface, image: undefined })).length, 128 + 8 * surface.heights.length);
});

test('every example can be solved', async () => {
  for (const name of /** @type {const} */ (['cylinder', 'cone', 'roof', 'oloid', 'page', 'house'])) {
    const { input, truth } = await developable.example(name, { size: 40, noise: 0.02, seed: 7 });
    assert.equal(input.data.length, input.width * input.height);
    assert.equal(truth.length, input.data.length);
    assert.equal((await developable.fit(input)).report.stopReason, 'gap');
  }
});

test('a worker of one\'s own is disposed of once, for good', async () => {
  const worker = new DevelopableWorker({ wasm: await readFile(wasmFile) });
  assert.deepEqual([worker.connected, worker.disposed], [false, false]);
  await worker.init();
  assert.equal(worker.connected, true);
  const { input, options } = endless();
  const told = new Listener();
  const pending = worker.fit(input, { ...options, onProgress: told.hear });
  const other = worker.example('cone', { size: 8 });
  pending.catch(() => {});
  other.catch(() => {});
  await told.more();
  worker.dispose();
  worker.dispose();
  worker[Symbol.dispose]();
  await assert.rejects(pending, { code: 'DISPOSED' });
  assert.deepEqual([worker.connected, worker.disposed], [false, true]);
  await assert.rejects(worker.fit(ramp), { code: 'DISPOSED' });
  await assert.rejects(worker.init(), { code: 'DISPOSED' });
});

test('the shared worker comes back after disposal', async () => {
  const { input, options } = endless();
  const pending = developable.fit(input, options);
  developable.dispose();
  await assert.rejects(pending, { code: 'DISPOSED' });
  assert.ok((await developable.fit(ramp)).image);
});

test('an init that fails can be repeated with another place', async () => {
  developable.dispose();
  await assert.rejects(developable.init({ wasm: 'nowhere.wasm' }), { code: 'INIT', message: /nowhere/ });
  await assert.rejects(developable.init(Promise.reject(new Error('no luck'))), { code: 'INIT', message: /no luck/ });
  await developable.init(pathToFileURL(wasmFile));
  assert.ok((await developable.fit(ramp)).image);
  await developable.init('nowhere.wasm'); // it runs already
});

test('wasm and worker can come from elsewhere', async () => {
  const bytes = await readFile(wasmFile);
  const url = pathToFileURL(wasmFile);
  const headers = { 'content-type': 'application/wasm' };
  const sources = [
    wasmFile, url, url.href, bytes, new Uint8Array(bytes).buffer, new WebAssembly.Module(bytes),
    Promise.resolve(bytes), new Response(bytes), new Response(bytes, { headers }),
  ];
  for (const wasm of sources) {
    const worker = new DevelopableWorker({ wasm, workerUrl: pathToFileURL(`${pkg}worker.js`) });
    assert.ok((await worker.fit(ramp)).image);
    worker.dispose();
  }
});

test('the wasm of the files is loaded when a file is read or written, and not before', async () => {
  const lost = new DevelopableWorker({ filesWasm: pathToFileURL(`${pkg}nothing.wasm`) });
  assert.ok((await lost.fit(ramp)).image);
  await assert.rejects(lost.writeImage(ramp), { code: 'INIT', message: /nothing\.wasm/ });
  assert.ok((await lost.fit(ramp)).image); // the solver is none the worse for it
  lost.dispose();
  for (const filesWasm of [filesWasmFile, pathToFileURL(filesWasmFile), await readFile(filesWasmFile)]) {
    const worker = new DevelopableWorker({ filesWasm });
    assert.equal((await worker.read(await worker.writeImage(ramp))).width, ramp.width);
    worker.dispose();
  }
});

test('a worker that cannot start, or dies, rejects what waits for it', async () => {
  const lost = new DevelopableWorker({ workerUrl: pathToFileURL(`${pkg}nothing.js`) });
  await assert.rejects(lost.fit(ramp), { code: 'WORKER', message: /nothing\.js/ });
  const script = 'setTimeout(() => { throw new Error("died") }, 50)';
  const mortal = new DevelopableWorker({ workerUrl: new URL(`data:text/javascript,${encodeURIComponent(script)}`) });
  await assert.rejects(Promise.any([mortal.fit(ramp), mortal.init()]), (/** @type {AggregateError} */ error) => {
    assert.deepEqual(error.errors.map(({ code }) => code), ['WORKER', 'WORKER']);
    assert.match(error.errors[0].message, /died/);
    return true;
  });
  assert.equal(mortal.connected, false);
});

test('an idle worker lets the process end, a busy one does not', async () => {
  const script = `
    import { fit, example } from ${JSON.stringify(pathToFileURL(`${pkg}index.js`).href)};
    const { input } = await example('cylinder', { size: 60 });
    fit(input).then(({ report }) => console.log(report.stopReason));
  `;
  const args = ['--input-type=module', '--eval', script];
  const child = spawn(process.execPath, args, { stdio: ['ignore', 'pipe', 'inherit'] });
  let output = '';
  child.stdout.on('data', (chunk) => (output += chunk));
  const timer = setTimeout(() => child.kill(), 20_000);
  const code = await new Promise((resolve) => child.on('close', resolve));
  clearTimeout(timer);
  assert.deepEqual([code, output], [0, 'gap\n']);
});
