/** The package as its users get it: packed, installed, imported, type-checked, bundled. */
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { cp, mkdir, readdir, readFile, writeFile } from 'node:fs/promises';
import { join, posix } from 'node:path';
import { dirname, join as joinPaths, normalize } from 'node:path/posix';
import { after, before, test } from 'node:test';
import { promisify } from 'node:util';
import { build as bundle } from 'rolldown';
import { build, createServer } from 'vite';
import { withBlobs, withOrigin } from '../../tools/consumers/browse.mjs';
import { configurations, program } from '../../tools/consumers/types.mjs';
import { serve as serveWith } from '../../tools/serve.mjs';
import { launch, openPage, serve, skip } from './support/browser.mjs';
import { temporaryFolder } from './support/command.mjs';
import { pkg, root } from './support/paths.mjs';

const exec = promisify(execFile);
const app = await temporaryFolder();
const tsc = join(root, 'node_modules/typescript/bin/tsc');

/** @param {string[]} args @param {string} [cwd] */
const node = async (args, cwd = app) => (await exec(process.execPath, args, { cwd })).stdout;

/** @type {{ files: { path: string }[], filename: string }} */
let packed;

before(async () => {
  const npm = process.platform === 'win32' ? 'npm.cmd' : 'npm';
  const { stdout } = await exec(npm, ['pack', '--json', '--pack-destination', app], { cwd: pkg });
  [packed] = JSON.parse(stdout);
  await writeFile(join(app, 'package.json'), JSON.stringify({ private: true, type: 'module' }));
  await exec(npm, ['install', '--offline', '--no-audit', '--no-fund', `./${packed.filename}`], { cwd: app });
});

/** What npm has packed. */
const paths = () => packed.files.map(({ path }) => path).sort();

test('the package holds nothing that its users do not need', async () => {
  for (const path of paths()) assert.match(path, /\.(js|mjs|d\.ts|d\.mts|wasm|json|md)$|LICENSE/);
  assert.ok(!paths().some((path) => /tsconfig|test|draft|made-from/.test(path)), paths().join());
  const installed = (await readdir(join(app, 'node_modules'))).filter((name) => !name.startsWith('.'));
  assert.deepEqual(installed, ['developable'], 'no dependencies');
});

test('the package holds whatever its package.json names', async () => {
  const { exports, files, bin, types, alias, sideEffects } = JSON.parse(await readFile(join(pkg, 'package.json'), 'utf8'));
  const targets = Object.values(exports).flatMap((target) => (typeof target === 'string' ? [target] : Object.values(target)));
  const named = [...targets, ...Object.values(bin), types, ...Object.keys(alias), ...sideEffects];
  assert.ok(targets.length > 20 && named.length > targets.length);
  const held = new Set(paths());
  const missing = named.filter((path) => !held.has(normalize(path)));
  assert.deepEqual(missing, []);
  // Each of the patterns stands for something.
  const empty = files.filter((/** @type {string} */ pattern) => !paths().some((path) => matches(path, pattern)));
  assert.deepEqual(empty, []);
  for (const path of ['README.md', 'LICENSE-MIT', 'LICENSE-APACHE', 'vendor/LICENSE-comlink']) assert.ok(held.has(path), path);
});

test('links of the README and the guides lead to files of the package', async () => {
  const held = new Set(paths());
  const broken = [];
  let count = 0;
  for (const path of paths().filter((one) => one.endsWith('.md'))) {
    const text = await readFile(join(app, 'node_modules/developable', path), 'utf8');
    for (const [, target] of text.replace(/^```[^]*?^```/gm, '').matchAll(/\]\(([^()\s#]+)[^()\s]*\)/g)) {
      if (/^[a-z]+:/.test(target)) continue;
      count += 1;
      if (!held.has(posix.join(posix.dirname(path), target))) broken.push(`${path}: ${target}`);
    }
  }
  assert.ok(count > 10, `${count} links`);
  assert.deepEqual(broken, []);
});

test('each wasm file has its JavaScript, the types of both, and a copy', () => {
  const names = paths().flatMap((path) => /^wasm\/(.*)_bg\.wasm$/.exec(path)?.[1] ?? []);
  assert.deepEqual(names, ['files', 'fitmesh', 'images', 'meshes', 'patterns', 'solver', 'unroll']);
  const parts = names.flatMap((name) => [`${name}.d.ts`, `${name}.js`, `${name}_bg.wasm`, `${name}_bg.wasm.d.ts`]);
  assert.deepEqual(paths().filter((path) => path.startsWith('wasm/')), parts.map((part) => `wasm/${part}`).sort());
  // The solver for several threads has none.
  const threads = ['threads.d.ts', 'threads.js', 'threads_bg.wasm', 'threads_bg.wasm.d.ts'].map((part) => `threads/${part}`);
  assert.deepEqual(paths().filter((path) => path.startsWith('threads/')), threads);
  const copies = [...names, 'worker'].flatMap((name) => [`inline/${name}.d.ts`, `inline/${name}.js`]);
  assert.deepEqual(paths().filter((path) => path.startsWith('inline/')), copies.sort());
});

test('whatever a file of the package imports is in the package', async () => {
  const held = new Set(paths());
  let count = 0;
  for (const path of paths().filter((one) => /\.m?[jt]s$/.test(one))) {
    const text = await readFile(join(app, 'node_modules/developable', path), 'utf8');
    for (const { place, typesOnly } of references(path, text)) {
      count += 1;
      const target = joinPaths(dirname(path), place);
      const declared = target.replace(/\.(m?)js$/, '.d.$1ts');
      assert.ok((typesOnly && held.has(declared)) || held.has(target), `${path} asks for ${place}`);
    }
  }
  assert.ok(count > 100, `${count} imports`);
});

/**
 * The places of its own package that a module names: in imports, in URLs, and in comments for its types.
 * @param {string} path
 * @param {string} text
 */
function references(path, text) {
  const declaration = /\.d\.m?ts$/.test(path);
  const comments = [...text.matchAll(/\/\*[^]*?\*\/|\/\/.*$/gm)].map(({ 0: { length }, index }) => [index, index + length]);
  const pattern = /(?:\bfrom|\bimport\s*\(?|\bnew URL\()\s*(['"])(\.{1,2}\/[^'"]+)\1/g;
  return [...text.matchAll(pattern)].flatMap(({ 0: found, 2: place, index }) => {
    const inComment = comments.some(([start, end]) => index >= start && index < end);
    // Of what stands in comments only `import('./types.js').Surface` and the like is code.
    return inComment && !/^import\s*\(/.test(found) ? [] : { place, typesOnly: declaration || inComment };
  });
}

/**
 * Whether a path is meant by an entry of `files` in package.json.
 * @param {string} path
 * @param {string} pattern
 */
function matches(path, pattern) {
  if (pattern.endsWith('/')) return path.startsWith(pattern);
  return new RegExp(`^${pattern.replaceAll('.', '\\.').replaceAll('*', '[^/]*')}$`).test(path);
}

test('every entry point can be imported in Node', async () => {
  const script = `
    import { fit, dispose } from 'developable';
    import * as direct from 'developable/direct';
    import { initSync } from 'developable/sync';
    import { readFile } from 'node:fs/promises';
    import { fileURLToPath } from 'node:url';
    const input = { width: 8, height: 8, data: new Float32Array(64) };
    const worker = await fit(input);
    initSync(await readFile(fileURLToPath(import.meta.resolve('developable/wasm'))));
    const here = direct.fit(input);
    import.meta.resolve('developable/worker');
    import.meta.resolve('developable/package.json');
    let inner;
    try { import.meta.resolve('developable/client.js'); } catch ({ code }) { inner = code; }
    console.log(worker.report.stopReason, here.report.stopReason, inner);
  `;
  await writeFile(join(app, 'entries.mjs'), script);
  assert.equal(await node(['entries.mjs']), 'rounding rounding ERR_PACKAGE_PATH_NOT_EXPORTED\n');
});

test('the command is installed', async () => {
  const { stdout } = await exec(join(app, 'node_modules/.bin/developable'), ['--version'], { cwd: app });
  assert.match(stdout, /^\d+\.\d+\.\d+\n$/);
});

test('its own JavaScript is type-checked strictly', async () => {
  await node([tsc, '-p', join(pkg, 'tsconfig.json')]).catch(({ stdout }) => assert.fail(stdout));
});

test('TypeScript users get types, with each kind of module resolution, and of the DOM or of Node alone', async () => {
  await writeFile(join(app, 'use.ts'), `
    import { fit, open, read, example, writeImage, init, DevelopableError, DevelopableWorker } from 'developable';
    import type { Surface, Progress, FitOptions, ErrorCode, Report } from 'developable';
    import * as direct from 'developable/direct';
    import { initSync } from 'developable/sync';

    export async function use(file: Blob, signal: AbortSignal): Promise<Surface> {
      await init({ wasm: new URL('x.wasm', 'https://example.org/') });
      const onProgress = ({ gap }: Progress) => void gap;
      const options: FitOptions = { lambda: 'small', gap: 1e-3, signal, onAbort: 'keep', onProgress };
      const { input } = await example('page', { size: 100 });
      const surface = await fit(await read(file), options);
      const { width, data }: { width: number, data: Float64Array } = surface.image;
      const solver = await open(input);
      const again: number = (await solver.fit()).image.data.length;
      const lattice = await fit({ rows: 3, cols: 3, spacing: 1, heights: surface.heights });
      // @ts-expect-error heights on the lattice have no pixels
      lattice.image.data;
      const here: number = direct.fit(input).image.width;
      const blob = new Blob([await writeImage(surface)]);
      const heights: Float64Array = surface.heights;
      const codes: ErrorCode[] = ['SHAPE'];
      const report: Report = surface.report;
      // @ts-expect-error no such example
      await example('torus');
      // @ts-expect-error no such option
      await fit(input, { lamda: 1 });
      // @ts-expect-error a lattice needs its spacing
      await fit({ rows: 3, cols: 3, heights });
      return fit({ width: 2, height: 2, data: [0, 1, 2, 3] }, { lambda: 1e6 });
    }

    export function solveHere(): number {
      using solver = new direct.Solver({ rows: 3, cols: 3, spacing: 1, heights: new Float32Array(9) });
      while (solver.advance(10)) if ((solver.progress().gap ?? 1) < 0.1) solver.cancel();
      try {
        return solver.surface().report.gap ?? NaN;
      } catch (error) {
        if (error instanceof DevelopableError && error.code === 'DISPOSED') return NaN;
        throw error;
      }
    }

    export class Mine extends DevelopableWorker {}
  `);
  // With them the first example of the README and an import of each path.
  const others = Object.entries(await program(app));
  for (const [name, text] of others) await writeFile(join(app, name), text);
  // A compiled module is taken with each library.
  await writeFile(join(app, 'modules.ts'), `
    import { init } from 'developable';
    import { initSync, loadSync } from 'developable/sync';
    export async function start(bytes: ArrayBuffer) {
      const module = await (globalThis as any).WebAssembly.compile(bytes) as import('developable').WasmModule;
      await init({ wasm: module });
      initSync(module);
      loadSync({ files: module });
    }
  `);
  const files = ['use.ts', 'modules.ts', ...others.map(([name]) => name)];
  for (const { name, compilerOptions } of configurations()) {
    await writeFile(join(app, 'tsconfig.json'), JSON.stringify({ compilerOptions, files }));
    await node([tsc, '-p', app]).catch(({ stdout }) => assert.fail(`${name}: ${stdout}`));
  }
});

await mkdir(join(app, 'src'));
await writeFile(join(app, 'index.html'), `<!doctype html>
  <link rel="icon" href="data:,">
  <script type="module" src="/src/main.js"></script>
`);
await writeFile(join(app, 'src/main.js'), `
  import { fit, example, DevelopableError } from 'developable';
  async function main() {
    const { input, truth } = await example('cylinder', { size: 60, noise: 0.05 });
    const { report, image } = await fit(input);
    const rms = (values) => Math.sqrt(values.reduce((sum, v, i) => sum + (v - truth[i]) ** 2, 0) / values.length);
    const error = await fit({ width: 1, height: 1, data: [0] }).catch((thrown) => thrown);
    const long = (await example('roof', { size: 200, noise: 0.1 })).input;
    const signal = AbortSignal.timeout(300);
    const aborted = await fit(long, { lambda: 'small', gap: 1e-12, maxIterations: 1e9, signal }).catch(({ name }) => name);
    return {
      reason: report.stopReason,
      better: rms(image.data) / rms(input.data),
      code: error instanceof DevelopableError && error.code,
      aborted,
    };
  }
  globalThis.result = main();
`);

/** @type {import('playwright-core').Browser} */
let browser;
if (!skip) {
  before(async () => void (browser = await launch()));
  after(() => browser?.close());
}

/**
 * @param {string} url
 * @param {RegExp[]} [expected] incidents
 */
async function checkApp(url, expected = []) {
  const { page, incidents } = await openPage(browser, url);
  const { better, ...result } = await page.evaluate('globalThis.result');
  assert.deepEqual(result, { reason: 'gap', code: 'NO_INTERIOR', aborted: 'TimeoutError' });
  assert.ok(better < 0.6, `${better} of the noise is left`);
  assert.deepEqual(incidents.filter((text) => !expected.some((pattern) => pattern.test(text))), []);
  await page.close();
}

test('an app bundled with Vite runs under the strict policy', { skip }, async () => {
  await build({ root: app, logLevel: 'error', configFile: false, build: { modulePreload: { polyfill: false } } });
  const assets = await readdir(join(app, 'dist/assets'));
  // Each of the package's wasm files, once.
  const modules = assets.filter((name) => name.endsWith('.wasm')).map((name) => name.split('-')[0]);
  assert.deepEqual(modules.sort(), ['files_bg', 'fitmesh_bg', 'images_bg', 'meshes_bg', 'patterns_bg', 'solver_bg', 'threads_bg', 'unroll_bg']);
  // And none of the copies, which are gzipped.
  for (const name of assets.filter((one) => one.endsWith('.js'))) {
    assert.doesNotMatch(await readFile(join(app, 'dist/assets', name), 'utf8'), /H4sIA{4}/, name);
  }
  const server = await serve({ '/': join(app, 'dist') });
  after(() => server.close());
  await checkApp(server.url);
});

test('an app served by Vite while it is developed runs as well', { skip }, async () => {
  const place = { port: 0, host: '127.0.0.1' };
  const server = await createServer({ root: app, logLevel: 'error', configFile: false, server: place });
  after(() => server.close());
  await server.listen();
  await checkApp(server.resolvedUrls?.local[0] ?? '');
});

/**
 * The app in a bundle that leaves the package's files behind, as those of Rollup and esbuild do.
 * @param {string} name
 */
async function bundleWithoutFiles(name) {
  const out = join(app, name);
  await bundle({ input: join(app, 'src/main.js'), output: { dir: join(out, 'src') }, logLevel: 'silent' });
  await cp(join(app, 'index.html'), join(out, 'index.html'));
  return out;
}

test('an app whose bundle has none of the files runs from copies', { skip }, async () => {
  const out = await bundleWithoutFiles('rolled');
  assert.ok(!(await readdir(join(out, 'src'))).some((path) => /\.wasm$|^worker\.js$/.test(path)));
  const server = await serveWith({ folders: { '/': out }, policy: withBlobs });
  after(() => server.close());
  await checkApp(server.url, [/404/]);
});

test('where a policy forbids workers from copies, the error says what to do, and that works', { skip }, async () => {
  const out = await bundleWithoutFiles('strict');
  const server = await serve({ '/': out, '/developable/': join(app, 'node_modules/developable') });
  after(() => server.close());
  const { page } = await openPage(browser, server.url);
  const { code, message } = await page.evaluate('globalThis.result.catch(({ code, message }) => ({ code, message }))');
  assert.equal(code, 'WORKER');
  assert.match(message, /worker-src 'self' blob:.*init\(\{ workerUrl: '\/developable\/worker\.js' \}\)/);
  await page.close();
  const main = await readFile(join(app, 'src/main.js'), 'utf8');
  const told = main.replace('import { fit,', 'import { init, fit,')
    .replace('async function main() {', "async function main() {\n  await init({ workerUrl: '/developable/worker.js' });");
  await writeFile(join(app, 'src/main.js'), told);
  await bundleWithoutFiles('strict');
  await writeFile(join(app, 'src/main.js'), main);
  await checkApp(server.url);
});

test('a page can have the package from another origin', { skip }, async () => {
  const files = await serveWith({
    folders: { '/': join(app, 'node_modules/developable') },
    headers: { 'Access-Control-Allow-Origin': '*' },
  });
  after(() => files.close());
  const out = join(app, 'foreign');
  await cp(join(app, 'index.html'), join(out, 'index.html'));
  const main = await readFile(join(app, 'src/main.js'), 'utf8');
  await mkdir(join(out, 'src'));
  await writeFile(join(out, 'src/main.js'), main.replace("'developable'", `'${files.url}index.js'`));
  const server = await serveWith({ folders: { '/': out }, policy: withOrigin(files.url.slice(0, -1)) });
  after(() => server.close());
  await checkApp(server.url);
});
