/** What the command says of values that cannot be: the flag as it was written, numbers as people write them, and no names that there are not. */
import assert from 'node:assert/strict';
import { mkdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { commands } from '../../pkg/cli/commands.js';
import { asFlags, sections } from '../../pkg/cli/flags.js';
import { Problem } from '../../pkg/cli/problem.js';
import * as direct from '../../pkg/direct.js';
import { parse, refuses, run, temporaryFolder } from './support/command.mjs';
import { cylinder, image, lattice, plane } from './support/shapes.mjs';

await direct.init();
await direct.load('files', 'meshes', 'fitmesh', 'unroll', 'patterns');
const folder = await temporaryFolder();
await writeFile(join(folder, 'a.npy'), direct.writeImage(image(16, 16, cylinder(16))));
await writeFile(join(folder, 'words.txt'), 'some words');
await writeFile(join(folder, 'p.png'), direct.writeImage(image(16, 16, cylinder(16)), { format: 'png' }));
await writeFile(join(folder, 'm.obj'), direct.writeObj(lattice(12, 12, plane)));

/** @type {Record<string, import('../../pkg/cli/flags.js').FlagInfo>} */
const flags = Object.assign({}, ...Object.values(sections).map((section) => section.flags));
const hostile = [
  'NaN', 'Infinity', '-Infinity', 'inf', '-0', '0', '1e300', '1e-300', '-1', '0.5', '4294967296', '', ' ', 'x', '1,2', '0,0,0', '[]', '{}',
  'null', 'a'.repeat(5000), '\u{1f600}', '../x', 'AUTO', 'None', '0x10', '1e', '--', '=',
];

test('whatever stands after a flag, it is taken or refused in words that name a flag of the command', () => {
  /** @type {Record<string, string>} */
  const outputs = { occlusions: 'o.png', analyze: 'o.json', patches: 'o.json', rulings: 'o.json', unroll: 'o.json', pattern: 'o.svg', dewarp: 'o.png' };
  let refused = 0;
  for (const [command, { flags: taken }] of Object.entries(commands)) {
    const output = command === 'info' ? [] : ['-o', outputs[command] ?? 'o.obj'];
    for (const flag of /** @type {readonly string[]} */ (taken)) {
      if (flags[flag].value === undefined) continue;
      for (const value of hostile) {
        const call = `${command} --${flag}=${value.slice(0, 20)}`;
        try {
          parse([command, 'a.npy', ...output, `--${flag}=${value}`]);
        } catch (error) {
          refused += 1;
          assert.ok(error instanceof Problem, call);
          assert.equal(error.status, 2, call);
          assert.ok(error.message.length < 500, call);
          for (const [, name] of error.message.matchAll(/--([a-z][a-z-]*)/g)) assert.ok(name in flags, `${call}: ${error.message}`);
        }
      }
    }
  }
  assert.ok(refused > 1000, `${refused}`);
});

test('a flag without a value, and numbers that cannot be, are refused in plain words', async () => {
  await refuses(folder, [
    [['fit', 'a.npy', '-o', 'o.npy', '--mask='], /: --mask is empty: it needs a value, as in --mask FILE\n/],
    [['fit', 'a.npy', '-o', 'o.npy', '--gap', '1e300'], /: --gap is 1e300, but must lie/],
    [['fit', 'a.npy', '-o', 'o.npy', '--lambda', '-0'], /: --lambda is 0, but must lie/],
    [['fit', 'a.npy', '-o', 'o.npy', '--bend-radius', 'Infinity'], /: --bend-radius is infinity, but/],
    [['fit', 'a.npy', '-o', 'o.npy', '--bridge', 'Infinity'], /: --bridge is infinity, but must be a width from 1 to 16.*, or none\n/],
    [['fit', 'a.npy', '-o', 'o.npy', '--bridge', '99'], /: --bridge is 99, but must be a width from 1 to 16.*, or none\n/],
    [['fit', 'a.npy', '-o', 'o.npy', '--max-iterations', '0.5'], /: --max-iterations is 0\.5, but must be a whole number from 0 to about 4 billion\n/],
    [['fit', 'a.npy', '-o', 'o.npy', '--spacing', '0'], /^developable: --spacing is 0, but must be/],
    [['fit', 'a.npy', '-o', 'o.npy', '--spacing', '1e-300'], /^developable: lattice needs billions of cells, more than the limit of 20,971,520;/, 3],
    [['fit', 'a.npy', '-o', 'o.obj', '--intrinsics', '0,8,8,8'], /: fx of the camera \(--intrinsics or --photo-camera\) is 0, but/],
    [['fit', 'a.npy', '-o', 'o.obj', '--intrinsics', '8,8,8,8,-1'], /: scale of the camera \(--intrinsics or --photo-camera\) is -1, but/],
    [['fit', 'm.obj', '-o', 'o.obj', '--view', '0,0,0'], /: --view is \[0, 0, 0\], but/],
    [['fit', 'm.obj', '-o', 'o.obj', '--view', '1e999,0,0'], /: --view is \[Infinity, 0, 0\], but/],
    [['pattern', 'a.npy', '-o', 'o.svg', '--as-is', '--lattice', 'hex', '--marks', '0.5'], /: --marks is 0\.5, but must be from 1 to 50000, or 0 for none\n/],
    [['fit', 'words.txt', '-o', 'o.npy'], /^developable: words\.txt: text: it is of no format that is read; heights are read from PNG/, 3],
    [['dewarp', 'm.obj', '--texture', 'p.png', '-o', 'o.png'], /: nothing says where in the photo the points of m\.obj are: --photo-camera FILE/, 3],
    [['pattern', 'a.npy', '-o', 'o.svg', '--as-is', '--lattice', 'hex', '--k-factor', '0.4'], /: --inner-radius and --k-factor are .*: give --thickness, too\n/],
  ]);
});

test('names of options become those of flags, and no other names do', () => {
  assert.equal(asFlags('option `maxIterations` is 0'), '--max-iterations is 0');
  assert.equal(asFlags('options `focalLength`, `fieldOfView` and `film35` say the same'), '--focal-length, --field-of-view and `film35` say the same');
  assert.equal(asFlags('it has no array `mask`; choose one by the option `array`'), 'it has no array `mask`; choose one by --array');
});

test('a texture that lies outside of the folder is told from one that is not there', async () => {
  await mkdir(join(folder, 'sub'));
  await writeFile(join(folder, 'outside.mtl'), 'newmtl a\n');
  const face = 'v 0 0 0\nv 9 0 0\nv 9 9 1\nv 0 9 0\nf 1 2 3\nf 1 3 4\n';
  await writeFile(join(folder, 'sub/a.obj'), `mtllib ../outside.mtl\n${face}`);
  await writeFile(join(folder, 'sub/b.obj'), `mtllib nowhere.mtl\n${face}`);
  const outside = await run(folder, ['fit', 'sub/a.obj', '-o', 'o.obj', '--resolution', '12']);
  assert.match(outside.stderr, /names "\.\.\/outside\.mtl", which is outside of its folder: only files there or below are read\. Copy it there\n/);
  const nowhere = await run(folder, ['fit', 'sub/b.obj', '-o', 'o.obj', '--resolution', '12']);
  assert.match(nowhere.stderr, /names "nowhere\.mtl", which is not there\n/);
});

test('an error names the option as the package calls it', () => {
  const bent = image(16, 16, cylinder(16));
  const photo = { width: 16, height: 16, data: new Uint8Array(1024).fill(255) };
  const edges = { top: [[2, 2], [8, 1.5], [14, 2]], bottom: [[2, 14], [8, 14.5], [14, 14]] };
  /** @type {[() => unknown, RegExp][]} */
  const cases = [
    [() => direct.dewarp(bent, photo, { grid: 0 }), /^option `grid` is 0, but must be/],
    [() => direct.dewarp(bent, photo, { extent: [0, 0, 0, 0] }), /^option `extent` is \[0, 0, 0, 0\], but must be .* left less than right/],
    [() => direct.dewarp(bent, photo, { extent: [0, 0, Infinity, 1] }), /^option `extent` is/],
    [() => direct.picture(bent, { extent: [1, 0, 0, 1] }), /^option `extent` is \[1, 0, 0, 1\]/],
    [() => direct.dewarpPage(photo, /** @type {any} */ (edges), { page: [0, 1], findLines: false }), /^option `page` is 0, but/],
    [() => direct.dewarpPage(photo, /** @type {any} */ (edges), { page: [1e300, 1e-300], findLines: false }), /^option `page` is \[1e300, 1e-300\], but/],
    [() => direct.fit(bent, { lambda: /** @type {any} */ ([1, NaN, 'x', []]) }), /^option `lambda` is \[1, NaN, "x", …\], but/],
    [() => direct.writeSvg(/** @type {any} */ ({ sheets: 5 })), /^the drawing must be one that `pattern` gave/],
    [() => direct.fit(/** @type {any} */ ('image.png')), /^the input must be an image/],
    [() => direct.pattern(bent, /** @type {any} */ ({ nothingLikeIt: 1 })), /there are only (?!.*\bpaper\b).*stock/],
  ];
  for (const [call, message] of cases) assert.throws(call, { name: 'DevelopableError', message });
});

test('no figure or message is not a number where a mesh is all in one place, on one line or too large', () => {
  const { positions, triangles } = direct.readMesh(direct.writePly(lattice(12, 12, plane)));
  const same = new Float64Array(positions.length).fill(3);
  /** @type {Record<string, Float64Array>} */
  const shapes = {
    'one place': same,
    origin: new Float64Array(positions.length),
    'one line': positions.map((x, i) => (i % 3 === 0 ? x : 0)),
    slanted: positions.map((_, i) => positions[i - (i % 3)]),
    huge: positions.map((x) => x * 1e300),
    tiny: positions.map((x) => x * 1e-300),
  };
  for (const [name, places] of Object.entries(shapes)) {
    const mesh = { positions: places, triangles };
    for (const call of /** @type {const} */ (['fitMesh', 'analyze', 'patches', 'rulings', 'unroll', 'pattern', 'sampleMesh'])) {
      try {
        const found = /** @type {(mesh: any) => unknown} */ (direct[call])(mesh);
        const figures = JSON.stringify(found, (_, value) => (typeof value === 'number' && Number.isNaN(value) ? 'NaN' : ArrayBuffer.isView(value) ? undefined : value));
        assert.doesNotMatch(figures, /NaN/, `${call} of ${name}`);
      } catch (error) {
        if (!(error instanceof direct.DevelopableError)) throw error;
        assert.notEqual(error.code, 'TRAP', `${call} of ${name}: ${error.message}`);
        assert.doesNotMatch(error.message, /NaN|\binf\b|\d\.?\d{20}/, `${call} of ${name}`);
      }
    }
  }
});

test('where no cut lays a surface flat, the command says that flat faces stand for it, or why there are none', async () => {
  await writeFile(join(folder, 'dome.obj'), direct.writeObj(lattice(12, 12, (x, y) => -0.08 * ((x - 5.5) ** 2 + (y + 4.8) ** 2))));
  const dome = 'pattern dome.obj -o o.svg --max-strain 1e-7 --resolution 20';
  await refuses(folder, [[`${dome} --faces 0`, /cannot be laid flat: its outline/, 3]]);
  const said = /^developable: (\d+) flat faces stand for dome\.obj, 0\.\d+ mm from it \(root mean square\): (.*)$/m;
  const [, many, why] = said.exec((await run(folder, dome)).stderr) ?? [];
  assert.ok(Number(many) > 400 && Number(many) <= 500 && why.includes('no cut lays it flat'), `${many}: ${why}`);
  const [, few, wanted] = said.exec((await run(folder, `${dome} --faces 40`)).stderr) ?? [];
  assert.ok(Number(few) > 30 && Number(few) <= 40 && wanted === 'as --faces says', `${few}: ${wanted}`);
});
