/** The solver's wasm for several threads: the same crate, built for atomic operations and a shared memory. */
import { existsSync } from 'node:fs';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { target } from '../setup/wasm-target.mjs';
import { replaceFolder } from '../util/folders.mjs';
import { filesIn, hashOf } from '../util/hash.mjs';
import { pkgThreads, root } from '../util/paths.mjs';
import { bindgenArguments, checkSize, moduleFile, must, wasmOpt } from './wasm.mjs';
import { alignStorage } from './tls.mjs';

/** The most bytes that a server may have to send, gzipped. */
const SIZE_LIMIT = 280_000;

/** Functions of the glue that the package imports. */
const IMPORTED = ['initSync', 'leadTeam', 'helperStack'];

/** Their types, where they were not built: the rest of the glue is as that of the solver for one thread. */
const TYPES = `import type { InitOutput } from '../wasm/solver.js';
export * from '../wasm/solver.js';
export function initSync(given: { module: WebAssembly.Module, memory: WebAssembly.Memory }): InitOutput;
export function leadTeam(wake: Function, pause: Function): Uint32Array;
export function helperStack(): number;
`;

/** Kept apart, so that neither build has the other compiled again. */
const targetFolder = join(root, 'target/threads');

/** Name of the file that says what the others were made from. */
const MADE_FROM = 'made-from';

/**
 * The memory is shared and imported, with a maximum of 4 GiB. What the linker defines of threads is exported, for
 * wasm-bindgen asks for it; so is the stack pointer, which each helper sets.
 */
const flags = [
  'target-feature=+simd128,+atomics,+bulk-memory,+mutable-globals',
  'llvm-args=-inline-threshold=50', // as .cargo/config.toml has it
  ...['--shared-memory', '--import-memory', '--max-memory=4294967296'].map((arg) => `link-arg=${arg}`),
  ...['__heap_base', '__wasm_init_tls', '__tls_size', '__tls_align', '__tls_base', '__stack_pointer'].map((name) => `link-arg=--export=${name}`),
].map((flag) => `-C ${flag}`);

/**
 * Builds it, unless it was built of the same sources already. The standard library is the ordinary one, for one thread: with
 * `lto = "fat"` it is compiled together with the rest.
 * @param {import('./wasm.mjs').Tools} tools
 */
export async function buildThreads({ env, bindgen }) {
  const origin = await sourceHash();
  if (!await isBuiltOf(origin)) {
    const args = [
      'build', '--release', '--target', target, '--target-dir', targetFolder, '--config', 'profile.release.lto="fat"',
      '--package', 'developable-wasm-solver', '--features', 'developable-wasm-solver/threads',
    ];
    await must('cargo', args, { ...env, CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: flags.join(' ') });
    const module = join(targetFolder, target, 'release', moduleFile('solver'));
    const bytes = await readFile(module);
    alignStorage(bytes);
    const aligned = join(targetFolder, 'aligned.wasm');
    await writeFile(aligned, bytes);
    await replaceFolder(pkgThreads, async (folder) => {
      await must(bindgen, bindgenArguments(folder, 'threads', aligned), process.env);
      const packed = join(folder, 'threads_bg.wasm');
      await must(process.execPath, [wasmOpt, '-O1', packed, '-o', packed], process.env);
      await writeFile(join(folder, MADE_FROM), origin);
    });
  }
  await checkSize(pkgThreads, 'threads', SIZE_LIMIT);
}

/** In place of a build that is missing or out of date: glue with which no solver starts, so that there is one thread. */
export async function leaveThreadsOut() {
  if (await isBuiltOf(await sourceHash())) return;
  const body = "{\n  throw new Error('the wasm for several threads was not built');\n}\n";
  // A bundler warns of an import that is missing.
  const text = IMPORTED.map((name) => `export function ${name}() ${body}`).join('');
  await replaceFolder(pkgThreads, async (folder) => {
    await writeFile(join(folder, 'threads.js'), text);
    await writeFile(join(folder, 'threads.d.ts'), TYPES);
  });
}

/** @param {string} origin */
async function isBuiltOf(origin) {
  return existsSync(join(pkgThreads, 'threads_bg.wasm')) && await readFile(join(pkgThreads, MADE_FROM), 'utf8').catch(() => '') === origin;
}

/** Changes with any source of the build. */
async function sourceHash() {
  const folders = await Promise.all(['src', 'wasm/common', 'wasm/solver', 'tools/build'].map(async (folder) =>
    (await filesIn(join(root, folder))).map((file) => `${folder}/${file}`)));
  return hashOf(root, ['Cargo.toml', 'Cargo.lock', ...folders.flat()]);
}
