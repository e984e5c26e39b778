/** How the command writes files: whole or not at all, where the user said and nowhere else. */
import assert from 'node:assert/strict';
import { mkdirSync, renameSync } from 'node:fs';
import { chmod, mkdir, readFile, readdir, readlink, rm, stat, symlink, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { checkPlaces, readBytes, writeWhole } from '../../pkg/cli/files.js';
import { failed } from '../../pkg/cli/system-errors.js';
import { command, runProcess, silent, temporaryFolder } from './support/command.mjs';

const folder = await temporaryFolder();
const never = new AbortController().signal;
/** @param {string} name */
const at = (name) => join(folder, name);
/** @param {string} text */
const bytes = (text) => new TextEncoder().encode(text);
/** @param {string} name */
const text = (name) => readFile(at(name), 'utf8');
/** @param {string} name */
const mode = async (name) => ((await stat(at(name))).mode & 0o777).toString(8);
const drafts = async () => (await readdir(folder)).filter((name) => name.endsWith('.tmp'));
/** @param {Record<string, string>} files */
const write = (files) =>
  writeWhole(Object.entries(files).map(([name, content]) => ({ path: at(name), bytes: bytes(content) })), never);

test('a link that waits where a draft might be written is not followed', async () => {
  await writeFile(at('victim.txt'), 'mine');
  for (const i of [0, 1]) await symlink('victim.txt', at(`.developable-${process.pid}-${i}.tmp`));
  await write({ 'a.npy': 'a', 'b.npy': 'b' });
  assert.deepEqual([await text('victim.txt'), await text('a.npy'), await text('b.npy')], ['mine', 'a', 'b']);
  for (const i of [0, 1]) await rm(at(`.developable-${process.pid}-${i}.tmp`)); // still links
  assert.deepEqual(await drafts(), []);
});

test('a file that is replaced keeps its permissions', async () => {
  for (const bits of [0o600, 0o640, 0o664, 0o755, 0o666]) {
    await writeFile(at('kept.npy'), 'old');
    await chmod(at('kept.npy'), bits);
    await write({ 'kept.npy': 'new' });
    assert.deepEqual([await text('kept.npy'), await mode('kept.npy')], ['new', bits.toString(8)]);
  }
  await write({ 'fresh.npy': 'new' });
  assert.equal(await mode('fresh.npy'), (0o666 & ~process.umask()).toString(8));
});

test('a read-only file stays, and that is said before the work', async () => {
  await writeFile(at('fixed.npy'), 'old');
  await chmod(at('fixed.npy'), 0o444);
  const said = { status: 3, message: `cannot write ${at('fixed.npy')}: it is read-only` };
  await assert.rejects(checkPlaces(at('other.npy'), at('fixed.npy')), said);
  await assert.rejects(write({ 'other.npy': 'x', 'fixed.npy': 'x' }), said);
  assert.equal(await text('fixed.npy'), 'old');
  await assert.rejects(stat(at('other.npy')));
  assert.deepEqual(await drafts(), []);
});

test('no failure is told in the words of the system', async () => {
  await mkdir(at('folder.npy'));
  await writeFile(at('file.npy'), 'x');
  await symlink('circle.npy', at('circle.npy'));
  /** @type {[string, RegExp][]} */
  const cases = [
    ['file.npy/x.npy', /a part of the path is no folder$/],
    ['file.npy/deeper/x.npy', /a part of the path is no folder$/],
    ['nowhere/x.npy', /there is no such file or folder$/],
    ['folder.npy', /it is a folder$/],
    ['circle.npy', /its links go in a circle$/],
    [`${'n'.repeat(300)}.npy`, /the name is too long$/],
    ['a\0b.npy', /no file can have this name$/],
  ];
  for (const [name, message] of cases) {
    for (const job of [checkPlaces(at(name)), write({ 'before.npy': 'x', [name]: 'x' })]) {
      await assert.rejects(job, (/** @type {Error & { status?: number }} */ error) => {
        assert.equal(error.status, 3, error.stack);
        assert.match(error.message, message);
        assert.doesNotMatch(error.message, /\bE[A-Z]{3,}\b/);
        return true;
      });
    }
    if (name !== 'folder.npy' && !name.startsWith('nowhere')) {
      await assert.rejects(readBytes(at(name)), (/** @type {Error} */ error) => !/\bE[A-Z]{3,}\b/.test(error.message));
    }
  }
  await assert.rejects(stat(at('before.npy')));
  assert.deepEqual(await drafts(), []);
  // What nobody has thought of loses its name, too.
  const odd = Object.assign(new Error("EXDEV: cross-device link not permitted, rename 'a' -> 'b'"), { code: 'EXDEV' });
  assert.equal(failed('cannot write x', odd).message, 'cannot write x: cross-device link not permitted');
});

test('a link is followed to a file that is not there yet', async () => {
  await symlink('later.npy', at('link.npy'));
  await write({ 'link.npy': 'x' });
  assert.deepEqual([await readlink(at('link.npy')), await text('later.npy')], ['later.npy', 'x']);
});

test('what was there is put back when a later file cannot be written', async () => {
  await writeFile(at('first.npy'), 'first');
  await chmod(at('first.npy'), 0o640);
  await writeFile(at('second.npy'), 'second');
  const before = await stat(at('first.npy'));
  // It becomes a folder when all drafts are written: the last moment at which anything can go wrong.
  const late = /** @type {AbortSignal} */ (/** @type {unknown} */ ({
    throwIfAborted() {
      renameSync(at('second.npy'), at('aside.npy'));
      mkdirSync(at('second.npy'));
    },
  }));
  const files = ['first.npy', 'new.npy', 'second.npy'].map((name) => ({ path: at(name), bytes: bytes('x') }));
  await assert.rejects(writeWhole(files, late), { status: 3, message: /second\.npy: it is a folder$/ });
  const after = await stat(at('first.npy'));
  assert.deepEqual([await text('first.npy'), after.ino, after.mode], ['first', before.ino, before.mode]);
  await assert.rejects(stat(at('new.npy')));
  assert.equal(await text('aside.npy'), 'second');
  assert.deepEqual(await drafts(), []);
});

test('a limit on the size of files, a full output and a closed one are told plainly', async (t) => {
  if (process.platform === 'win32') return t.skip('there is no sh');
  await writeFile(at('ramp.pfm'), Buffer.concat([bytes('Pf\n4 4\n-1\n'), Buffer.from(new Float32Array(16).buffer)]));
  /** @param {string} script @param {string[]} args */
  const shell = (script, args) =>
    runProcess(folder, ['-c', `${script} "$@"`, 'sh', process.execPath, command, ...args], { program: ['sh'] });
  await writeFile(at('big.npy'), 'old');
  const limited = await shell('ulimit -f 0; exec', ['fit', 'ramp.pfm', '-o', 'big.npy']);
  assert.deepEqual([limited.status, limited.stdout], [3, '']);
  assert.match(limited.stderr, /cannot write big\.npy: it would be too large a file\n$/);
  assert.equal(await text('big.npy'), 'old');
  assert.deepEqual(await drafts(), []);
  // A reader that wants no more.
  const cut = await runProcess(folder, ['-c', `"$0" "$1" --help | :`, process.execPath, command], { program: ['sh'] });
  assert.deepEqual(cut, silent);
  if (!(await stat('/dev/full').catch(() => undefined))) return;
  const full = await runProcess(folder, ['-c', `exec "$0" "$1" --help > /dev/full`, process.execPath, command], { program: ['sh'] });
  assert.deepEqual([full.status, full.stderr], [3, 'developable: cannot write to standard output: the disk is full\n']);
});

for (const [signal, expected] of /** @type {const} */ ([['SIGHUP', 129], ['SIGINT', 130], ['SIGTERM', 143]])) {
  test(`${signal} takes away a draft that is there`, async (t) => {
    if (process.platform === 'win32') return t.skip('there are no such signals');
    await writeFile(at('scan.pfm'), Buffer.concat([bytes('Pf\n4 4\n-1\n'), Buffer.from(new Float32Array(16).buffer)]));
    await writeFile(at('surface.npy'), 'old');
    const pause = new URL('support/pause-at-draft.mjs', import.meta.url).href;
    let seen = -1;
    const result = await runProcess(folder, ['fit', 'scan.pfm', '-o', 'surface.npy', '--report', 'surface.json'], {
      program: [process.execPath, '--import', pause, command],
      env: { AWAITED_SIGNAL: signal },
      channel: true,
      onStart: (child) => child.once('message', async () => {
        seen = (await drafts()).length;
        child.kill(signal);
      }),
    });
    assert.equal(seen, 1, 'the draft was there when the signal was sent');
    assert.deepEqual(result, { status: expected, stdout: '', stderr: '' });
    assert.deepEqual([await drafts(), await text('surface.npy')], [[], 'old']);
    await assert.rejects(stat(at('surface.json')));
  });
}
