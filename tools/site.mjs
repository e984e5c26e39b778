/**
 * `npm run site [-- FOLDER]`: the page, the documents and the API reference as one folder of static files, which works
 * under any path of any static host, and without a network once it was visited.
 */
import { createHash } from 'node:crypto';
import { existsSync } from 'node:fs';
import { copyFile, mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { join, resolve, sep } from 'node:path';
import { pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { brotliCompress, constants, gzip } from 'node:zlib';
import { build } from './build.mjs';
import { KEPT, writeGuide } from './site/guide.mjs';
import { writeReferences } from './site/reference.mjs';
import { filesIn, hashOf } from './util/hash.mjs';
import { pkg, root, www } from './util/paths.mjs';
import { Problem, main } from './util/problem.mjs';

/** Imports that a server without a build step takes as they are, and a bundler has to be told of. */
const IMPORTS = [
  { file: 'api.js', from: "new URL('./pkg/index.js', import.meta.url).href", to: "'../pkg/index.js'" },
  { file: 'early.js', from: "new URL('./pkg/wasm/solver_bg.wasm', import.meta.url)", to: "new URL('../pkg/wasm/solver_bg.wasm', import.meta.url)" },
  { file: join('panels', 'report.js'), from: "new URL('../pkg/package.json', import.meta.url).href, { with: { type: 'json' } }", to: "'../../pkg/package.json'" },
  { file: join('surface', 'scene.js'), from: "new URL('../vendor/three.js', import.meta.url).href", to: "'../vendor/three.js'" },
  { file: 'zip.js', from: "new URL('./vendor/fflate.js', import.meta.url).href", to: "'./vendor/fflate.js'" },
];

/** Quality of Brotli for a server that stops with the command: the best saves a tenth more and takes twenty times as long. */
const BROTLI_QUICK_QUALITY = 9;

/** The solver for several threads where it is not built: `npm start` leaves it out, and the page does not ask for it. */
const emptyThreads = {
  name: 'empty-threads',
  /** @param {string} id */
  resolveId: (id) => (id.endsWith('/threads/threads.js') && !existsSync(join(pkg, 'threads/threads.js')) ? '\0threads' : null),
  /** @param {string} id */
  load: (id) => (id === '\0threads' ? 'export {};' : null),
};

/**
 * Bundles the page and the package from what is built.
 * @param {string} folder is made anew
 */
export async function bundlePage(folder) {
  // Only now: on a fresh clone it has just been installed.
  const { build: bundle } = await import('vite');
  const found = new Set();
  await bundle({
    root: www,
    base: './',
    configFile: false,
    publicDir: false,
    logLevel: 'error',
    worker: { format: 'es', plugins: () => [emptyThreads] },
    plugins: [{
      name: 'imports',
      transform(code, id) {
        const known = IMPORTS.filter(({ file, from }) => id === join(www, file).split(sep).join('/') && code.includes(from));
        for (const one of known) found.add(one);
        return known.length ? { code: known.reduce((text, { from, to }) => text.replace(from, to), code), map: null } : null;
      },
      // The package is fetched beside the page's own modules, not after them.
      transformIndexHtml: (html, { bundle: files = {} }) => ({
        html: html.replace(/\n\s+/g, '\n').replace('./early.js', Object.keys(files).find((name) => /\/early-/.test(name)) ?? ''),
        tags: Object.keys(files).filter((name) => /\/pkg-[^/]*\.js$/.test(name)).map((name) => ({ tag: 'link', attrs: { rel: 'modulepreload', href: `./${name}` } })),
      }),
    }],
    build: {
      outDir: folder,
      emptyOutDir: true,
      assetsInlineLimit: 0,
      modulePreload: false,
      chunkSizeWarningLimit: 2000,
      // The page asks for two modules of the package, one after the other, which would be two requests.
      rolldownOptions: { input: [join(www, 'index.html'), join(www, 'early.js')], output: { codeSplitting: { groups: [{ name: 'pkg', test: /\/pkg\/(?:index|wire)\.js$/ }] } } },
    },
  });
  if (found.size < IMPORTS.length) throw new Problem('An import that the site needs is no longer where tools/site.mjs looks for it.');
}

/**
 * Writes beside each file of text or wasm what it is in Brotli and in gzip, for servers that send such files.
 * @param {string} folder
 * @param {{ quality?: number }} [options] quality of Brotli, of at most 11, and of gzip, which has 9
 */
export async function compressFiles(folder, { quality = BROTLI_QUICK_QUALITY } = {}) {
  const files = (await filesIn(folder)).filter((file) => /\.(?:html|js|css|wasm|svg|webmanifest)$/.test(file));
  await Promise.all(files.map((file) => join(folder, file)).map(async (file) => {
    const bytes = await readFile(file);
    await writeFile(`${file}.br`, await promisify(brotliCompress)(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: quality } }));
    await writeFile(`${file}.gz`, await promisify(gzip)(bytes, { level: Math.min(quality, constants.Z_BEST_COMPRESSION) }));
  }));
}

/**
 * Writes the site from what is built.
 * @param {string} folder is made anew
 * @param {{ references?: boolean, quality?: number }} [options] whether the API reference belongs to it, and files are compressed best, which both take a while; default: no; `quality` of that compression
 */
export async function writeSite(folder, { references = false, quality = references ? constants.BROTLI_MAX_QUALITY : BROTLI_QUICK_QUALITY } = {}) {
  await bundlePage(folder);
  for (const name of ['register.js', 'manifest.webmanifest', 'icon-192.png', 'icon-512.png', 'icon-maskable-512.png']) await copyFile(join(www, 'site', name), join(folder, name));
  await copyFile(join(www, 'icon.svg'), join(folder, 'icon.svg'));
  for (const name of ['LICENSE-MIT', 'LICENSE-APACHE']) await copyFile(join(root, name), join(folder, name));
  const page = join(folder, 'index.html');
  const html = await readFile(page, 'utf8');
  await writeFile(page, html.replace('</head>', '  <link rel="manifest" href="./manifest.webmanifest">\n  <script type="module" src="./register.js"></script>\n</head>'));
  await writeGuide(folder, { references });
  if (references) await writeReferences(folder);
  await writeWorker(folder);
  await compressFiles(folder, { quality });
}

/**
 * The service worker, with the files that it keeps from the start and a version that changes with any file. Guides are
 * kept from the start, without their pictures; these, the reference, text recognition, pdf.js and libheif are kept when they are opened, the
 * wasm for several threads is not.
 * @param {string} folder
 */
async function writeWorker(folder) {
  const files = (await filesIn(folder)).filter((file) => !/(?:^|\/)LICENSE[^/]*$/.test(file));
  const code = await readFile(join(www, 'site', 'sw.js'), 'utf8');
  const version = createHash('sha256').update(code).update(await hashOf(folder, files)).digest('hex').slice(0, 16);
  const kept = files.filter((file) => !/^(?:guide|reference)\/|^llms\.txt$|\/(?:threads_bg|text|pdf|heif)-[^/]*$/.test(file) || KEPT.includes(file));
  const site = { version, files: kept.map((file) => `./${file}`) };
  await writeFile(join(folder, 'sw.js'), `globalThis.SITE = ${JSON.stringify(site)};\n${code}`);
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  await main(async () => {
    const folder = resolve(process.argv[2] ?? join(root, 'site'));
    await build();
    await rm(folder, { recursive: true, force: true });
    await mkdir(folder, { recursive: true });
    await writeSite(folder, { references: true });
    console.log(`\nThe site is in ${folder}: put it on any static host, under any path.`);
  });
}
