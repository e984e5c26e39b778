/** The Node command. */
import assert from 'node:assert/strict';
import { mkdir, readFile, readdir, readlink, symlink, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { PassThrough } from 'node:stream';
import { test } from 'node:test';
import { commands } from '../../pkg/cli/commands.js';
import { writeWhole } from '../../pkg/cli/files.js';
import { flagOf, sections } from '../../pkg/cli/flags.js';
import * as direct from '../../pkg/direct.js';
import { OPTIONS } from '../../pkg/options.js';
import { command, parse, refuses, run, runProcess, silent, succeeds, temporaryFolder } from './support/command.mjs';
import { cylinder, deviation, endless, image, lattice, noisy, plane } from './support/shapes.mjs';
import { until } from './support/waiting.mjs';

await Promise.all([direct.init(), direct.load('files')]);
const folder = await temporaryFolder();
const ramp = image(24, 20, plane);
const rough = image(40, 30, noisy(cylinder(40), 0.4));
const hex = lattice(22, 26, plane, 0.5);
hex.heights[3] = 0;
hex.heights[7] = NaN;

await writeFile(join(folder, 'ramp.npy'), direct.writeImage(ramp));
await writeFile(join(folder, 'rough.npy'), direct.writeImage(rough));
await writeFile(join(folder, 'ramp.png'), direct.writeImage({ ...ramp, pixelSize: 0.5 }, { format: 'png' }));
await writeFile(join(folder, 'hex.npy'), direct.writeImage(hex));
await writeFile(join(folder, 'hex.png'), direct.writeImage({ width: 26, height: 22, data: hex.heights }, { format: 'png' }));
await writeFile(join(folder, 'endless.npy'), direct.writeImage(endless(300).input));
await writeFile(join(folder, 'text.npy'), 'hello');
const mask = new Uint8Array(480).fill(255);
mask.fill(0, 0, 30);
await writeFile(join(folder, 'mask.png'), direct.writeImage({ width: 24, height: 20, data: mask, noData: 0 }, { format: 'png' }));
await writeFile(join(folder, 'mask.npy'), direct.writeImage({ width: 24, height: 20, data: mask }));

/** @param {string} name */
const load = async (name) => direct.read(await readFile(join(folder, name)));
/** @param {string[]} args */
const fit = (...args) => run(folder, ['fit', ...args]);
/** @param {Promise<{ status: number | null, stdout: string, stderr: string }>} running */
async function silently(running) {
  assert.deepEqual(await running, silent);
}
/** @param {string} args */
const report = async (args) => {
  await silently(fit(...args.split(' '), '-o', 'r.npy', '--report', 'r.json'));
  return JSON.parse(await readFile(join(folder, 'r.json'), 'utf8'));
};

test('help and version', async () => {
  const help = await run(folder, ['--help']);
  assert.deepEqual([help.status, help.stderr], [0, '']);
  assert.deepEqual(await run(folder, ['help']), help);
  const { version } = JSON.parse(await readFile(new URL('../../pkg/package.json', import.meta.url), 'utf8'));
  assert.deepEqual(await runProcess(folder, ['--version']), { status: 0, stdout: `${version}\n`, stderr: '' });
});

test('each command has a help of its own, with its flags, an example and how it can end', async () => {
  const { stdout: overview } = await run(folder, ['--help']);
  /** @type {Record<string, import('../../pkg/cli/flags.js').FlagInfo>} */
  const infos = Object.assign({}, ...Object.values(sections).map((section) => section.flags));
  const every = Object.keys(infos);
  for (const [name, { flags, examples }] of Object.entries(commands)) {
    assert.match(overview, new RegExp(`^  ${name} +\\w`, 'm'));
    const help = await run(folder, [name, '--help']);
    assert.deepEqual([help.status, help.stderr], [0, '']);
    assert.deepEqual(await run(folder, ['help', name]), help);
    assert.ok(help.stdout.startsWith(`Usage: developable ${name} `), help.stdout);
    const told = [...help.stdout.matchAll(/^ {2}(?:-\w, )?--([\w-]+)/gm)].map((match) => match[1]);
    assert.deepEqual(told.toSorted(), [...flags].sort());
    for (const stray of every.filter((flag) => !told.includes(flag))) {
      const args = infos[stray].value === undefined ? [`--${stray}`] : [`--${stray}`, 'x'];
      const message = new RegExp(`^--${stray} is not for "${name}"\\nTry "developable ${name} --help"`);
      assert.throws(() => parse([name, ...args]), { status: 2, message });
    }
    assert.match(help.stdout, /Exit status: 0 .*\n.*2 for wrong usage/);
    // What is wrong with a value leads to the same help.
    for (const flag of flags.filter((one) => infos[one].value !== undefined)) {
      assert.throws(() => parse([name, `--${flag}=`]), { status: 2, message: new RegExp(`--${flag} is empty.*\\nTry "developable ${name} --help"`) });
    }
    for (const example of examples) {
      assert.ok(help.stdout.includes(`  developable ${example}\n`));
      parse(example.split(' ')); // which throws where it would be refused
    }
    assert.ok(help.stdout.split('\n').every((line) => line.length <= 80), name);
  }
  assert.ok(overview.split('\n').every((line) => line.length <= 80));
  // All that a solve can be told can be told here.
  for (const option of Object.keys(OPTIONS.solver)) {
    assert.ok(every.includes(flagOf(option)?.slice(2) ?? ''), option);
  }
});

test('patches and rulings are told, and drawn', async () => {
  const folds = image(40, 40, (x) => Math.abs(x - 20));
  await writeFile(join(folder, 'tent.npy'), direct.writeImage(folds));
  const { status, stdout, stderr } = await run(folder, ['patches', 'tent.npy', '--lambda', 'big']);
  assert.deepEqual([status, stderr], [0, '']);
  const map = JSON.parse(stdout);
  // Two planes of 20 by 40 at 45 degrees, less what lies between the lattice's border and the image's.
  assert.deepEqual([map.patches.length, map.creases.length], [2, 1]);
  for (const { area } of map.patches) assert.ok(Math.abs(area / (20 * 40 * Math.SQRT2) - 1) < 0.12, `${area}`);
  assert.ok(Math.abs(map.creases[0].fold - Math.PI / 2) < 0.05);
  await silently(run(folder, ['patches', 'tent.npy', '--lambda', 'big', '-o', 'p.json']));
  assert.equal(await readFile(join(folder, 'p.json'), 'utf8'), stdout);

  await silently(run(folder, ['patches', 'tent.npy', '--as-is', '-o', 'p.npy', '--report', 'q.json']));
  const { width, height, data } = await load('p.npy');
  const report = JSON.parse(await readFile(join(folder, 'q.json'), 'utf8'));
  assert.deepEqual([width, height], [report.cols, report.rows]);
  assert.deepEqual([...new Set(data)].filter((label) => label >= 0).sort(), [0, 1]);

  await silently(run(folder, ['patches', 'tent.npy', '-o', 'p.obj']));
  const lines = (await readFile(join(folder, 'p.obj'), 'utf8')).split('\n').filter((line) => line.startsWith('v '));
  const colours = new Set(lines.map((line) => line.split(' ').slice(4).join(' ')));
  assert.equal(colours.size, 2);
  const bare = await run(folder, ['patches', 'tent.npy', '--as-is', '-o', 'p.ply']);
  assert.deepEqual([bare.status, /--as-is of an image has no mesh/.test(bare.stderr)], [2, true]);

  // The rulings of a cylinder about an axis along y are parallel to it.
  await writeFile(join(folder, 'tube.npy'), direct.writeImage(image(40, 40, cylinder(40))));
  await silently(run(folder, ['rulings', 'tube.npy', '--as-is', '-o', 'r.obj', '--report', 'r.json', '--separation', '5']));
  const ruled = JSON.parse(await readFile(join(folder, 'r.json'), 'utf8'));
  assert.ok(ruled.lines.length >= 4);
  const obj = await readFile(join(folder, 'r.obj'), 'utf8');
  const points = [...obj.matchAll(/^v (\S+) (\S+) (\S+)$/gm)].map((match) => match.slice(1).map(Number));
  const drawn = [...obj.matchAll(/^l (.*)$/gm)].map(([, numbers]) => numbers.split(' ').map((n) => points[Number(n) - 1]));
  assert.deepEqual(drawn, ruled.lines.map((/** @type {{ points: number[][] }} */ line) => line.points));
  const sparse = await run(folder, ['rulings', 'tube.npy', '--as-is', '--separation', '20']);
  assert.ok(JSON.parse(sparse.stdout).lines.length < ruled.lines.length);
  await refuses(folder, [['rulings tube.npy --as-is --min-confidence 7', /--min-confidence is 7/]]);
  const analysis = await run(folder, ['analyze', 'tube.npy', '--as-is']);
  assert.ok(JSON.parse(analysis.stdout).input.vertices > 0);
});

test('a plane comes back in each format, with nothing said in a pipe', async () => {
  await silently(fit('ramp.npy', '-o', 'out.npy', '--lambda', 'big'));
  const npy = await load('out.npy');
  assert.deepEqual([npy.width, npy.height, npy.dataType], [24, 20, 'f64']);
  assert.ok(deviation(npy.data, ramp.data) < 1e-9);

  await silently(fit('ramp.png', '--output', 'OUT.PNG', '--lambda', 'big'));
  const png = await load('OUT.PNG');
  assert.deepEqual([png.format, png.pixelSize], ['png', 0.5]);
  assert.ok(deviation(png.data.map((v) => v * png.heightScale), ramp.data) < 1e-3);

  await silently(fit('ramp.npy', '-o', 'out.obj', '--lambda', 'big'));
  const vertices = [...(await readFile(join(folder, 'out.obj'), 'utf8')).matchAll(/^v (\S+) (\S+) (\S+)$/gm)];
  assert.ok(vertices.length > 400);
  assert.ok(vertices.map((v) => v.slice(1).map(Number)).every(([x, y, z]) => Math.abs(z - plane(x, y)) < 1e-9));
});

test('the options reach the solver', async () => {
  const plain = await report('rough.npy');
  assert.deepEqual([plain.energy, plain.lambda, plain.stopReason, plain.scale < 0.1], ['huber', plain.lambda, 'gap', true]);
  assert.ok(plain.lambdaChoice !== undefined && plain.lambda === (await report('rough.npy --lambda auto --energy huber')).lambda);
  assert.ok(plain.gap <= 0.01);
  assert.equal((await report('rough.npy --lambda big')).lambda, 1e7);
  assert.equal((await report('rough.npy --lambda small')).lambda, 1e5);
  assert.equal((await report('rough.npy --lambda 2.5e5')).lambda, 2.5e5);
  assert.ok((await report('rough.npy --gap 1e-4')).gap <= 1e-4);
  const paper = await report('rough.npy --schedule paper');
  assert.equal(paper.stopReason, 'residuals');
  assert.equal((await report('rough.npy --no-normalize --lambda 1')).scale, 1);
  const coarse = await report('rough.npy --spacing 2');
  assert.ok(Math.abs(plain.interior / coarse.interior - 4) < 1);
});

test('running out of iterations is told, and no failure', async () => {
  const { status, stdout, stderr } = await fit('rough.npy', '-o', 'out.npy', '--max-iterations', '2', '--gap=1e-6');
  assert.deepEqual([status, stdout], [0, '']);
  assert.match(stderr, /warning.*2 iterations.*--max-iterations/);
});

test('heights are scaled', async () => {
  await silently(fit('ramp.npy', '-o', 'out.npy', '--height-scale', '2.5'));
  assert.ok(deviation((await load('out.npy')).data, ramp.data.map((z) => 2.5 * z)) < 1e-9);
});

test('a fold steeper than 45 degrees is solved as it is, a needle with wider pixels, and either is said', async () => {
  const rise = (/** @type {number} */ slope) => image(24, 20, (x) => slope * Math.min(x, 24 - x));
  for (const [slope, words, pixel] of /** @type {const} */ ([[4, /: assumed: pixels are 1 wide, .*steep/, 1], [400, /: assumed: pixels are 700 wide: .*too steep/, 700]])) {
    await writeFile(join(folder, 'steep.npy'), direct.writeImage(rise(slope)));
    const guessed = await fit('steep.npy', '-o', 'guessed.npy');
    assert.equal(guessed.status, 0, guessed.stderr);
    assert.match(guessed.stderr, words);
    assert.match(guessed.stderr, /--pixel-size decides it/);
    await silently(fit('steep.npy', '--pixel-size', String(pixel), '-o', 'told.npy'));
    assert.deepEqual((await load('guessed.npy')).data, (await load('told.npy')).data);
  }
});

test('a mask or a value takes pixels out', async () => {
  for (const name of ['mask.png', 'mask.npy']) {
    await silently(fit('ramp.npy', '-o', 'out.npy', '--mask', name));
    const { data } = await load('out.npy');
    assert.ok(data.every((z, i) => Number.isNaN(z) === i < 30));
  }
  const marked = ramp.data.slice();
  marked[5] = -9999;
  await writeFile(join(folder, 'marked.npy'), direct.writeImage({ ...ramp, data: marked }));
  await silently(fit('marked.npy', '-o', 'out.npy', '--no-data', '-9999', '--bridge', 'none'));
  const { data } = await load('out.npy');
  assert.ok(data.every((z, i) => Number.isNaN(z) === (i === 5)));
});

test('an array on the lattice stays there', async () => {
  for (const name of ['hex.npy', 'hex.png']) {
    for (const output of ['out.npy', 'out.png']) {
      assert.equal((await fit(name, '-o', output, '--lattice', 'hex', '--spacing', '0.5', '--no-data', '0', '--bridge', 'none')).status, 0);
      const { width, height, data, heightScale } = await load(output);
      assert.deepEqual([width, height], [26, 22]);
      const found = data.map((z) => z * heightScale);
      // A PNG stores levels above the lowest height, so that its level 0 is another height.
      const expected = name === 'hex.png' ? hex.heights : hex.heights.map((z) => z || NaN);
      assert.ok(deviation(found, expected) < ((name + output).includes('png') ? 1e-3 : 1e-9));
    }
  }
  // Zero among the heights is one of them.
  await silently(fit('hex.npy', '-o', 'out.npy', '--lattice', 'hex', '--lambda', 'big'));
  assert.ok(!Number.isNaN((await load('out.npy')).data[3]));
  await silently(fit('hex.npy', '-o', 'out.obj', '--lattice', 'hex', '--lambda', 'big'));
});

test('wrong usage: status 2, what is wrong, and no output', async () => {
  await refuses(folder, [
    ['', /nothing to do/],
    ['solve ramp.npy -o x.npy', /unknown command 'solve'/],
    ['fit', /input is missing/],
    ['fit ramp.npy', /output is missing/],
    ['fit ramp.npy more.npy -o x.npy', /x\.npy.*several inputs/],
    ['fit ramp.npy -o x.jpg', /\.npy, \.png.*x\.jpg/],
    ['fit ramp.npy -o', /output/],
    ['fit ramp.npy -o x.npy --colour red', /unknown option '--colour'/],
    ['fit ramp.npy -o x.npy --lamda 3', /unknown option '--lamda' \(Did you mean --lambda\?\)/],
    ['ptches ramp.npy', /unknown command 'ptches' \(Did you mean patches\?\)/],
    ['help fti', /Did you mean fit\?/],
    ['fit ramp.npy -o x.npy --thresh 3', /unknown option '--thresh'/],
    // The option that was given is named, and no other.
    ['fit --stock a4 ramp.npy -o x.npy', /^developable: --stock is not for "fit"\n/],
    ['fit --paper ramp.npy -o x.xyz', /^developable: the output must end in/],
    ['fit ramp.npy -o --report r.json', /--output needs a value.*--report follows it/],
    ['fit ramp.npy -o x.npy --lambda huge', /--lambda.*small.*huge/],
    ['fit ramp.npy -o x.npy --lambda -3', /--lambda.*-3/],
    ['fit ramp.npy -o x.npy --gap 2', /--gap.*2/],
    ['fit ramp.npy -o x.npy --gap=', /--gap/],
    ['fit ramp.npy -o x.npy --max-iterations 1.5', /--max-iterations.*1\.5/],
    ['fit ramp.npy -o x.npy --spacing 0', /--spacing.*0/],
    ['fit ramp.npy -o x.npy --schedule fast', /--schedule.*default or paper.*fast/],
    ['fit ramp.npy -o x.npy --lattice cubic', /--lattice.*cubic/],
    ['fit ramp.npy -o x.npy --no-normalize=yes', /--no-normalize takes no value/],
    ['fit ramp.npy -o x.npy --report ./x.npy', /same file/],
    ['fit ramp.npy -o x.npy --report ./ramp.npy', /input and the report are the same file/],
    ['fit ramp.npy -o mask.npy --mask mask.npy', /mask and the output are the same file/],
    ['fit ramp.npy -o mask.npy --confidence mask.npy', /confidence and the output are the same file/],
    ['fit ramp.npy -o mask.npy --constraints mask.npy', /constraints and the output are the same file/],
    ['fit ramp.npy -o mask.npy --occlusions ./mask.npy', /occlusion mask and the output are the same file/],
    ['fit ramp.npy -o x.npy --energy isotropic', /--energy.*squaredNuclear.*isotropic/],
    ['fit ramp.npy -o x.npy --reweighting 1.5', /--reweighting.*1\.5/],
    ['fit ramp.npy -o x.npy --reweighting 99', /--reweighting.*99/],
    ['fit ramp.npy -o x.npy --tie-break 0', /--tie-break.*0/],
    ['fit ramp.npy -o x.npy --occlusion-threshold many', /--occlusion-threshold.*auto or a number.*many/],
    ['fit ramp.npy -o x.npy --occlusion-threshold -1', /--occlusion-threshold.*-1/],
    ['fit ramp.npy -o x.npy --threshold 1', /--threshold is not for "fit"/],
    ['fit ramp.npy -o x.npy --free 0', /--free.*--constraints/],
    ['design ramp.npy -o x.npy --constraints mask.npy', /--constraints is not for "design"/],
    ['design ramp.npy -o x.jpg', /x\.jpg/],
    ['occlusions ramp.npy -o x.obj', /\.png or \.npy.*x\.obj/],
    ['occlusions ramp.npy -o x.png --lambda 1', /--lambda is not for "occlusions"/],
    ['occlusions ramp.npy -o x.png --threshold -1', /--threshold.*-1/],
    ['occlusions ramp.npy', /output is missing/],
  ]);
  assert.ok(!(await readdir(folder)).some((name) => name.startsWith('x.')));
});

test('bad input: status 3, what is wrong, and no output', async () => {
  await mkdir(join(folder, 'directory.npy'));
  await writeFile(join(folder, 'cut.npy'), direct.writeImage(ramp).subarray(0, 1000));
  await writeFile(join(folder, 'tiny.npy'), direct.writeImage(image(2, 2, plane)));
  await refuses(folder, [
    ['fit missing.npy -o x.npy', /missing\.npy.*no such file/, 3],
    ['fit directory.npy -o x.npy', /directory\.npy.*folder/, 3],
    ['fit text.npy -o x.npy', /text\.npy/, 3],
    ['fit cut.npy -o x.npy', /cut\.npy/, 3],
    ['fit tiny.npy -o x.npy', /interior/, 3],
    ['fit ramp.npy -o x.npy --mask missing.png', /missing\.png/, 3],
    ['fit ramp.npy -o x.npy --mask rough.npy', /40.*30.*24.*20/, 3],
    ['fit ramp.npy -o x.npy --confidence rough.npy', /confidence has 40.*30.*24.*20/, 3],
    ['fit ramp.npy -o x.npy --constraints rough.npy', /constraints have 40.*30.*24.*20/, 3],
    ['fit ramp.npy -o x.npy --occlusions missing.png', /missing\.png/, 3],
    ['fit ramp.npy -o x.npy --occlusions many', /many.*no such file/, 3],
    ['fit ramp.npy -o x.npy --constraints ramp.npy', /every value is a constraint.*--free/, 3],
    ['fit ramp.npy -o nowhere/x.npy', /nowhere.*no such/, 3],
    ['fit ramp.npy -o x.npy --report nowhere/x.json', /nowhere.*no such/, 3],
    ['fit ramp.npy -o directory.npy', /directory\.npy.*it is a folder/, 3],
    ['fit ramp.npy -o x.npy --report directory.npy', /directory\.npy.*it is a folder/, 3],
    ['fit gone.npy -o done.npy --quiet', /^developable: cannot read gone\.npy: there is no such file or folder\n$/, 3],
  ]);
  assert.ok(!(await readdir(folder)).some((name) => name.startsWith('x.') || name.endsWith('.tmp')));
});

test('an output is replaced whole, through a link as well', async () => {
  await writeFile(join(folder, 'old.npy'), 'old');
  assert.equal((await fit('text.npy', '-o', 'old.npy')).status, 3);
  assert.equal(await readFile(join(folder, 'old.npy'), 'utf8'), 'old');
  await symlink('old.npy', join(folder, 'link.npy'));
  await silently(fit('ramp.npy', '-o', 'link.npy'));
  assert.equal(await readlink(join(folder, 'link.npy')), 'old.npy');
  assert.equal((await load('old.npy')).width, 24);
  assert.ok(!(await readdir(folder)).some((name) => name.endsWith('.tmp')));
});

test('a name may be as long as a name can be', async () => {
  const name = `${'n'.repeat(251)}.npy`;
  await silently(fit('ramp.npy', '-o', name));
  assert.equal((await load(name)).width, 24);
  const { status, stderr } = await fit('ramp.npy', '-o', `n${name}`);
  assert.equal(status, 3);
  assert.match(stderr, /too long/);
  assert.ok(!(await readdir(folder)).some((entry) => entry.endsWith('.tmp')));
});

test('nothing is left when one of several files cannot be written', async () => {
  const bytes = new TextEncoder().encode('whole');
  const files = ['a.npy', 'nowhere/b.json'].map((name) => ({ path: join(folder, name), bytes }));
  await assert.rejects(writeWhole(files, new AbortController().signal), { status: 3, message: /b\.json.*no such/ });
  await assert.rejects(writeWhole(files.slice(0, 1), AbortSignal.abort()), { name: 'AbortError' });
  assert.ok(!(await readdir(folder)).some((name) => name.includes('a.npy')));
  await writeWhole(files.slice(0, 1), new AbortController().signal);
  assert.equal(await readFile(join(folder, 'a.npy'), 'utf8'), 'whole');
});

for (const [signal, expected] of /** @type {const} */ ([['SIGINT', 130], ['SIGTERM', 143]])) {
  test(`${signal} ends the work with status ${expected} and leaves nothing`, async () => {
    await writeFile(join(folder, 'kept.npy'), 'kept');
    const endlessly = ['--gap', '1e-12', '--lambda', 'small', '--max-iterations', '1e9'];
    const args = ['fit', 'endless.npy', '-o', 'kept.npy', '--report', 'kept.json', ...endlessly];
    const tell = new URL('support/tell-start.mjs', import.meta.url).href;
    const { status, stdout, stderr } = await runProcess(folder, args, {
      program: [process.execPath, '--import', tell, command],
      channel: true,
      onStart: (child) => child.once('message', () => child.kill(signal)),
    });
    assert.deepEqual([status, stdout, stderr], [expected, '', '']);
    assert.equal(await readFile(join(folder, 'kept.npy'), 'utf8'), 'kept');
    assert.ok(!(await readdir(folder)).some((name) => name === 'kept.json' || name.endsWith('.tmp')));
  });
}

test('a terminal sees progress that never goes back, and what was made', async () => {
  const args = ['fit', 'endless.npy', '-o', 'tty.npy', '--max-iterations', '60', '--gap', '1e-9'];
  const { status, stderr } = await run(folder, args, { terminal: true });
  assert.equal(status, 0);
  const shown = [...stderr.matchAll(/\r\x1b\[Kfitting: (\d+) iterations, ([\d.]+) s/g)].map(([, ...numbers]) => numbers.map(Number));
  assert.ok(shown.length > 2, stderr);
  for (const k of [0, 1]) assert.deepEqual(shown.map((numbers) => numbers[k]), shown.map((numbers) => numbers[k]).sort((a, b) => a - b));
  assert.match(stderr, /tty\.npy: \d+ vertices, within [\d.]+ % of the optimum, [\d.]+ s\n/);
  assert.match(stderr, /warning/);
});

test('a terminal sees how far sheets are', async () => {
  const { status, stderr } = await run(folder, ['pattern', 'ramp.npy', '--as-is', '-o', 'far.svg', '--unit', 'mm'], { terminal: true });
  assert.equal(status, 0);
  const shown = [...stderr.matchAll(/\r\x1b\[Kcutting it into sheets: (\d+) %/g)].map(([, percent]) => Number(percent));
  assert.deepEqual(shown, shown.toSorted((a, b) => a - b));
  assert.equal(shown.at(-1), 100, stderr);
});

test('a terminal is told of each command that it went well, and with --quiet nobody is told anything but errors', async () => {
  /** @type {[string, RegExp][]} */
  const cases = [
    ['design pins.npy -o done.npy', /^done\.npy: \d+ vertices/m],
    ['occlusions ramp.npy -o done.png', /^done\.png: 0 vertices/m],
    ['analyze ramp.npy --as-is -o done.json', /^done\.json: figures of ramp\.npy/m],
    ['patches ramp.npy --as-is -o done.json', /^done\.json: 1 patches, 0 creases/m],
    ['rulings rough.npy --as-is -o done.json', /^done\.json: \d+ rulings/m],
    ['unroll ramp.npy --as-is -o done.obj', /^done\.obj: \d+ triangles laid flat, strained by/m],
    ['pattern ramp.npy --as-is -o done.svg --unit mm', /^done\.svg: 1 sheet, together \d+ × \d+ mm/m],
    ['dewarp ramp.npy --as-is --texture photo.png -o done.png', /^done\.png: \d+ × \d+ pixels/m],
  ];
  await writeFile(join(folder, 'pins.npy'), direct.writeImage({ ...ramp, data: ramp.data.map((z, i) => (i % 7 === 0 ? z : NaN)) }));
  await writeFile(join(folder, 'photo.png'), direct.writeImage({ width: 24, height: 20, data: mask, noData: 0 }, { format: 'png' }));
  for (const [args, told] of cases) {
    const { stderr } = await succeeds(folder, args, { terminal: true });
    assert.match(stderr.replace(/.*\r\x1b\[K/g, ''), told, args);
    assert.equal((await run(folder, `${args} --quiet --force`, { terminal: true })).stderr, '', args);
  }
  await silently(fit('rough.npy', '-o', 'out.npy', '--max-iterations', '2', '--gap=1e-6', '--quiet'));
});

test('- is standard input and output', async () => {
  const input = await readFile(join(folder, 'ramp.npy'));
  const told = await run(folder, ['info', '-'], { input });
  assert.match(told.stdout, /^size: +24 × 20 pixels$/m);
  // What it holds says how it is taken.
  const mesh = direct.writeObj(lattice(12, 12, plane));
  assert.match((await run(folder, ['info', '-'], { input: mesh })).stdout, /^vertices: +144$/m);
  await silently(run(folder, ['fit', '-', '-o', 'piped.npy'], { input }));
  await silently(fit('ramp.npy', '-o', 'named.npy'));
  assert.deepEqual(await readFile(join(folder, 'piped.npy')), await readFile(join(folder, 'named.npy')));
  const written = await run(folder, ['fit', 'ramp.npy', '-o', '-', '--to', 'obj']);
  assert.match(written.stdout, /^v -?[\d.e-]+ /m);
  assert.equal(written.stderr, '');
  const line = `"$0" "$1" fit - -o - --to .npy < ramp.npy > both.npy`;
  await silently(runProcess(folder, ['-c', line, process.execPath, command], { program: ['sh'] }));
  assert.deepEqual(await readFile(join(folder, 'both.npy')), await readFile(join(folder, 'named.npy')));
  await refuses(folder, [
    ['fit - -o -', /--to says what is written to standard output: \.npy/],
    ['fit - -o - --to jpg', /output must end in .*"-\.jpg"/],
    ['fit - -o x.npy --to npy', /--to says what is written to standard output: leave it out/],
    ['fit - -o - --to npy --report -', /output and the report are the same file/],
    ['patches - --report -', /output and the report are the same file/],
    ['rulings - --as-is --report -', /output and the report are the same file/],
    ['info - ramp.npy', /- is standard input of one input with one output/],
    ['fit - -o piped/', /- is standard input of one input with one output/],
  ], { input });
});

test('an interruption ends the wait for standard input', async () => {
  for (const args of [['info', '-'], ['fit', 'ramp.npy', '--mask', '-', '-o', 'never.npy']]) {
    const stopping = new AbortController();
    const input = new PassThrough();
    const waiting = run(folder, args, { input, signal: stopping.signal });
    await until('standard input is read', () => input.listenerCount('readable') > 0);
    stopping.abort();
    assert.deepEqual(await waiting, { status: 130, stdout: '', stderr: '' });
  }
});

test('a name that is not UTF-8 is refused in words that say so', { skip: process.platform !== 'linux' }, async () => {
  const shell = (/** @type {string} */ line) => runProcess(folder, ['-c', line, process.execPath, command], { program: ['sh'] });
  const read = await shell(`cp ramp.npy "$(printf 'r\\351.npy')" && exec "$0" "$1" fit "$(printf 'r\\351.npy')" -o x.npy`);
  assert.deepEqual([read.status, /its name is not UTF-8/.test(read.stderr)], [3, true], read.stderr);
  const written = await shell(`exec "$0" "$1" fit ramp.npy -o "$(printf 'w\\351.npy')"`);
  assert.deepEqual([written.status, /its name is not UTF-8/.test(written.stderr)], [3, true], written.stderr);
  assert.ok(!(await readdir(folder)).some((name) => name.startsWith('w')));
});

test('a shell completes commands and flags', async (t) => {
  const { stdout } = await run(folder, ['completion', 'bash']);
  const ask = async (/** @type {string[]} */ ...words) => {
    const script = `${stdout}\nCOMP_WORDS=(${words.map((word) => `'${word}'`).join(' ')}); COMP_CWORD=${words.length - 1}; _developable; printf '%s\\n' "\${COMPREPLY[@]}"`;
    return (await runProcess(folder, ['-c', script], { program: ['bash'] })).stdout.trim().split('\n');
  };
  if (await ask('developable', 'f').then(() => false, () => true)) return t.skip('there is no bash');
  assert.deepEqual(await ask('developable', 'pa'), ['patches', 'pattern']);
  assert.deepEqual(await ask('developable', 'fit', 'a.npy', '--lam'), ['--lambda']);
  assert.deepEqual(await ask('developable', 'unroll', '--stock'), ['']);
  for (const shell of ['zsh', 'fish']) assert.match((await run(folder, ['completion', shell])).stdout, /occlusion-threshold/);
  assert.equal((await run(folder, ['completion', 'tcsh'])).status, 2);
});
