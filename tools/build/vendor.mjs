/**
 * Libraries that come along, with their licences, for the package has no dependencies: comlink with its types; commander and
 * tinyglobby for the command, as one file each; and for the page what it needs of three.js, fflate, pdf.js, libheif, and Tesseract
 * with its model of English.
 */
import { copyFile, mkdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { pkgVendor, root, wwwVendor } from '../util/paths.mjs';
import { usedThree } from './three-parts.mjs';

const from = join(root, 'node_modules/comlink');

/** Types of what the command uses of tinyglobby: its own need those of its libraries. */
const GLOB_TYPES = `/** Paths of the files that match a pattern. */
export function globSync(pattern: string, options?: { expandDirectories?: boolean }): string[];
`;

export async function buildVendor() {
  await copyComlink();
  await bundle('tinyglobby', 'dist/index.mjs', GLOB_TYPES, ['fdir', 'picomatch']);
  await bundle('commander', 'esm.mjs', await readFile(join(root, 'node_modules/commander/typings/index.d.ts'), 'utf8'));
  await bundleThree();
  await copyTesseract();
  await copyPdf();
  await copyHeif();
}

async function copyComlink() {
  await mkdir(pkgVendor, { recursive: true });
  for (const name of ['comlink.mjs', 'node-adapter.mjs']) {
    const text = await readFile(join(from, 'dist/esm', name), 'utf8');
    // The source map is not copied along.
    await writeFile(join(pkgVendor, name), text.replace(/^\/\/# sourceMappingURL=.*\n?/m, ''));
  }
  for (const name of ['comlink', 'node-adapter']) {
    const types = await readFile(join(from, 'dist/esm', `${name}.d.ts`), 'utf8');
    // Node wants the whole name of a file.
    await writeFile(join(pkgVendor, `${name}.d.mts`), types.replace(/(from "\.\/\w+)"/g, '$1.js"'));
  }
  await copyFile(join(from, 'dist/esm/protocol.d.ts'), join(pkgVendor, 'protocol.d.ts'));
  await copyFile(join(from, 'LICENSE'), join(pkgVendor, 'LICENSE-comlink'));
}

/**
 * A library as one file, with its types and licences.
 * @param {string} name
 * @param {string} entry its module
 * @param {string} types
 * @param {string[]} [parts] other libraries that it holds
 */
async function bundle(name, entry, types, parts = []) {
  const { rolldown } = await import('rolldown');
  const built = await rolldown({ input: join(root, 'node_modules', name, entry), platform: 'node' });
  await built.write({ file: join(pkgVendor, `${name}.mjs`), format: 'esm', minify: true });
  await writeFile(join(pkgVendor, `${name}.d.mts`), types);
  for (const part of [name, ...parts]) {
    await copyFile(join(root, 'node_modules', part, 'LICENSE'), join(pkgVendor, `LICENSE-${part}`));
  }
}

/** three.js as one file, in a folder made anew, and fflate, which the page loads to write 3MF. */
async function bundleThree() {
  // Only now: on a fresh clone it has just been installed.
  const { build } = await import('vite');
  await build({
    root,
    configFile: false,
    publicDir: false,
    logLevel: 'warn',
    plugins: [await usedThree()],
    build: {
      outDir: wwwVendor,
      emptyOutDir: true,
      lib: { entry: fileURLToPath(new URL('three.js', import.meta.url)), formats: ['es'], fileName: () => 'three.js' },
    },
  });
  await copyFile(join(root, 'node_modules/three/LICENSE'), join(wwwVendor, 'LICENSE-three'));
  await copyFile(join(root, 'node_modules/fflate/esm/browser.js'), join(wwwVendor, 'fflate.js'));
  await copyFile(join(root, 'node_modules/fflate/LICENSE'), join(wwwVendor, 'LICENSE-fflate'));
}

/** Tesseract, which the page loads when text is to be recognised. The model is no `.gz`, which servers may unpack on the way. */
async function copyTesseract() {
  const [library, model] = ['node_modules/tesseract-wasm', 'node_modules/@tesseract.js-data/eng/4.0.0_best_int'].map((folder) => join(root, folder));
  await copyFile(join(library, 'dist/lib.js'), join(wwwVendor, 'text-client.js'));
  const worker = await readFile(join(library, 'dist/tesseract-worker.js'), 'utf8');
  // What it says of each picture is for its developers.
  await writeFile(join(wwwVendor, 'text-worker.js'), worker.replace('console.warn.bind(console)', '(() => {})'));
  await copyFile(join(library, 'dist/tesseract-core.wasm'), join(wwwVendor, 'text-core.wasm'));
  await copyFile(join(model, 'eng.traineddata.gz'), join(wwwVendor, 'text-english.bin'));
  await copyFile(join(library, 'LICENSE.md'), join(wwwVendor, 'LICENSE-tesseract-wasm'));
}

/** pdf.js, which the page loads when a PDF is opened, with its decoders of pictures. */
async function copyPdf() {
  const library = join(root, 'node_modules/pdfjs-dist');
  for (const [from, to] of [
    ['legacy/build/pdf.min.mjs', 'pdf-client.js'], ['legacy/build/pdf.worker.min.mjs', 'pdf-worker.js'], ['LICENSE', 'LICENSE-pdfjs'],
    ...['jbig2', 'openjpeg', 'qcms'].flatMap((name) => [[`wasm/${name === 'qcms' ? 'qcms_bg' : name}.wasm`, `pdf-${name}.wasm`], [`wasm/LICENSE_${name.toUpperCase()}`, `LICENSE-${name}`]]),
  ]) await copyFile(join(library, from), join(wwwVendor, to));
}

/** libheif, which the page loads when a photo is opened that the browser does not read, as a module. */
async function copyHeif() {
  const library = join(root, 'node_modules/libheif-js/libheif-wasm');
  const code = await readFile(join(library, 'libheif.js'), 'utf8');
  // What it says of a damaged file is for its developers.
  await writeFile(join(wwwVendor, 'heif-client.js'), `${code.replaceAll('console.log(', '(() => {})(')}\nexport default libheif;\n`);
  await copyFile(join(library, 'libheif.wasm'), join(wwwVendor, 'heif-decoder.wasm'));
  await copyFile(join(library, 'LICENSE'), join(wwwVendor, 'LICENSE-libheif'));
}
