/** Several inputs for one command: what is done, skipped and told, and how it ends. */
import assert from 'node:assert/strict';
import { mkdir, readFile, readdir, stat, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { beforeEach, test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { command, refuses, run, runProcess, temporaryFolder } from './support/command.mjs';
import { deviation, endless, image, plane } from './support/shapes.mjs';
import { until } from './support/waiting.mjs';

await Promise.all([direct.init(), direct.load('files')]);
const root = await temporaryFolder();
const ramp = image(24, 20, plane);
let count = 0;
let folder = root;

beforeEach(async () => {
  folder = join(root, `case ${++count}`);
  await mkdir(folder);
  for (const name of ['a.npy', 'b.npy', 'c.npy']) await writeFile(join(folder, name), direct.writeImage(ramp));
  await writeFile(join(folder, 'bad.npy'), 'hello');
});

/** @param {string[]} args */
const developable = (...args) => run(folder, args);
/** Names in a folder, without the fingerprints. @param {string} name */
const made = async (name) => (await readdir(join(folder, name))).filter((file) => file !== '.developable');
/** @param {string} name */
const changed = async (name) => (await stat(join(folder, name))).mtimeMs;

test('a file that cannot be read stops none of the others, and the summary and the exit status tell', async () => {
  const ended = await developable('fit', 'a.npy', 'bad.npy', 'gone.npy', 'c.npy', '-o', 'out/', '--report', 'told/*.json', '--jobs', '2');
  assert.equal(ended.status, 3);
  assert.match(ended.stderr, /^developable: bad\.npy: (?!bad)/m);
  assert.match(ended.stderr, /^developable: gone\.npy: cannot read gone\.npy: there is no such file/m);
  assert.match(ended.stderr, /developable: 4 files: 2 done, 2 failed\n$/);
  assert.deepEqual(await made('out'), ['a.npy', 'c.npy']);
  assert.deepEqual(await made('told'), ['a.json', 'c.json']);
  // A plane is its own fit.
  const fitted = direct.read(await readFile(join(folder, 'out/a.npy')));
  assert.ok(deviation(fitted.data, ramp.data) < 1e-9);
});

test('what the same options have made of the same input is skipped, and everything else is made anew', async () => {
  const args = ['fit', 'a.npy', 'b.npy', '-o', 'out/', '--lambda', '1e7'];
  assert.equal((await developable(...args)).status, 0);
  const first = await Promise.all(['out/a.npy', 'out/b.npy'].map(changed));

  const again = await developable(...args, 'c.npy');
  assert.equal(again.status, 0);
  assert.match(again.stderr, /3 files: 1 done, 2 done before \(--overwrite does them again\), 0 failed/);
  assert.deepEqual(await Promise.all(['out/a.npy', 'out/b.npy'].map(changed)), first);

  // Another input, another option, another output in its place.
  await writeFile(join(folder, 'b.npy'), direct.writeImage(image(24, 20, (x, y) => 2 * plane(x, y))));
  assert.match((await developable(...args)).stderr, /2 files: 1 done, 1 done before/);
  assert.equal(await changed('out/a.npy'), first[0]);
  const one = ['fit', 'a.npy', '-o', 'out/', '--lambda'];
  assert.match((await developable(...one, '1e4')).stderr, /1 file: 1 done, 0 failed/);
  await writeFile(join(folder, 'out/a.npy'), direct.writeImage(ramp));
  assert.match((await developable(...one, '1e4')).stderr, /1 file: 1 done, 0 failed/);
  assert.match((await developable(...one, '1e4', '--overwrite')).stderr, /1 file: 1 done, 0 failed/);
  // In place the input is another one each time.
  assert.match((await developable('fit', 'a.npy', '-o', '*.npy', '--force')).stderr, /1 file: 1 done, 0 failed/);
});

test('patterns that the shell did not expand are expanded, and one without a match starts nothing', async () => {
  await writeFile(join(folder, 'odd*.npy'), direct.writeImage(ramp));
  const ended = await developable('fit', '?.npy', 'odd*.npy', '-o', 'out/');
  assert.match(ended.stderr, /4 files: 4 done, 0 failed/);
  assert.deepEqual(await made('out'), ['a.npy', 'b.npy', 'c.npy', 'odd*.npy']);
  // One match is one input.
  assert.match((await developable('info', 'odd*.npy')).stdout, /^size: +24 × 20 pixels$/m);
  for (const args of [['gone/*.npy', '-o', 'other/'], ['gone/*.npy', '-o', 'other/*.npy', '--jobs', '4']]) {
    const nothing = await developable('fit', ...args);
    assert.equal(nothing.stderr, 'developable: no file matches gone/*.npy\n');
    assert.equal(nothing.status, 3);
  }
  assert.ok(!(await readdir(folder)).includes('other'));
});

test('a process that does one input of a batch starts no batch', { skip: process.platform !== 'linux' }, async () => {
  await writeFile(join(folder, 'odd*.npy'), direct.writeImage(ramp));
  /** @type {number[]} */
  const counts = [];
  /** @param {number} parent @returns {Promise<number>} processes that it started, and those that these did */
  const descendants = async (parent) => {
    const text = await readFile(`/proc/${parent}/task/${parent}/children`, 'utf8').catch(() => '');
    const children = text.trim().split(' ').filter(Boolean).map(Number);
    const further = await Promise.all(children.map(descendants));
    return children.length + further.reduce((sum, count) => sum + count, 0);
  };
  /** @param {import('node:child_process').ChildProcess} child */
  const count = async ({ pid = 0, exitCode }) => {
    if (exitCode === null) counts.push(await descendants(pid));
  };
  /** @type {NodeJS.Timeout | undefined} */
  let timer;
  const ended = await runProcess(folder, ['fit', 'odd*.npy', '-o', 'out/'], { onStart: (child) => (timer = setInterval(count, 20, child)) });
  clearInterval(timer);
  assert.equal(ended.status, 0, ended.stderr);
  assert.equal(Math.max(...counts), 1);
});

test('an output that is a folder takes the name of its input, and a failure leaves what an earlier run has written', async () => {
  await mkdir(join(folder, 'out'));
  await writeFile(join(folder, 'out/bad.npy'), 'from before');
  assert.equal((await developable('fit', 'bad.npy', 'a.npy', '-o', 'out', '-j', '1')).status, 3);
  assert.equal(await readFile(join(folder, 'out/bad.npy'), 'utf8'), 'from before');
  assert.deepEqual(await made('out'), ['a.npy', 'bad.npy']);
});

test('other commands take several inputs, and what they tell comes in the order of these', async () => {
  const info = await developable('info', 'b.npy', 'a.npy');
  assert.match(info.stdout, /^==> b\.npy <==\n[^]*24[^]*==> a\.npy <==\n/);
  const areas = await developable('patches', 'a.npy', 'b.npy', '--as-is', '-o', 'areas of *.json');
  assert.equal(areas.status, 0, areas.stderr);
  const { patches } = JSON.parse(await readFile(join(folder, 'areas of b.json'), 'utf8'));
  assert.equal(patches.length, 1);
});

test('wrong usage is found before anything is written', async () => {
  const before = await readdir(folder);
  await refuses(folder, [
    ['fit a.npy b.npy', /the output of several inputs is missing/],
    ['fit a.npy b.npy -o x.npy', /--output "x\.npy" is one file for several inputs/],
    ['fit a.npy b.npy -o out/ --report r.json', /--report "r\.json" is one file for several inputs/],
    ['fit a.npy sub/a.npy -o out/', /a\.npy and sub\/a\.npy would both be written to out\/a\.npy/],
    ['fit a.npy b.npy -o *.npy', /would be replaced/],
    ['fit a.npy b.npy -o out/ --jobs 0', /--jobs must be a whole number from 1 on/],
    ['pattern a.npy b.npy -o out/*.npy', /the output must end in/],
    ['fit a.npy b.npy -o out/ --lambda x', /--lambda/],
  ]);
  assert.deepEqual(await readdir(folder), before);
});

test('an interruption ends all processes, and what was done before stays', async () => {
  await writeFile(join(folder, 'long.npy'), direct.writeImage(endless(300).input));
  assert.equal((await developable('fit', 'a.npy', 'b.npy', '-o', 'out/')).status, 0);
  const endlessly = ['--gap', '1e-12', '--lambda', 'small', '--max-iterations', '1e9'];
  /** @type {import('node:child_process').ChildProcess[]} */
  const children = [];
  const onStart = (/** @type {import('node:child_process').ChildProcess} */ child) => children.push(child);
  const running = runProcess(folder, ['fit', 'long.npy', '-o', 'begun/', ...endlessly], { onStart });
  // The folder is made just before the process is started.
  await until('the process starts', async () => (await readdir(folder)).includes('begun'));
  children[0].kill('SIGINT');
  assert.equal((await running).status, 130);
  assert.deepEqual(await made('begun'), []);
  assert.deepEqual(await made('out'), ['a.npy', 'b.npy']);
});


test('the array job in the documentation shares the inputs among its tasks', { skip: process.platform === 'win32' }, async () => {
  const text = await readFile(new URL('../../docs/command.md', import.meta.url), 'utf8');
  const script = text.split('```sh\n').find((block) => block.startsWith('#!/bin/sh'))?.split('```')[0] ?? '';
  assert.match(script, /SLURM_ARRAY_TASK_ID/);
  await mkdir(join(folder, 'scans'));
  for (const name of ['a', 'b', 'c d']) await writeFile(join(folder, `scans/${name}.npy`), direct.writeImage(ramp));
  await mkdir(join(folder, 'bin'));
  await writeFile(join(folder, 'bin/npx'), `#!/bin/sh\nshift\nexec '${process.execPath}' '${command}' "$@"\n`, { mode: 0o755 });
  await writeFile(join(folder, 'fit.sh'), script);
  const PATH = `${join(folder, 'bin')}:${process.env.PATH}`;
  for (const [task, expected] of [['0', ['a.npy', 'c d.npy']], ['1', ['a.npy', 'b.npy', 'c d.npy']]]) {
    const env = { PATH, SLURM_ARRAY_TASK_COUNT: '2', SLURM_ARRAY_TASK_ID: String(task), SLURM_CPUS_PER_TASK: '2' };
    const ended = await runProcess(folder, [], { program: ['/bin/sh', 'fit.sh'], env });
    assert.equal(ended.status, 0, ended.stderr);
    assert.deepEqual(await made('out'), expected);
  }
});
