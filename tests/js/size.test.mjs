/** Whether so many vertices are meant as --resolution or --spacing makes, and what a terminal shows before a fit. */
import assert from 'node:assert/strict';
import { readdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { MAX_VERTICES_UNASKED, confirmSize } from '../../pkg/cli/size.js';
import { command, runProcess, temporaryFolder } from './support/command.mjs';

const { signal } = new AbortController();

/** Heights at so many vertices, beside as many places without any. @param {number} vertices */
const sampled = (vertices) => /** @type {any} */ ({ rows: 2, cols: vertices, spacing: 1, heights: new Float64Array(2 * vertices).fill(NaN, vertices) });

/** @param {string | undefined} answer nothing for nobody who could answer */
function user(answer) {
  /** @type {string[]} */
  const told = [];
  const listed = {
    answers: answer !== undefined,
    ask: async (/** @type {string} */ question) => {
      told.push(question);
      return answer ?? '';
    },
    warn: (/** @type {string} */ text) => void told.push(text),
  };
  return { told, user: listed };
}

test('a size that takes long is asked about, where somebody can answer', async () => {
  const task = { lattice: /** @type {const} */ ('mesh'), resolution: 4000, force: false };
  const many = sampled(MAX_VERTICES_UNASKED + 1);
  for (const answer of ['y', 'Y', ' yes ', 'Yes\n']) {
    const { told, user: somebody } = user(answer);
    await confirmSize(task, many, signal, somebody);
    assert.equal(told.length, 1);
    assert.match(told[0], /^--resolution 4000 makes 2,000,001 vertices.*\[y\/N\] $/);
  }
  for (const answer of ['', 'n', 'no', 'yeah', '\n']) {
    const refused = { status: 2, message: /a smaller --resolution, or add --force/ };
    await assert.rejects(confirmSize(task, many, signal, user(answer).user), refused, answer);
  }
  const finer = { lattice: /** @type {const} */ ('mesh'), spacing: 0.01, force: false };
  await assert.rejects(confirmSize(finer, many, signal, user('n').user), { message: /a larger --spacing/ });
});

test('where nobody can answer, it is a warning', async () => {
  const { told, user: nobody } = user(undefined);
  await confirmSize({ lattice: 'mesh', resolution: 4000, force: false }, sampled(MAX_VERTICES_UNASKED + 1), signal, nobody);
  assert.equal(told.length, 1);
  assert.match(told[0], /^warning: --resolution 4000 makes 2,000,001 vertices/);
});

test('nothing is asked of a size that nobody has asked for, or that is usual, or that is forced', async () => {
  const many = sampled(MAX_VERTICES_UNASKED + 1);
  const image = /** @type {any} */ ({ width: 1000, height: 500, data: new Float32Array(0), pixelSize: 2 });
  const { told, user: somebody } = user('n');
  await confirmSize({ lattice: 'mesh', force: false }, many, signal, somebody);
  await confirmSize({ lattice: 'mesh', resolution: 4000, force: true }, many, signal, somebody);
  await confirmSize({ lattice: 'hex', spacing: 1, force: false }, many, signal, somebody);
  await confirmSize({ lattice: 'mesh', resolution: 1500, force: false }, sampled(MAX_VERTICES_UNASKED), signal, somebody);
  // An image of 1000 × 500 units² at a spacing of 1: 2/√3 vertices for each.
  await confirmSize({ lattice: 'square', spacing: 2, force: false }, image, signal, somebody);
  assert.deepEqual(told, []);
  await assert.rejects(confirmSize({ lattice: 'square', spacing: 0.5, force: false }, image, signal, somebody), { status: 2 });
  assert.match(told[0], /--spacing 0\.5 makes 9,237,604 vertices/);
});

test('a terminal is asked before the fit, and sees what is done', async (t) => {
  const folder = await temporaryFolder();
  await writeFile(join(folder, 'two.obj'), 'v 0 0 0\nv 1 0 0.1\nv 1 1 0\nv 0 1 0.1\nf 1 2 3\nf 1 3 4\n');
  /** @param {string} typed @param {string} args */
  const typing = (typed, args) => {
    const line = `${process.execPath} ${command} fit two.obj -o ${args}`;
    return runProcess(folder, ['-c', `printf '${typed}' | script -qec '${line}' /dev/null`], { program: ['sh'] }).catch(() => undefined);
  };
  const refused = await typing('n\\n', 'large.obj --resolution 1600');
  if (!refused || /script: not found/.test(refused.stderr)) return t.skip('there is no `script` to make a terminal with');
  assert.equal(refused.status, 2, refused.stdout);
  assert.match(refused.stdout, /reading two\.obj\.\.\./);
  assert.match(refused.stdout, /looking at two\.obj\.\.\./);
  assert.match(refused.stdout, /--resolution 1600 makes 2,9\d\d,\d{3} vertices.*Go on\? \[y\/N\]/);
  assert.match(refused.stdout, /nothing was fitted: choose a smaller --resolution/);
  const fitted = await typing('', 'small.obj --resolution 20');
  assert.equal(fitted?.status, 0, fitted?.stdout);
  assert.match(fitted?.stdout ?? '', /setting up\.\.\./);
  assert.doesNotMatch(fitted?.stdout ?? '', /Go on/);
  assert.deepEqual((await readdir(folder)).sort(), ['small.obj', 'two.obj']);
});
