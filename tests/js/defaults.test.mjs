/**
 * One meaning for each option of the schema: Rust knows it, an option that is given changes that option alone, and one that is
 * given its documented default changes nothing.
 */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { before, test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { OPTIONS } from '../../pkg/options.js';
import { wasmFile } from './support/paths.mjs';
import { gridMesh, image, noisy } from './support/shapes.mjs';

/**
 * @typedef {import('../../pkg/types.js').SolverOptions} SolverOptions
 * @typedef {import('../../pkg/schema/kinds.js').Options} Options
 */

/** A roof with a round ridge, and noise. @param {number} x @param {number} y */
const roof = (x, y) => 12 - 8 * Math.hypot((x - 24) / 24, 0.2) + 0.02 * y;
const scan = image(48, 36, noisy(roof, 0.15));
/** Pins of the same roof, free everywhere else. */
const design = {
  width: 48,
  height: 36,
  constraints: Float64Array.from(scan.data, (z, i) => (i % 48 % 9 === 1 && Math.floor(i / 48) % 8 === 1 ? z : NaN)),
};

/** A mesh of the same roof. */
const mesh = gridMesh(24, 18, (col, row) => [2 * col, 2 * row, scan.data[2 * row * 48 + 2 * col]]);

before(async () => {
  await direct.init(readFile(wasmFile));
  const file = (/** @type {string} */ name) => readFile(new URL(`../../pkg/wasm/${name}_bg.wasm`, import.meta.url));
  await direct.load({
    files: file('files'), meshes: file('meshes'), fitmesh: file('fitmesh'), unroll: file('unroll'), patterns: file('patterns'),
  });
});

/**
 * The defaults that the schema documents.
 * @param {Options} options
 * @returns {Record<string, any>}
 */
function documented(options) {
  const entries = Object.entries(options).map(([name, option]) => [name, option.default]);
  return Object.fromEntries(entries.filter(([, value]) => value !== undefined));
}

/**
 * What was minimised: the figures of a report that options decide.
 * @param {import('../../pkg/types.js').Report} report
 */
function minimised({ lambda, energy, reweighting, huber }) {
  const { bendRadius, flatness, creaseRadius } = huber ?? {};
  return { lambda, energy, reweighting, bendRadius, flatness, creaseRadius };
}

/**
 * Equal but for the time that it took.
 * @param {unknown} result
 * @param {unknown} expected
 * @param {string} name
 */
function alike(result, expected, name) {
  const timeless = (/** @type {unknown} */ value) => JSON.parse(JSON.stringify(value, (key, inner) => {
    if (key === 'seconds') return undefined;
    return ArrayBuffer.isView(inner) ? Array.from(/** @type {Float64Array} */ (inner), String) : inner;
  }));
  assert.deepEqual(timeless(result), timeless(expected), name);
}

test('a solver option that is given its default changes nothing', () => {
  const plain = direct.fit(scan);
  const { huber } = plain.report;
  assert.ok(huber && plain.report.energy === 'huber' && plain.report.lambdaChoice);
  // What else it has without them.
  const { bendRadius, flatness, creaseRadius } = huber;
  /** @type {Record<string, unknown>} */
  const defaults = { ...documented(OPTIONS.solver), spacing: 1, bendRadius, flatness, creaseRadius, creasePasses: 2 };
  for (const [name, value] of Object.entries(defaults)) alike(direct.fit(scan, { [name]: value }), plain, name);
  alike(direct.fit(scan, { bridge: 4 }), plain, 'bridge');
  alike(direct.fit(scan, defaults), plain, 'all at once');
  alike(direct.fit(design, { tieBreak: 0.01, lambda: 'auto', energy: 'nuclear' }), direct.fit(design), 'tieBreak');
  const named = [...Object.keys(defaults), 'tieBreak', 'occlusionThreshold', 'tolerance'];
  assert.deepEqual(Object.keys(OPTIONS.solver).sort(), named.sort(), 'an option is missing from this test');
});

test('a solver option that is given changes no other', () => {
  const plain = minimised(direct.fit(scan).report);
  /** @type {[SolverOptions, Partial<typeof plain>][]} */
  const cases = [
    [{ lambda: 3e5 }, { lambda: 3e5 }],
    [{ lambda: 'big' }, { lambda: 1e7 }],
    [{ schedule: 'paper' }, {}],
    [{ gap: 0.2 }, {}],
    [{ maxIterations: 30 }, {}],
    [{ energy: 'nuclear' }, { energy: 'nuclear', bendRadius: undefined, flatness: undefined, creaseRadius: undefined }],
    [{ bendRadius: 0.37 }, { bendRadius: 0.37 }],
    [{ flatness: 0.63 }, { flatness: 0.63 }],
    [{ creaseRadius: 0.031 }, { creaseRadius: 0.031 }],
    [{ creasePasses: 0 }, {}],
    [{ occlusionThreshold: 1e12 }, {}],
    [{ bridge: false }, {}],
  ];
  for (const [given, changed] of cases) {
    const found = minimised(direct.fit(scan, given).report);
    const kept = { ...plain, ...changed };
    // What was found with the noise's λ is not known of another one.
    // λ is searched for with the energy that is asked for.
    if (given.energy !== undefined) kept.lambda = found.lambda;
    if (given.lambda !== undefined) for (const name of /** @type {const} */ (['bendRadius', 'flatness', 'creaseRadius'])) kept[name] = found[name];
    assert.deepEqual(found, kept, JSON.stringify(given));
  }
  assert.equal(direct.fit(scan, { lambda: 1e7, creasePasses: 1 }).report.huber?.creasePasses, 1, 'what is given is done');
});

test('the paper has a name, and what is given with it comes first', () => {
  const named = direct.fit(scan, { paper: true });
  alike(named, direct.fit(scan, { lambda: 'medium', energy: 'nuclear' }), 'paper');
  assert.deepEqual([named.report.lambda, named.report.energy], [1e6, 'nuclear']);
  const small = direct.fit(scan, { paper: true, lambda: 'small' }).report;
  assert.deepEqual([small.lambda, small.energy], [1e5, 'nuclear']);
});

test('options without an effect are refused by name', () => {
  /** @type {[object, RegExp][]} */
  const refused = [
    [{ energy: 'nuclear', flatness: 0.3 }, /flatness.*huber/],
    [{ energy: 'frobenius', bendRadius: 0.1 }, /bendRadius.*huber/],
    [{ paper: true, creaseRadius: 0.1 }, /creaseRadius.*huber/],
    [{ energy: 'nuclear', creasePasses: 2 }, /creasePasses.*huber/],
    [{ reweighting: 1 }, /reweighting.*huber/],
    [{ schedule: 'paper', gap: 0.01 }, /gap.*schedule/],
    [{ tieBreak: 0.01 }, /tieBreak.*leave it out/],
  ];
  for (const [options, message] of refused) {
    assert.throws(() => direct.fit(scan, options), (error) => {
      assert.ok(error instanceof direct.DevelopableError && error.code === 'OPTION', String(error));
      assert.match(error.message, message);
      return true;
    }, JSON.stringify(options));
  }
  assert.throws(() => direct.fit(design, { flatness: 0.3 }), /flatness.*design/);
  assert.ok(direct.fit(design, { flatness: 0.3, energy: 'huber' }).report.huber);
});

test('an option over a whole mesh that is given its default changes nothing, and another value nothing else', () => {
  const plain = direct.fitMesh(mesh);
  const defaults = { ...documented(OPTIONS.meshSolver), creasePasses: 2, held: new Uint8Array(mesh.positions.length / 3) };
  for (const [name, value] of Object.entries(defaults)) alike(direct.fitMesh(mesh, { [name]: value }), plain, name);
  assert.deepEqual(Object.keys(OPTIONS.meshSolver).sort(), Object.keys(defaults).sort());
  const others = { gap: 0.1, maxIterations: 20, bendRadius: 0.2, flatness: 0.6, creaseRadius: 0.03, creasePasses: 1 };
  for (const [name, value] of Object.entries(others)) {
    const { lambda, sigma } = direct.fitMesh(mesh, { [name]: value }).report;
    assert.deepEqual([lambda, sigma], [plain.report.lambda, plain.report.sigma], name);
  }
});

/** A folded card, which lies flat. */
const flatMesh = {
  positions: Float64Array.from([0, 0, 0, 9, 0, 4, 18, 0, 0, 0, 9, 0, 9, 9, 4, 18, 9, 0]),
  triangles: Uint32Array.from([0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4]),
};

/** @type {import('../../pkg/types.js').HeightImage | undefined} */
let heights;
const surface = () => (heights ??= direct.fit(image(48, 36, roof), { lambda: 1e7 }).image);
const photo = { width: 48, height: 36, data: new Uint8ClampedArray(4 * 48 * 36).fill(200) };

/** Calls by the names of their options. @type {Partial<Record<keyof typeof OPTIONS, (options?: any) => unknown>>} */
const calls = {
  occlusions: (options) => direct.occlusions(scan, options),
  analyze: (options) => direct.analyze(surface(), options),
  patches: (options) => direct.patches(surface(), options),
  picture: (options) => direct.picture(surface(), options),
  rulings: (options) => direct.rulings(surface(), options),
  unroll: (options) => direct.unroll(surface(), options),
  pattern: (options) => direct.pattern(surface(), options),
  analyzeMesh: (options) => direct.analyze(mesh, options),
  patchesMesh: (options) => direct.patches(flatMesh, options),
  rulingsMesh: (options) => direct.rulings(mesh, options),
  unrollMesh: (options) => direct.unroll(flatMesh, options),
  patternMesh: (options) => direct.pattern(flatMesh, options),
  sampleMesh: (options) => direct.sampleMesh(mesh, options),
  dewarp: (options) => direct.dewarp(surface(), photo, options),
  writePhoto: (options) => direct.writePhoto(photo, options),
  writeSvg: (options) => direct.writeSvg(direct.pattern(surface()), options),
  writePdf: (options) => direct.writePdf(direct.pattern(surface()), options),
  example: (options) => direct.example('cone', options),
};

/** What follows from the input: the lattice is as fine as the pixels. */
const found = { spacing: 1, resolution: 200 };

for (const [name, call] of Object.entries(calls)) {
  /** @type {Options} */
  const options = OPTIONS[/** @type {keyof typeof OPTIONS} */ (name)];
  test(`${name}: an option that is given its default changes nothing`, () => {
    const plain = call();
    const own = Object.entries(found).filter(([option]) => option in options && !/[mM]esh/.test(name));
    for (const [option, value] of [...Object.entries(documented(options)), ...own]) {
      alike(call({ [option]: value }), plain, option);
    }
  });
}

test('Rust knows each option of the schema', () => {
  const fits = { solver: (/** @type {any} */ options) => direct.fit(scan, options), meshSolver: (/** @type {any} */ options) => direct.fitMesh(mesh, options) };
  const samples = [1, true, 'a4', 'png', 'even', 'auto', 'nuclear', 'default', 'shaded', 'gaussian', '-z', [1, 1, 1], [0, 0, 9, 9], [[0, 0], [9, 0], [0, 9]], [[1, 2]], [true], () => {}];
  let count = 0;
  for (const [name, call] of Object.entries({ ...fits, ...calls })) {
    for (const [option, { kind }] of Object.entries(/** @type {Record<string, Options>} */ (OPTIONS)[name])) {
      // What any value is good for is checked and taken by JS.
      if (kind.must === '' || kind.type === 'object') continue;
      const value = samples.find((sample) => kind.take(sample) !== undefined);
      assert.notEqual(value, undefined, `${name}.${option}`);
      count += 1;
      try {
        call({ [option]: value });
      } catch (error) {
        // Other options or the input may be in its way.
        assert.ok(error instanceof direct.DevelopableError && !/there is no option/.test(error.message), `${name}.${option}: ${error}`);
      }
    }
  }
  assert.ok(count > 90, `${count} options`);
});
