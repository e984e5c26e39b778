/** One name for one thing: flags are named as the package's options, and values are of any case. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { sections } from '../../pkg/cli/flags.js';
import * as direct from '../../pkg/direct.js';
import { OPTIONS, optionsOf } from '../../pkg/options.js';
import { parse } from './support/command.mjs';
import { image, plane } from './support/shapes.mjs';

await Promise.all([direct.init(), direct.load('files')]);
const flags = Object.values(sections).flatMap((section) => Object.keys(section.flags));
/** @param {string} option */
const kebab = (option) => option.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

test('a flag has the name of its option, in lower case with hyphens', () => {
  /** Options of calls that the command makes, and that nobody gives it: results of other calls, and what it chooses itself. */
  const own = {
    solver: ['normalize'], // --no-normalize
    fitMesh: ['held', 'signal', 'onAbort', 'onProgress'],
    occlusions: ['normalize'],
    sampleMesh: [],
    depths: ['photo', 'camera'], // --texture and --photo-camera
    analyze: ['reference'],
    patches: [],
    rulings: [],
    // Their `tolerance` ends iterations; the flag of this name is that of fits.
    unroll: ['onProgress'],
    pattern: ['refold', 'onProgress'],
    dewarp: ['transfer', 'grid', 'extent', 'camera'],
    dewarpPage: ['film35', 'ruler', 'centre', 'findLines', 'traceEdges', 'doubtfulOutline', 'grid', 'transfer', 'onProgress'],
  };
  for (const [call, without] of Object.entries(own)) {
    const options = Object.keys(OPTIONS[/** @type {keyof typeof OPTIONS} */ (call)]);
    const missing = options.filter((option) => !flags.includes(kebab(option)));
    assert.deepEqual(missing.sort(), without.sort(), call);
  }
  // What an input may have besides its heights.
  for (const property of ['mask', 'noData', 'confidence', 'constraints', 'occlusions', 'pixelSize', 'heightScale', 'spacing', 'unit']) {
    assert.ok(flags.includes(kebab(property)), property);
  }
});

test('values are of any case, in the command and in the package', () => {
  for (const [args, lower] of [
    ['fit a.npy -o x.npy --lambda AUTO', 'fit a.npy -o x.npy --lambda auto'],
    ['fit a.npy -o x.npy --energy HUBER --schedule Paper', 'fit a.npy -o x.npy --energy huber --schedule paper'],
    ['fit a.npy -o x.npy --energy SquaredNuclear', 'fit a.npy -o x.npy --energy squaredNuclear'],
    ['fit a.npy -o x.npy --occlusion-threshold Auto --bridge NONE', 'fit a.npy -o x.npy --occlusion-threshold auto --bridge none'],
    ['dewarp a.npy --texture p.png -o x.png --lattice HEX --unit MM', 'dewarp a.npy --texture p.png -o x.png --lattice hex --unit mm'],
    ['pattern a.npy -o x.svg --stock A4', 'pattern a.npy -o x.svg --stock a4'],
    ['dewarp a.npy --texture p.png -o x.png --lattice hex --shape CYLINDER', 'dewarp a.npy --texture p.png -o x.png --lattice hex --shape cylinder'],
    ['dewarp p.png --edges e.json -o x.png --page Letter', 'dewarp p.png --edges e.json -o x.png --page letter'],
  ]) {
    assert.deepEqual(parse(args.split(' ')), parse(lower.split(' ')), args);
  }
  assert.deepEqual(optionsOf('solver', { lambda: 'AUTO', energy: 'squarednuclear', schedule: 'Default' }), { lambda: 'auto', energy: 'squaredNuclear', schedule: 'default' });
  assert.deepEqual(optionsOf('pattern', { stock: 'A4' }), { stock: 'a4' });
  assert.deepEqual(optionsOf('sampleMesh', { view: 'Best-Fit' }), { view: 'best-fit' });
  assert.equal(direct.fit(image(9, 9, plane), { lambda: /** @type {any} */ ('Big') }).report.lambda, 1e7);
  assert.throws(() => optionsOf('solver', { lambda: 'huge' }), { message: /small, medium, big, auto/ });
});

test('no bridges, and the threshold of the authors, have one spelling each in the command and the package, and more', () => {
  for (const none of [false, 0, 'none', 'off', 'OFF']) assert.deepEqual(optionsOf('solver', { bridge: none }), { bridge: false });
  for (const none of ['none', 'off', '0', 'None', '0.0']) {
    assert.deepEqual(optionsOf('solver', { bridge: bridgeOf(none) }), { bridge: false }, none);
  }
  assert.deepEqual([optionsOf('solver', { bridge: true }), optionsOf('solver', { bridge: 3 })], [{ bridge: true }, { bridge: 3 }]);
  assert.throws(() => optionsOf('solver', { bridge: 'wide' }), { message: /`bridge`.*or none/ });
  // 4e4 is what the search for occlusions takes unless it is told otherwise.
  const torn = image(40, 40, (x, y) => plane(x, y) + (x > 20 ? 3000 : 0));
  const { occluded } = direct.fit(torn, { occlusionThreshold: 'auto' }).report;
  assert.ok(occluded > 0);
  assert.equal(occluded, direct.fit(torn, { occlusionThreshold: 4e4 }).report.occluded);
  assert.equal(direct.occlusions(torn).count, direct.occlusions(torn, { threshold: 4e4 }).count);
});

/** @param {string} text */
function bridgeOf(text) {
  const task = parse(['fit', 'a.npy', '-o', 'x.npy', '--bridge', text]);
  return 'bridge' in task ? task.bridge : undefined;
}
