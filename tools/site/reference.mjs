/** The references: of the package by TypeDoc, from its types, and of the crate by rustdoc. */
import { cp, readdir } from 'node:fs/promises';
import { join } from 'node:path';
import { native } from '../util/env.mjs';
import { pkg, root } from '../util/paths.mjs';
import { Problem } from '../util/problem.mjs';
import { succeed } from '../util/process.mjs';

/**
 * Writes `reference/package` and `reference/rust`.
 * @param {string} folder the site's
 */
export async function writeReferences(folder) {
  await writePackage(join(folder, 'reference/package'));
  await writeCrate(join(folder, 'reference/rust'));
}

/** @param {string} folder */
async function writePackage(folder) {
  const program = join(root, 'tools/reference/node_modules/typedoc/bin/typedoc');
  const entries = ['index', 'direct', 'sync'].map((name) => join(pkg, `${name}.d.ts`));
  await succeed(process.execPath, [program, '--options', join(root, 'tools/reference/typedoc.json'), '--out', folder, ...entries], { cwd: root });
}

/** @param {string} folder */
async function writeCrate(folder) {
  await succeed('cargo', ['doc', '--no-deps', '--lib'], { env: native, cwd: root });
  const made = join(root, 'target/doc');
  if (!(await readdir(made)).includes('developable')) throw new Problem(`cargo doc has left nothing in ${made}.`);
  // Without the lock file of cargo.
  await cp(made, folder, { recursive: true, filter: (path) => !path.endsWith('.lock') });
}
