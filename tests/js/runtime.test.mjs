/** What callers see of the runtime: where errors come from, how many threads there are, what inputs may bring along. */
import assert from 'node:assert/strict';
import { cp, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { DevelopableWorker, dispose, fit, read, writeImage } from '../../pkg/index.js';
import { asDepthOptions } from '../../pkg/depth-input.js';
import { run, runProcess, silent, temporaryFolder } from './support/command.mjs';
import { pkg, root } from './support/paths.mjs';
import { cylinder, image } from './support/shapes.mjs';

await direct.init();
const bent = image(12, 12, cylinder(12));

test('an error of the worker tells who called', async () => {
  async function caller() {
    return fit({ width: 1, height: 1, data: [0] });
  }
  await assert.rejects(caller(), (/** @type {Error} */ { stack }) => /NO_INTERIOR|interior/.test(String(stack)) && /runtime\.test\.mjs/.test(String(stack)));
  await assert.rejects(read(new Uint8Array(9)), (/** @type {Error} */ { stack }) => /runtime\.test\.mjs/.test(String(stack)));
  dispose();
});

test('no more threads are started than run at the same time', async () => {
  const { navigator } = globalThis;
  Object.defineProperty(globalThis, 'navigator', { value: { hardwareConcurrency: 2 }, configurable: true });
  const worker = new DevelopableWorker({ threads: 64 });
  try {
    const { report } = await worker.fit(image(190, 190, cylinder(190)), { lambda: 1e6 });
    assert.deepEqual([report.threads, report.threadLimit], [2, 'cores']);
  } finally {
    worker.dispose();
    Object.defineProperty(globalThis, 'navigator', { value: navigator, configurable: true });
  }
});

test("an input may have properties of the caller's own, but none misspelled", () => {
  class Scan {
    constructor() {
      Object.assign(this, bent, { name: 'scan', operator: 'me', sensor: { id: 3 } });
    }
  }
  assert.deepEqual(direct.fit(/** @type {any} */ (new Scan())).heights, direct.fit(bent).heights);
  assert.throws(() => direct.fit(/** @type {any} */ ({ ...bent, nodata: -1 })), { code: 'INPUT', message: /`nodata`.*`noData`/ });
});

test('flags may be any numbers or booleans', () => {
  const on = Array.from(bent.data ?? [], (_, i) => i % 12 > 2);
  const same = (/** @type {any} */ mask) => direct.fit({ ...bent, mask }).heights;
  const expected = same(Uint8Array.from(on, Number));
  for (const mask of [on, Uint8ClampedArray.from(on, (set) => (set ? 255 : 0)), Float64Array.from(on, (set) => (set ? 1 : NaN))]) {
    assert.deepEqual(same(mask), expected);
  }
});

test('a confidence that was read has the type of its file', () => {
  const file = { width: 3, height: 1, data: Float64Array.of(0, 1, 2), dataType: 'u8' };
  const { confidence } = asDepthOptions({ confidence: /** @type {any} */ (file) });
  assert.deepEqual([.../** @type {any} */ (confidence).data], [0, 0.25, 1]);
});

test('the command runs within a process, with streams of the caller', async () => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'bent.npy'), await writeImage(bent));
  try {
    for (const threads of ['1', '2']) {
      const { status, stdout, stderr } = await run(folder, ['fit', 'bent.npy', '-o', 'flat.npy', '--lambda', 'big', '--threads', threads, '--report', 'r.json']);
      assert.deepEqual([status, stdout, stderr], [0, '', '']);
    }
    assert.match((await run(folder, ['info', 'flat.npy'])).stdout, /format: +npy/);
    const wrong = await run(folder, ['fit', 'none.npy', '-o', 'x.npy']);
    assert.equal(wrong.status, 3);
    assert.match(wrong.stderr, /^developable: cannot read none\.npy/);
    const interrupted = await run(folder, ['fit', 'bent.npy', '-o', 'late.npy'], { signal: AbortSignal.abort() });
    assert.deepEqual([interrupted.status, interrupted.stderr], [130, '']);
  } finally {
    dispose();
  }
});

test('a package that is not built cannot be packed', async () => {
  const folder = await temporaryFolder();
  await cp(join(pkg, 'package.json'), join(folder, 'package.json'));
  const prepack = [process.execPath, join(root, 'tools/prepack.mjs')];
  const empty = await runProcess(folder, [], { program: prepack });
  assert.equal(empty.status, 1);
  assert.match(empty.stderr, /not complete: .*wasm\/solver_bg\.wasm.*direct-calls\.d\.ts, option-types\.d\.ts.*threads\/threads\.js.*npm run build/);
  assert.deepEqual(await runProcess(pkg, [], { program: prepack }), silent);
});

test('what a step beside others has said is shown if the tests end before its turn', async () => {
  const script = `
    import { run, shownLater } from ${JSON.stringify(new URL('../../tools/util/process.mjs', import.meta.url).href)};
    const say = (isShown, words) => shownLater.run({ text: '', isShown }, () => run(process.execPath, ['-e', 'console.log("' + words + '")'], { show: true }));
    await say(false, 'half way');
    await say(true, 'at once');
    process.exit(130);`;
  const ended = await runProcess(root, [], { program: [process.execPath, '--input-type=module', '-e', script] });
  assert.deepEqual(ended, { status: 130, stdout: 'at once\nhalf way\n', stderr: '' });
});
