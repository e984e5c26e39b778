/**
 * Whatever is passed to whichever function: it works, or there is an error of the package with a code, and the next call
 * works as if nothing had been.
 */
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import * as direct from '../../pkg/direct.js';
import * as promise from '../../pkg/index.js';
import { OPTIONS } from '../../pkg/options.js';
import { initSync, loadSync } from '../../pkg/sync.js';
import { boom, hostileValues, resizableBuffer, withGetter } from './support/hostile.mjs';
import { boxTo, cylinder, image, lattice } from './support/shapes.mjs';

await direct.init();
await direct.load('files', 'images', 'meshes', 'fitmesh', 'unroll', 'patterns');
after(promise.dispose);

const { DevelopableError } = direct;
const bent = { ...image(8, 8, cylinder(8)), mask: new Uint8Array(64).fill(1), noData: -1, pixelSize: 1, heightScale: 1 };
const hex = lattice(8, 8, cylinder(8));
const solvable = {
  ...bent,
  confidence: new Float64Array(64).fill(1),
  constraints: new Float64Array(64).fill(NaN),
  occlusions: new Uint8Array(64),
};
// Fewer heights are too few to find a cylinder.
const curled = { ...lattice(24, 24, cylinder(24)), origin: [0, 0], confidence: new Float64Array(576).fill(1) };
const shaded = {
  ...hex,
  origin: [0, 0],
  frame: { right: [1, 0, 0], up: [0, 1, 0], towards: [0, 0, 1] },
  colors: new Float32Array(192),
  uvs: new Float32Array(128),
  brokenEdges: new Uint8Array(64),
};
const mesh = {
  positions: new Float64Array([0, 0, 0, 9, 0, 1, 9, 9, 0, 0, 9, 1]),
  triangles: new Uint32Array([0, 1, 2, 0, 2, 3]),
  colors: new Float32Array(12),
  uvs: new Float32Array(8),
  textureOf: new Int32Array(2),
};
const photo = { width: 4, height: 4, data: new Uint8Array(64).fill(255) };
const barePhoto = { width: 40, height: 40, data: new Uint8Array(6400).fill(255) };
const pagePhoto = { ...barePhoto, film35: 26 };
// Straight ones, between which a page is flattened in half the time.
const edges = { top: [[5, 5], [35, 5]], bottom: [[5, 35], [35, 35]] };
const camera = { fx: 8, fy: 8, cx: 4, cy: 4, depthScale: 1, depth: 'planar' };
const npy = direct.writeImage(bent);
const ply = direct.writePly(hex);
const drawing = direct.pattern(hex);
const { positions, triangles } = direct.readMesh(ply);
const whole = { positions, triangles, confidence: new Float32Array(positions.length / 3).fill(1) };
// Whose best pattern is found at once; that of `whole` is searched for half a second.
const cube = { ...boxTo([30, 30, 30]), confidence: new Float32Array(8).fill(1) };

/**
 * What each function is called with when all is in order, the table of its options, the last argument, and some of them.
 * @type {Record<string, { args: Record<string, any>, options?: keyof typeof OPTIONS, given?: object }>}
 */
const calls = {
  fit: { args: { input: solvable }, options: 'solver' },
  fitCylinder: { args: { input: curled } },
  occlusions: { args: { input: bent }, options: 'occlusions' },
  read: { args: { bytes: npy }, options: 'read' },
  formatOf: { args: { bytes: npy } },
  npzArrays: { args: { bytes: npy } },
  writeImage: { args: { input: bent }, options: 'writeImage' },
  writeObj: { args: { input: shaded }, options: 'writeObj', given: { materials: 'a.mtl' } },
  writeMtl: { args: { picture: 'a.png' } },
  writePly: { args: { input: shaded } },
  writeStl: { args: { input: shaded } },
  writeGlb: { args: { input: shaded }, options: 'writeGlb', given: { texture: null } },
  readMesh: { args: { bytes: ply }, options: 'readMesh' },
  sampleMesh: { args: { mesh }, options: 'sampleMesh', given: { view: [-1, -2, -4], spacing: 0.5 } },
  fitMesh: { args: { mesh: whole }, options: 'meshSolver' },
  'analyze, of a mesh': { args: { mesh: whole }, options: 'analyzeMesh' },
  'patches, of a mesh': { args: { mesh: whole }, options: 'patchesMesh' },
  'rulings, of a mesh': { args: { mesh: whole }, options: 'rulingsMesh' },
  'unroll, of a mesh': { args: { mesh: whole }, options: 'unrollMesh' },
  'pattern, of a mesh': { args: { mesh: cube }, options: 'patternMesh' },
  recognizeMesh: { args: { mesh: whole } },
  backProject: { args: { input: bent, camera, known: { confidence: { ...bent, data: new Uint8Array(64).fill(2) }, turn: 90 } } },
  parseCamera: { args: { text: JSON.stringify(camera), images: [{ width: 8, height: 8 }] } },
  paint: { args: { input: shaded, picture: photo }, options: 'paint', given: { extent: [0, 0, 3, 4.5] } },
  analyze: { args: { input: hex }, options: 'analyze', given: { reference: hex, threshold: 2 } },
  patches: { args: { input: hex }, options: 'patches' },
  picture: { args: { input: hex }, options: 'picture', given: { style: 'patches', light: [1, 1, 1] } },
  rulings: { args: { input: hex }, options: 'rulings', given: { separation: 2 } },
  unroll: { args: { input: hex }, options: 'unroll' },
  pattern: { args: { input: hex }, options: 'pattern', given: { scale: 3, tabs: 4, assembly: true } },
  writeSvg: { args: { drawing }, options: 'writeSvg', given: { title: 'a <card> & more' } },
  writePdf: { args: { drawing }, options: 'writePdf', given: { title: 'card', stock: 'a4' } },
  writeDxf: { args: { drawing } },
  dewarp: { args: { input: bent, photo }, options: 'dewarp', given: { trim: true } },
  // Without a focal length: whatever stands for one that is none is passed over, and the page flattened each time.
  dewarpPage: { args: { photo: barePhoto, edges }, options: 'dewarpPage', given: { page: 'a4', light: 'keep' } },
  flattenPhoto: { args: { photo: pagePhoto, page: direct.dewarpPage(pagePhoto, /** @type {any} */ (edges)) }, options: 'flattenPhoto', given: { light: 'keep' } },
  describePage: { args: { report: direct.dewarpPage(pagePhoto, /** @type {any} */ (edges)).report } },
  findPage: { args: { photo: pagePhoto } },
  readPhoto: { args: { bytes: direct.writePhoto(photo) } },
  writePhoto: { args: { photo }, options: 'writePhoto', given: { format: 'pdf', dotsPerMillimetre: 2, title: 'A page' } },
  writeBook: { args: { pages: [{ picture: direct.writePhoto(photo, { format: 'jpeg' }), size: [210, 297] }] } },
  example: { args: { name: 'roof' }, options: 'example' },
};

/**
 * Arguments that differ from those in order in one place each.
 * @param {string} name
 * @param {readonly [string, unknown][]} values
 * @returns {Iterable<[string, unknown[]]>}
 */
function* hostileArguments(name, values) {
  const { args, options } = calls[name];
  const list = Object.values(args);
  for (const [i, [argument, value]] of Object.entries(args).entries()) {
    /** @param {unknown} other */
    const replaced = (other) => list.map((one, k) => (k === i ? other : one));
    for (const [what, hostile] of values) yield [`${argument} = ${what}`, replaced(hostile)];
    if (Object.getPrototypeOf(value) !== Object.prototype) continue;
    for (const key of Object.keys(value)) {
      for (const [what, hostile] of values) {
        yield [`${argument}.${key} = ${what}`, replaced({ ...value, [key]: hostile })];
      }
      yield [`${argument}.${key} throws`, replaced(withGetter(value, key, boom))];
    }
  }
  if (options === undefined) return;
  const short = { ...('maxIterations' in OPTIONS[options] && { maxIterations: 3 }), ...('findLines' in OPTIONS[options] && { findLines: false, traceEdges: false }) };
  for (const [what, hostile] of values) yield [`options = ${what}`, [...list, hostile]];
  for (const key of Object.keys(OPTIONS[options])) {
    for (const [what, hostile] of values) {
      // What a callback throws is its caller's own.
      if (key === 'onProgress' && typeof hostile === 'function') continue;
      // Work without end is no error; and what is handed over is gone.
      const own = key === 'transfer' ? structuredClone(list) : list;
      yield [`options.${key} = ${what}`, [...own, { ...short, [key]: hostile }]];
    }
    yield [`options.${key} throws`, [...list, withGetter({}, key, boom)]];
  }
}

/** @param {Record<string, any>} api */
function everyFunction(api) {
  const functions = Object.keys(api).filter((name) => typeof api[name] === 'function');
  const others = ['init', 'load', 'Solver', 'MeshSolver', 'DevelopableError', 'DevelopableWorker', 'open', 'draw', 'explorePattern', 'dispose'];
  assert.deepEqual(functions.filter((name) => !(name in calls) && !others.includes(name)), []);
  return Object.keys(calls);
}

/**
 * @param {string} call
 * @param {() => unknown} run
 */
async function survives(call, run) {
  try {
    await run();
  } catch (error) {
    assert.ok(error instanceof DevelopableError, `${call}: ${/** @type {Error} */ (error)?.stack ?? String(error)}`);
    assert.notEqual(error.code, 'TRAP', `${call}: ${error.message}`);
    assert.notEqual(error.code, undefined, call);
    assert.ok(error.message.length < 1000, `${call}: ${error.message.slice(0, 200)}`);
    assert.doesNotMatch(error.message, UNREADABLE, `${call}: ${error.message}`);
    for (const [, option] of error.message.matchAll(/(?<!unknown )option `(\w+)`/g)) assert.ok(names.has(option), `${call}: ${error.message}`);
  }
}

/** Names of all options, and of what arguments are and have. */
const names = new Set([
  ...Object.values(OPTIONS).flatMap((kinds) => Object.keys(kinds)),
  ...Object.values(calls).flatMap(({ args }) => Object.entries(args).flatMap(([name, value]) => [name, ...Object.keys(value)])),
  'example', 'picture',
]);

/**
 * What nobody writes: a number with a needless exponent, of 25 digits, without its name or as large as a counter goes; and what
 * a parser says of itself.
 */
const UNREADABLE = /\de0|\binf\b|\d\.?\d{25}|\de\+\d|NaN (?:long|%)|is -0\b(?![.\d])|4294967295|18446744073709551615|JsValue|invalid type|\bstruct |Construct/;

/** Without what took time. @param {any} result */
function timeless(result) {
  if (result?.report?.seconds) result.report.seconds = undefined;
  return result;
}

everyFunction(promise);
for (const name of everyFunction(direct)) {
  const [here, sent] = /** @type {any[]} */ ([direct, promise]).map((api) => api[name.split(',')[0]]);
  const { args, options, given } = calls[name];
  const inOrder = [...Object.values(args), ...(options && given ? [given] : [])];

  test(`${name} does the same in both APIs, and takes anything`, async () => {
    const does = async () => {
      if (name !== 'npzArrays') assert.deepEqual(timeless(await sent(...inOrder)), timeless(here(...inOrder)));
    };
    await does();
    for (const [what, args] of hostileArguments(name, hostileValues())) await survives(`${name}(${what})`, () => here(...args));
    // What JSON has goes to the worker as it is.
    const odd = hostileValues().filter(([, value]) => value !== null && ['object', 'function', 'symbol'].includes(typeof value));
    for (const [what, args] of hostileArguments(name, odd)) await survives(`${name} in the worker (${what})`, () => sent(...args));
    await does();
  });
}

test('there is no canvas in Node, whatever is passed as one', async () => {
  for (const [what, value] of [...hostileValues(), /** @type {[string, unknown]} */ (['a look-alike', { width: 1, height: 1, getContext: boom }])]) {
    for (const api of [direct, promise]) {
      const call = async () => api.draw(/** @type {any} */ (value), bent);
      await assert.rejects(call, { name: 'DevelopableError', code: 'INPUT', message: /HTMLCanvasElement/ }, what);
    }
  }
  assert.ok(direct.picture(bent).width);
});

test('a solver takes anything', async () => {
  const solver = new direct.Solver(bent);
  for (const [what, value] of hostileValues()) {
    const any = /** @type {any} */ (value);
    await survives(`new Solver(${what})`, () => new direct.Solver(any).dispose());
    await survives(`new Solver(, ${what})`, () => new direct.Solver(bent, any).dispose());
    await survives(`restart(${what})`, () => solver.restart(any));
    await survives(`restartWith(${what})`, () => solver.restartWith(any));
    await survives(`restartWith(, ${what})`, () => solver.restartWith(bent, any));
    await survives(`advance(${what})`, () => solver.advance(any));
  }
  solver.restart();
  while (solver.advance(5));
  assert.equal(solver.surface().heights.length > 0, true);
  solver.dispose();
});

test('an open solver takes anything', async () => {
  const solver = await promise.open(bent);
  for (const [what, value] of hostileValues()) {
    const any = /** @type {any} */ (value);
    await survives(`open(${what})`, async () => (await promise.open(any)).dispose());
    await survives(`open(, ${what})`, async () => (await promise.open(bent, any)).dispose());
    await survives(`fit(${what})`, () => solver.fit(any));
    // What a callback throws is its caller's own.
    for (const key of Object.keys(OPTIONS.openFit).filter(() => typeof value !== 'function')) {
      await survives(`fit({ ${key}: ${what} })`, () => solver.fit({ maxIterations: 3, [key]: any }));
    }
    await survives(`replace(${what})`, () => solver.replace(any));
    await survives(`replace(, ${what})`, () => solver.replace(bent, any));
  }
  await solver.replace(bent);
  assert.ok((await solver.fit()).image);
  solver.dispose();
});

test('what loads the wasm takes anything', async () => {
  for (const [what, value] of hostileValues()) {
    const any = /** @type {any} */ (value);
    await survives(`load(${what})`, () => direct.load(any));
    await survives(`initSync(${what})`, () => initSync(any));
    await survives(`loadSync(${what})`, () => loadSync(any));
    for (const key of ['wasm', 'workerUrl', 'filesWasm', 'elsewhere']) {
      await survives(`new DevelopableWorker({ ${key}: ${what} })`, async () => {
        const worker = new promise.DevelopableWorker({ [key]: any });
        try {
          await worker.writeImage(bent);
        } finally {
          worker.dispose();
        }
      });
    }
    await survives(`new DevelopableWorker(${what})`, () => new promise.DevelopableWorker(any).dispose());
  }
  assert.ok(direct.fit(bent).image);
});

test('an unknown name is refused, with the one that may have been meant', async () => {
  /** @type {[string, () => unknown, string, RegExp][]} */
  const cases = [
    ['an option', () => direct.fit(bent, typo({ lamda: 1 })), 'OPTION', /^unknown option `lamda`: did you mean `lambda`\?$/],
    ['letters swapped', () => direct.fit(bent, typo({ gpa: 1 })), 'OPTION', /`gpa`: did you mean `gap`/],
    ['another case', () => direct.fit(bent, typo({ maxiterations: 1 })), 'OPTION', /did you mean `maxIterations`/],
    ['nothing like it', () => direct.fit(bent, typo({ colour: 1 })), 'OPTION', /`colour`: there are only .*lambda, .*tieBreak/],
    ['even undefined', () => direct.unroll(hex, typo({ tolerence: undefined })), 'OPTION', /did you mean `tolerance`/],
    ['an image', () => direct.fit(typo({ ...bent, heigthScale: 2 })), 'INPUT', /of the image `heigthScale`: did you mean `heightScale`/],
    ['a lattice', () => direct.fit(typo({ ...hex, confidense: [] })), 'INPUT', /of the heights on the lattice `confidense`: did you mean `confidence`/],
    ["a lattice's in an image", () => direct.fit(typo({ ...bent, spacing: 2 })), 'INPUT', /of the image `spacing`/],
    ['a mesh', () => direct.sampleMesh(typo({ ...mesh, colours: [] })), 'INPUT', /of the mesh `colours`: did you mean `colors`/],
    ['a camera', () => direct.backProject(bent, typo({ ...camera, depthscale: 1 })), 'OPTION', /did you mean `depthScale`/],
    ['a part', () => direct.load(typo('mesh')), 'OPTION', /part `mesh`: did you mean `meshes`/],
    ['the worker', () => new promise.DevelopableWorker(typo({ workerURL: 'x' })), 'OPTION', /did you mean `workerUrl`/],
    ['init', () => promise.init(typo({ wasmFiles: 'x' })), 'OPTION', /`wasmFiles`/],
    ['the worker API', () => promise.fit(bent, typo({ onabort: 'keep' })), 'OPTION', /did you mean `onAbort`/],
    ['an open solver', () => promise.open(bent, typo({ transfered: true })), 'OPTION', /did you mean `transfer`/],
  ];
  for (const [what, call, code, message] of cases) {
    await assert.rejects(async () => call(), { name: 'DevelopableError', code, message }, what);
  }
});

test('what a getter throws is told, as the cause too', async () => {
  const cause = new RangeError('no lambda today');
  const options = withGetter({}, 'lambda', () => { throw cause; });
  const expected = { code: 'OPTION', message: /lambda.*no lambda today/, cause };
  assert.throws(() => direct.fit(bent, options), expected);
  await assert.rejects(promise.fit(bent, options), expected);
  assert.throws(() => direct.fit(withGetter(bent, 'width', () => { throw cause; })), { code: 'INPUT', cause });
  // What is right is read once, and where a class has it as well.
  let reads = 0;
  class Settings { get gap() { reads += 1; return 0.5; } }
  assert.ok((direct.fit(bent, new Settings()).report.gap ?? NaN) <= 0.5);
  assert.equal(reads, 1);
});

test('memory that is gone, shared or resizable', async () => {
  const floats = new Float64Array(64).map((_, i) => cylinder(8)(i % 8, Math.floor(i / 8)));
  const expected = direct.fit({ width: 8, height: 8, data: floats }).image?.data;
  const shared = new Float64Array(new SharedArrayBuffer(512));
  const resizable = new Float64Array(resizableBuffer(512));
  for (const data of [shared, resizable]) {
    data.set(floats);
    for (const fit of [direct.fit, promise.fit]) {
      assert.deepEqual((await fit({ width: 8, height: 8, data })).image?.data, expected);
    }
    assert.deepEqual(data, floats.slice());
  }
  const handedOver = floats.slice();
  assert.deepEqual((await promise.fit({ width: 8, height: 8, data: handedOver }, { transfer: true })).image?.data, expected);
  for (const fit of [direct.fit, promise.fit]) {
    const call = async () => fit({ width: 8, height: 8, data: handedOver });
    await assert.rejects(call, { code: 'INPUT', message: /data has no memory any more: its buffer was handed over/ });
  }
});

/** @param {unknown} value @returns {any} */
function typo(value) {
  return value;
}
