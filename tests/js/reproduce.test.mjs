/** What the page copies of a result, as a command and as code: both are run here. */
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { promisify } from 'node:util';
import * as direct from '../../pkg/direct.js';
import { optionsOf } from '../../pkg/options.js';
import { asCode, asCommand } from '../../www/reproduce.js';
import { latticePositions } from '../../www/surface/lattice.js';
import { sidesOf } from '../../www/surface/triangles.js';
import { parse, succeeds, temporaryFolder } from './support/command.mjs';
import { image, lattice, plane } from './support/shapes.mjs';
import { pkg } from './support/paths.mjs';

/** @typedef {import('../../www/session.js').Input} Input */
/** @typedef {import('../../www/session.js').Settings} Settings */

await Promise.all([direct.init(), direct.load('files'), direct.load('images')]);
const folder = await temporaryFolder();
const FILE = "Tom's $HOME (1).tiff";
const ramp = image(24, 20, plane);
ramp.data[50] = 0;
await writeFile(join(folder, FILE), direct.writeImage(ramp, { format: 'tiff' }));
await writeFile(join(folder, '-ramp.npy'), direct.writeImage(ramp));

/** @type {Settings} */
const defaults = { lambda: 'auto', gap: 0.01, coarsening: 1, energy: 'huber', occlusionThreshold: undefined };
const stored = { width: 24, height: 20, data: ramp.data, pixelSize: 0.5, heightScale: -2, noData: 0, levels: false, guesses: '', coarsening: 1, range: 1 };
/** @type {Input} */
const opened = { name: "Tom's $HOME (1)", file: FILE, kind: 'TIFF, 32-bit floats', width: 24, height: 20, data: ramp.data, pixelSize: 0.5, heightScale: -2, stored };
const dashed = { ...opened, name: '-ramp', file: '-ramp.npy', stored: { ...stored, noData: /** @type {const} */ ('none') } };
const example = { ...opened, name: 'roof', file: undefined, kind: undefined, stored: undefined, example: { size: 24, noise: 0.02 } };

/** @param {Input} input @param {Partial<Settings>} [settings] */
const resultOf = (input, settings) => /** @type {import('../../www/session.js').Result} */ ({ input, settings: { ...defaults, ...settings } });

/** The arguments that a shell passes to `npx developable`. @param {string | null} line */
async function argumentsOf(line) {
  const { stdout } = await promisify(execFile)('sh', ['-c', `npx() { printf '%s\\0' "$@"; }; ${line}`]);
  const [program, ...args] = stdout.split('\0').slice(0, -1);
  assert.equal(program, 'developable');
  return args;
}

/** Runs code with the package, and returns the options of its fit. @param {string | null} code */
async function runCode(code) {
  assert.ok(code);
  const address = new URL(`file://${join(pkg, 'index.js')}`).href;
  await promisify(execFile)(process.execPath, ['--input-type=module', '-e', code.replace("'developable'", `'${address}'`)], { cwd: folder });
  return optionsOf('fit', JSON.parse(/fit\(input, (.*)\);/.exec(code)?.[1] ?? ''));
}

test('the command names the file, how it was read and the options, and runs', async () => {
  const args = await argumentsOf(asCommand(resultOf(opened, { coarsening: 2, lambda: 1e5, energy: 'nuclear', occlusionThreshold: 4e4 })));
  const { command, input, output, pixelSize, heightScale, noData, lambda, energy, gap, spacing, occlusionThreshold } = /** @type {any} */ (parse(args));
  assert.deepEqual(
    { command, input, output, pixelSize, heightScale, noData, lambda, energy, gap, spacing, occlusionThreshold },
    { command: 'fit', input: FILE, output: "Tom's $HOME (1)-developable.obj", pixelSize: 0.5, heightScale: -2, noData: 0, lambda: 1e5, energy: 'nuclear', gap: 0.01, spacing: 1, occlusionThreshold: 4e4 },
  );
  await succeeds(folder, args);
});

test('what the command assumes of a file by itself is not given to it', async () => {
  const squarePixels = { code: 'squarePixels', words: 'pixels of 0.25 × 0.5 are resampled to squares of 0.5', option: 'pixelSize' };
  const command = (/** @type {Partial<Input>} */ changed) => asCommand(resultOf({ ...opened, ...changed })) ?? '';
  // Given, it would keep the command from resampling: its surface would be twice as wide.
  assert.doesNotMatch(command({ assumptions: [squarePixels] }), /--pixel-size/);
  assert.match(command({ assumptions: [squarePixels] }), /--height-scale -2/);
  assert.match(command({ assumptions: [{ ...squarePixels, option: 'heightScale' }] }), /--pixel-size 0\.5 (?!--height-scale)/);
});

test('a file whose name begins with a dash is no flag', async () => {
  const args = await argumentsOf(asCommand(resultOf(dashed)));
  assert.deepEqual(args.slice(args.indexOf('--no-data'), args.indexOf('--no-data') + 2), ['--no-data', 'none']);
  await succeeds(folder, args);
});

test('the code of a file and of an example runs', async () => {
  assert.deepEqual(await runCode(asCode(resultOf(opened, { coarsening: 2 }))), { lambda: 'auto', energy: 'huber', gap: 0.01, spacing: 1 });
  assert.deepEqual(await runCode(asCode(resultOf(example))), { lambda: 'auto', energy: 'huber', gap: 0.01 });
  assert.match(asCode(resultOf(opened)) ?? '', /"noData":0/);
  assert.match(asCode(resultOf(example)) ?? '', /example\("roof", \{"size":24,"noise":0.02\}\)/);
});

test('nothing is copied of what neither can open', () => {
  /** @type {Input[]} */
  const inputs = [
    { ...example, example: undefined },
    { ...opened, depths: 'likely' },
    { ...opened, sampling: { mesh: { positions: new Float64Array(), triangles: new Uint32Array() }, options: {} } },
  ];
  for (const input of inputs) assert.deepEqual([asCommand(resultOf(input)), asCode(resultOf(input))], [null, null]);
  assert.equal(asCommand(resultOf(example)), null, 'the command makes no examples');
});

test('the size of a solid is that of its vertices, without the empty part of the image', () => {
  const field = lattice(22, 26, () => 3, 0.5);
  for (let i = 0; i < field.heights.length; i++) if (i % 26 > 10 || i > 4 * 26) field.heights[i] = NaN;
  assert.equal(Math.max(...sidesOf(latticePositions(field))), 10.5 * 0.5);
});
