/**
 * One meaning for each option: an option that is given changes that option alone, and an option that is given its
 * documented default changes nothing.
 */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { before, test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import { OPTIONS } from '../../pkg/options.js';
import { wasmFile } from './support/paths.mjs';
import { image, noisy } from './support/shapes.mjs';

/** @typedef {import('../../pkg/types.js').SolverOptions} SolverOptions */

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
const mesh = (() => {
  const [cols, rows] = [24, 18];
  const at = (/** @type {number} */ i) => [i % cols, Math.floor(i / cols)];
  const positions = Float64Array.from({ length: 3 * cols * rows }, (_, k) => {
    const [col, row] = at(Math.floor(k / 3));
    return [2 * col, 2 * row, scan.data[2 * row * 48 + 2 * col]][k % 3];
  });
  /** @type {number[]} */
  const triangles = [];
  for (let row = 0; row + 1 < rows; row++) {
    for (let col = 0; col + 1 < cols; col++) {
      const a = row * cols + col;
      triangles.push(a, a + 1, a + cols, a + 1, a + cols + 1, a + cols);
    }
  }
  return { positions, triangles: Uint32Array.from(triangles) };
})();

before(async () => {
  await direct.init(readFile(wasmFile));
  const file = (/** @type {string} */ name) => readFile(new URL(`../../pkg/wasm/${name}_bg.wasm`, import.meta.url));
  await direct.load({
    files: file('files'), meshes: file('meshes'), fitmesh: file('fitmesh'), unroll: file('unroll'), patterns: file('patterns'),
  });
});

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
  /** @type {Required<Omit<SolverOptions, 'tieBreak' | 'occlusionThreshold'>>} */
  const defaults = {
    paper: false, lambda: 'auto', schedule: 'default', gap: 0.01, maxIterations: 20000, normalize: true, energy: 'huber', reweighting: 0,
    spacing: 1, bridge: true, bendRadius: huber.bendRadius, flatness: huber.flatness, creaseRadius: huber.creaseRadius, creasePasses: 2,
  };
  for (const [name, value] of Object.entries(defaults)) alike(direct.fit(scan, { [name]: value }), plain, name);
  alike(direct.fit(scan, { bridge: 4 }), plain, 'bridge');
  alike(direct.fit(scan, defaults), plain, 'all at once');
  alike(direct.fit(design, { tieBreak: 0.01, lambda: 'auto', energy: 'nuclear' }), direct.fit(design), 'tieBreak');
  const named = [...Object.keys(defaults), 'tieBreak', 'occlusionThreshold'];
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
  const defaults = {
    lambda: 'auto', gap: 0.01, maxIterations: 1000, bendRadius: 0.1, flatness: 0.3, creaseRadius: 0.1, creasePasses: 2,
    held: new Uint8Array(mesh.positions.length / 3),
  };
  for (const [name, value] of Object.entries(defaults)) alike(direct.fitMesh(mesh, { [name]: value }), plain, name);
  assert.deepEqual(Object.keys(OPTIONS.meshSolver).sort(), Object.keys(defaults).sort());
  const others = { gap: 0.1, maxIterations: 20, bendRadius: 0.2, flatness: 0.6, creaseRadius: 0.03, creasePasses: 1 };
  for (const [name, value] of Object.entries(others)) {
    const { lambda, sigma } = direct.fitMesh(mesh, { [name]: value }).report;
    assert.deepEqual([lambda, sigma], [plain.report.lambda, plain.report.sigma], name);
  }
});

/**
 * The documented defaults of the calls that take a surface or a mesh; `undefined` for options that have none: what they name is not there without
 * them.
 * @type {Record<string, { call: (options?: object) => unknown, defaults: Record<string, unknown> }>}
 */
const calls = (() => {
  /** @type {import('../../pkg/types.js').HeightImage | undefined} */
  let heights;
  const surface = () => (heights ??= direct.fit(image(48, 36, roof), { lambda: 1e7 }).image);
  const patching = { bend: undefined, fold: 0.15, smallest: 0.005 };
  const unrolling = { tolerance: 1e-10, maxIterations: 500 };
  const drawing = {
    scale: 1, tabs: 0, marks: 0, kerf: 0, allowance: 0, thickness: undefined, innerRadius: undefined, kFactor: undefined, smoothing: 0.5,
    stock: undefined, assembly: false,
  };
  const photo = { width: 48, height: 36, data: new Uint8ClampedArray(4 * 48 * 36).fill(200) };
  return {
    occlusions: { call: (options) => direct.occlusions(scan, options), defaults: { threshold: 4e4, normalize: true, spacing: 1 } },
    analyze: { call: (options) => direct.analyze(surface(), options), defaults: { threshold: 1, reference: undefined, spacing: 1 } },
    patches: { call: (options) => direct.patches(surface(), options), defaults: { ...patching, spacing: 1 } },
    picture: {
      call: (options) => direct.picture(surface(), options),
      defaults: {
        ...patching, spacing: 1, style: 'shaded', light: undefined, curvature: 'gaussian', limit: undefined, width: undefined, extent: undefined,
      },
    },
    rulings: { call: (options) => direct.rulings(surface(), options), defaults: { separation: 10, confidence: 0.3, crease: 0.2, spacing: 1 } },
    unroll: { call: (options) => direct.unroll(surface(), options), defaults: { ...unrolling, spacing: 1 } },
    pattern: {
      call: (options) => direct.pattern(surface(), options),
      defaults: { ...patching, ...unrolling, ...drawing, gap: 0.005, maxStrain: 0.01, refold: false, spacing: 1 },
    },
    analyzeMesh: { call: (options) => direct.analyzeMesh(mesh, options), defaults: { threshold: 1 } },
    meshRulings: { call: (options) => direct.meshRulings(mesh, options), defaults: { separation: undefined, confidence: 0.3, crease: 0.2 } },
    unrollMesh: {
      call: (options) => direct.unrollMesh(flatMesh, options),
      defaults: { ...patching, ...unrolling, gap: 0.005, maxStrain: 0.01 },
    },
    patternMesh: {
      call: (options) => direct.patternMesh(flatMesh, options),
      defaults: { ...patching, ...unrolling, ...drawing, gap: 0.005, maxStrain: 0.01 },
    },
    sampleMesh: { call: (options) => direct.sampleMesh(mesh, options), defaults: { view: '-z', resolution: 200, spacing: undefined } },
    dewarp: {
      call: (options) => direct.dewarp(surface(), photo, options),
      defaults: {
        ...unrolling, spacing: 1, dots: undefined, map: true, grid: false, transfer: false, trim: false, deskew: false, crop: undefined, extent: undefined,
        camera: undefined,
      },
    },
    writePhoto: {
      call: (options) => direct.writePhoto(photo, options),
      defaults: { format: 'png', quality: undefined, dotsPerMillimetre: undefined, transfer: false },
    },
    writePdf: { call: (options) => direct.writePdf(direct.pattern(surface()), options), defaults: { stock: undefined } },
    example: { call: (options) => direct.example('cone', options), defaults: { size: 200, noise: 0.02, seed: 1 } },
  };
})();

/** A folded card, which lies flat. */
const flatMesh = {
  positions: Float64Array.from([0, 0, 0, 9, 0, 4, 18, 0, 0, 0, 9, 0, 9, 9, 4, 18, 9, 0]),
  triangles: Uint32Array.from([0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4]),
};

for (const [name, { call, defaults }] of Object.entries(calls)) {
  test(`${name}: an option that is given its default changes nothing`, () => {
    const plain = call();
    for (const [option, value] of Object.entries(defaults)) {
      if (value !== undefined) alike(call({ [option]: value }), plain, option);
    }
    const table = /** @type {Record<string, object>} */ (OPTIONS);
    assert.deepEqual(Object.keys(defaults).sort(), Object.keys(table[name]).sort(), 'an option is missing from this test');
  });
}
