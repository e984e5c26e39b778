/**
 * Copies of the worker and the wasm as JavaScript, gzipped and in base64: for bundlers that would leave
 * the files themselves behind (see pkg/copies.js).
 */
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { replaceFolder } from '../util/folders.mjs';
import { pkg, pkgInline, pkgWasm } from '../util/paths.mjs';
import { names } from './wasm.mjs';

export async function buildInline() {
  await replaceFolder(pkgInline, async (draft) => {
    await copy(draft, 'worker', Buffer.from(await bundledWorker()));
    for (const name of names) await copy(draft, name, await readFile(join(pkgWasm, `${name}_bg.wasm`)));
  });
}

/**
 * @param {string} folder
 * @param {string} name
 * @param {Buffer} bytes
 */
async function copy(folder, name, bytes) {
  const packed = gzipSync(bytes, { level: 9 }).toString('base64');
  await writeFile(join(folder, `${name}.js`), `export default '${packed}';\n`);
  // So that nobody's compiler has to read it.
  await writeFile(join(folder, `${name}.d.ts`), 'declare const packed: string;\nexport default packed;\n');
}

/** The worker's script without imports. */
async function bundledWorker() {
  // Only now: on a fresh clone it has just been installed.
  const { build } = await import('rolldown');
  const { output } = await build({
    input: join(pkg, 'worker.js'),
    write: false,
    // What a copy cannot load itself: it asks for it.
    external: /\/inline\//,
    output: { format: 'esm', minify: true, codeSplitting: false },
  });
  return output[0].code;
}
