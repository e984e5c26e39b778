/** Before `npm pack` and `npm publish`: refuses a package that lacks built files which its package.json names. */
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { join, resolve } from 'node:path';

const folder = resolve(process.argv[2] ?? '.');
const { exports, bin, alias } = JSON.parse(await readFile(join(folder, 'package.json'), 'utf8'));
const named = [
  ...Object.values(exports).flatMap((target) => (typeof target === 'string' ? target : Object.values(target))),
  ...Object.values(bin),
  ...Object.keys(alias),
  // What modules and types of the package import, and no entry names.
  'direct-calls.d.ts', 'option-types.d.ts', 'threads/threads.js', 'threads/threads_bg.wasm', 'vendor/comlink.mjs', 'vendor/commander.mjs', 'vendor/tinyglobby.mjs',
];
const missing = named.filter((path) => !existsSync(join(folder, path)));
if (missing.length > 0) {
  process.stderr.write(`The package is not complete: ${missing.join(', ')} missing. Build all of it first: npm run build\n`);
  process.exitCode = 1;
}
