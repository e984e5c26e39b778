/** The command never replaces a file that it reads, unless it is told to. */
import assert from 'node:assert/strict';
import { mkdir, readFile, symlink, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { parse, run, silent, temporaryFolder } from './support/command.mjs';
import { deviation, image, plane } from './support/shapes.mjs';

await Promise.all([direct.init(), direct.load('files')]);
const folder = await temporaryFolder();
const ramp = image(24, 20, plane);
const scan = direct.writeImage(ramp);

test('the input is replaced only with --force', async () => {
  const path = join(folder, 'scan.npy');
  await writeFile(path, scan);
  await symlink('scan.npy', join(folder, 'link.npy'));
  await mkdir(join(folder, 'below'));
  await symlink('..', join(folder, 'below/up'));
  for (const output of ['scan.npy', './scan.npy', 'link.npy', 'below/up/scan.npy', path]) {
    const { status, stdout, stderr } = await run(folder, ['fit', 'scan.npy', '-o', output]);
    assert.deepEqual([status, stdout], [2, ''], output);
    assert.match(stderr, /^developable: the input and the output are the same file, and \S*(scan|link)\.npy would be replaced: .*--force/);
    assert.deepEqual(new Uint8Array(await readFile(path)), scan, 'the scan is as it was');
  }
  // The link as the input, and the file itself as the output.
  assert.equal((await run(folder, ['fit', 'link.npy', '-o', 'scan.npy'])).status, 2);
  assert.deepEqual(await run(folder, ['fit', 'scan.npy', '-o', 'link.npy', '--force']), silent);
  const { data } = direct.read(await readFile(path));
  assert.ok(deviation(data, ramp.data) < 1e-9, 'a plane is fitted by itself');
  assert.notDeepEqual(new Uint8Array(await readFile(path)), scan, 'of 64 bits instead of 32');
});

test('no file that is written is one that is read, whichever they are', () => {
  /** Commands with a file that is written and one that is read, named alike. @type {[string, string][]} */
  const cases = [
    ['fit a.npy -o x.npy --report a.npy', 'the input and the report'],
    ['fit a.npy -o m.npy --mask m.npy', 'the mask and the output'],
    ['fit a.npy -o x.npy --confidence c.npy --report c.npy', 'the confidence and the report'],
    ['fit a.npy -o t.obj --texture t.obj', 'the texture and the output'],
    ['fit d.npy -o x.npy --intrinsics c.json --report c.json', 'the file of the intrinsics and the report'],
    ['fit a.npy -o x.obj --texture m.mtl --mtl m.mtl', 'the texture and the mtl'],
    ['pattern s.glb -o x.svg --assembly s.glb', 'the input and the assembly'],
    ['pattern s.glb -o x.svg --assembly s.glb --surface', 'the input and the assembly'],
    ['occlusions a.npy -o a.npy', 'the input and the output'],
    ['design a.npy -o a.npy', 'the input and the output'],
    ['analyze a.json -o a.json', 'the input and the output'],
    ['dewarp a.npy --texture p.png -o p.png', 'the texture and the output'],
    ['dewarp a.npy --texture p.png -o x.png --map a.npy', 'the input and the map'],
    ['dewarp p.png --edges e.json -o p.png', 'the input and the output'],
    ['dewarp p.png --edges e.json -o x.png --report e.json', 'the edges and the report'],
    ['dewarp p.png --edges e.json -o x.png --map e.json', 'the edges and the map'],
  ];
  for (const [args, which] of cases) {
    const message = new RegExp(`^${which} are the same file, and .* would be replaced: .*--force`);
    assert.throws(() => parse(args.split(' ')), { status: 2, message }, args);
    parse([...args.split(' '), '--force']);
  }
});

test('two files that are written are never one, with --force neither', async () => {
  await mkdir(join(folder, 'real'));
  await symlink('real', join(folder, 'alias'));
  await symlink('target.json', join(folder, 'dangling.json'));
  const at = (/** @type {string} */ name) => join(folder, name);
  /** @type {[string, string[]][]} */
  const cases = [
    ['fit a.npy', ['-o', 'x.npy', '--report', './x.npy']],
    ['patches a.npy', ['-o', at('real/r.json'), '--report', at('alias/r.json')]],
    ['patches a.npy', ['-o', at('dangling.json'), '--report', at('target.json')]],
    ['dewarp p.png --edges e.json', ['-o', 'x.png', '--report', 'm.json', '--map', 'm.json']],
  ];
  for (const [args, paths] of cases) {
    for (const force of [[], ['--force']]) {
      assert.throws(() => parse([...args.split(' '), ...paths, ...force]), { status: 2, message: /are the same file, .*: choose another name/ });
    }
  }
});

test('a circle of links is no file, and no endless search', async () => {
  await symlink('round.npy', join(folder, 'round.npy'));
  parse(['fit', 'a.npy', '-o', join(folder, 'round.npy')]);
});
