/** What the package is tried with. Each trial builds the app of tests/consumers as a user would, and runs it. */
import { cp, mkdir, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { inTemporaryFolder } from '../util/folders.mjs';
import { Problem } from '../util/problem.mjs';
import { succeed } from '../util/process.mjs';
import { serve } from '../serve.mjs';
import { browse, served, strict, withBlobs, withInline, withOrigin } from './browse.mjs';
import { typesWith } from './types.mjs';

/** @typedef {{ folder: string, chrome: string }} Context */
/** @typedef {{ name: string, tool: string, run: (context: Context) => Promise<string | void> }} Trial */

/** What the app comes to in a bundle that has copies: a request for the file that is not beside it. */
const looksBeside = /404/;

/** @type {Trial[]} */
export const trials = [
  ...['typescript-lowest', 'typescript'].map((tool) => ({ name: tool, tool, run: typesWith(tool) })),
  { name: 'node', tool: 'node', run: onServer(process.execPath) },
  { name: 'deno', tool: 'deno', run: onServer('node_modules/.bin/deno', 'run', '--allow-read') },
  { name: 'bun', tool: 'bun', run: onServer('node_modules/.bin/bun') },
  {
    name: 'plain modules',
    tool: 'chromium',
    async run({ folder, chrome }) {
      const out = await plainPage(folder, 'plain', '/developable/');
      await cp(join(folder, 'node_modules/developable'), join(out, 'developable'), { recursive: true });
      await visit(chrome, out, strict);
    },
  },
  {
    name: 'files of another origin',
    tool: 'chromium',
    async run({ folder, chrome }) {
      const folders = { '/': join(folder, 'node_modules/developable/') };
      const files = await serve({ folders, headers: { 'Access-Control-Allow-Origin': '*' } });
      try {
        await visit(chrome, await plainPage(folder, 'foreign', files.url), withOrigin(files.url.slice(0, -1)));
      } finally {
        await files.close();
      }
    },
  },
  { name: 'vite', tool: 'vite', run: vite('vite', 'app') },
  { name: 'vite, own worker', tool: 'vite', run: vite('vite', 'own') },
  { name: 'vite dev', tool: 'vite', run: developed('vite') },
  { name: 'vite 7', tool: 'vite7', run: vite('vite7', 'app') },
  { name: 'vite 7, own worker', tool: 'vite7', run: vite('vite7', 'own', '--config', 'own/vite7.config.js') },
  { name: 'vite 7 dev', tool: 'vite7', run: developed('vite7') },
  { name: 'webpack', tool: 'webpack', run: webpack('app') },
  { name: 'webpack, own worker', tool: 'webpack', run: webpack('own') },
  { name: 'parcel', tool: 'parcel', run: parcel('app') },
  { name: 'parcel, own worker', tool: 'parcel', run: parcel('own') },
  {
    name: 'rollup',
    tool: 'rollup',
    run: bundled(withBlobs, (out) => ['node_modules/.bin/rollup', 'app/page.js', '-p', 'node-resolve', '-d', out]),
  },
  { name: 'esbuild', tool: 'esbuild', run: esbuild('--format=esm') },
  { name: 'esbuild splitting', tool: 'esbuild', run: esbuild('--format=esm', '--splitting') },
  { name: 'esbuild script', tool: 'esbuild', run: esbuild('--format=iife') },
  { name: 'esbuild, strict policy', tool: 'esbuild', run: hosted },
  { name: 'esbuild for node', tool: 'esbuild', run: esbuildForNode },
  {
    name: 'bun build',
    tool: 'bun',
    run: bundled(withBlobs, (out) => ['node_modules/.bin/bun', 'build', 'app/page.js', '--outdir', out]),
  },
  { name: 'next', tool: 'next', run: next() },
  { name: 'next webpack', tool: 'next', run: next('--webpack') },
];

/** @param {string[]} command */
function onServer(...command) {
  /** @param {Context} context */
  return async ({ folder }) => {
    const [program, ...args] = command;
    const output = await must([program, ...args, 'app/console.js'], folder);
    check(JSON.parse(output.slice(output.indexOf('{'))));
  };
}

/** @param {string[]} options */
function esbuild(...options) {
  return bundled(withBlobs, (out) => ['node_modules/.bin/esbuild', 'app/page.js', '--bundle', `--outdir=${out}`, ...options]);
}

/**
 * @param {string} policy
 * @param {(out: string) => string[]} command
 */
function bundled(policy, command) {
  /** @param {Context} context */
  return async ({ folder, chrome }) => {
    const out = await emptied(folder, 'out');
    const output = await must(command(out), folder);
    const warnings = output.split('\n').filter((line) => /warning|\bwarn\b/i.test(line));
    if (warnings.length > 0) throw new Problem(`it warns: ${warnings.join('\n')}`);
    await asPage(folder, out);
    await visit(chrome, out, policy);
    return `works, ${await size(out)}`;
  };
}

/**
 * @param {string} tool
 * @param {string} app
 * @param {string[]} options
 */
function vite(tool, app, ...options) {
  const program = `node_modules/${tool}/bin/vite.js`;
  return bundled(strict, (out) => [process.execPath, program, 'build', app, '--outDir', out, '--emptyOutDir', ...options]);
}

/** @param {string} app */
function parcel(app) {
  // Its pages have an import map in them.
  return bundled(withInline, (out) => ['node_modules/.bin/parcel', 'build', `${app}/index.html`, '--dist-dir', out, '--no-cache']);
}

/** @param {string} app */
function webpack(app) {
  // It finds any file of more than 244 KiB too large, lazily loaded or not.
  const options = ['--mode', 'production', '--no-performance', '--output-filename', 'page.js'];
  return bundled(strict, (out) => ['node_modules/.bin/webpack', ...options, '--entry', `./${app}/page.js`, '-o', out]);
}

/** @param {string} tool */
function developed(tool) {
  const args = [`node_modules/${tool}/bin/vite.js`, 'app', '--port', '0', '--host', '127.0.0.1'];
  /** @param {Context} context */
  return ({ folder, chrome }) => served(process.execPath, args, folder, (url) => browse(chrome, url, []).then(check));
}

/** What the error says to do where a policy forbids workers from copies. @param {Context} context */
async function hosted({ folder, chrome }) {
  const out = await emptied(folder, 'out');
  const build = (/** @type {string} */ page) =>
    must(['node_modules/.bin/esbuild', page, '--bundle', '--format=esm', '--splitting', `--outdir=${out}`], folder);
  await build('app/page.js');
  await asPage(folder, out);
  const error = await visit(chrome, out, strict).then(() => undefined, ({ message }) => String(message));
  const remedy = "init({ workerUrl: '/developable/worker.js' })";
  if (!error?.includes(remedy)) throw new Problem(`the error does not say what to do: ${error}`);
  await build('hosted/page.js');
  await cp(join(folder, 'node_modules/developable'), join(out, 'developable'), { recursive: true });
  await visit(chrome, out, strict);
  return `works with ${remedy}`;
}

/** Run where no node_modules are. @param {Context} context */
function esbuildForNode({ folder }) {
  return inTemporaryFolder(async (out) => {
    const place = join(out, 'console.mjs');
    const options = ['--bundle', '--platform=node', '--format=esm', `--outfile=${place}`];
    await must(['node_modules/.bin/esbuild', 'app/console.js', ...options], folder);
    check(JSON.parse(await must([process.execPath, place], out)));
  });
}

/** @param {string[]} options */
function next(...options) {
  /** @param {Context} context */
  return async ({ folder, chrome }) => {
    const program = 'node_modules/next/dist/bin/next';
    process.env.NEXT_TELEMETRY_DISABLED = '1';
    await must([process.execPath, program, 'build', 'next', ...options], folder);
    await served(process.execPath, [program, 'start', 'next', '--port', '0'], folder, async (url) => {
      check(await (await fetch(new URL('/api/solve', url))).json());
      check(await browse(chrome, url, []));
    });
    return 'works, in the page and in a route handler';
  };
}

/**
 * The app as plain modules.
 * @param {string} folder
 * @param {string} name
 * @param {string} place where the package is
 */
async function plainPage(folder, name, place) {
  const out = await emptied(folder, name);
  await cp(join(folder, 'app'), out, { recursive: true });
  for (const [name, from, to] of [['solve.js', 'developable', 'index.js'], ['solve-here.js', 'developable/direct', 'direct.js']]) {
    const code = await readFile(join(out, name), 'utf8');
    await writeFile(join(out, name), code.replace(`'${from}'`, `'${place}${to}'`));
  }
  return out;
}

/**
 * A page for a bundler that makes none.
 * @param {string} folder
 * @param {string} out
 */
async function asPage(folder, out) {
  if (!(await readdir(out)).includes('index.html')) await cp(join(folder, 'app/index.html'), join(out, 'index.html'));
}

/**
 * @param {string} chrome
 * @param {string} out
 * @param {string} policy
 */
async function visit(chrome, out, policy) {
  const { url, close } = await serve({ folders: { '/': out }, policy });
  try {
    check(await browse(chrome, url, policy === withBlobs ? [looksBeside] : []));
  } finally {
    await close();
  }
}

/**
 * What the app has found.
 * @param {{ worker?: Record<'finite' | 'read' | 'unrolled', boolean> & { gap: number }, here?: { gap: number, finite: boolean } }} outcome
 */
function check({ worker, here }) {
  const right = [worker, here].some(Boolean)
    && (!worker || (worker.gap <= 0.01 && worker.finite && worker.read && worker.unrolled))
    && (!here || (here.gap <= 0.01 && here.finite));
  if (!right) throw new Problem(`it ran, but with a wrong result: ${JSON.stringify({ worker, here })}`);
}

/**
 * @param {string} folder
 * @param {string} name
 */
async function emptied(folder, name) {
  const path = join(folder, name);
  await rm(path, { recursive: true, force: true });
  await mkdir(path);
  return path;
}

/** @param {string} out */
async function size(out) {
  const names = (await readdir(out, { recursive: true })).filter((name) => /\.m?js$/.test(name));
  const texts = await Promise.all(names.map((name) => readFile(join(out, name))));
  const bytes = texts.reduce((sum, { length }) => sum + length, 0);
  return `${Math.round(bytes / 1000)} kB of JavaScript in ${names.length} files`;
}

/**
 * @param {string[]} command
 * @param {string} cwd
 */
const must = ([program, ...args], cwd) => succeed(program, args, { cwd, limit: 300 });
