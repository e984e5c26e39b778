/** Where things lie: the checkout, what is built in it, and the cache outside of it. */
import { homedir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../..', import.meta.url));

/** The npm package. */
export const pkg = join(root, 'pkg');
/** What wasm-bindgen and wasm-opt write. */
export const pkgWasm = join(pkg, 'wasm');
/** The folder of the generated files of the solver for several threads. */
export const pkgThreads = join(pkg, 'threads');
/** Copies of both the worker and the wasm as JavaScript. */
export const pkgInline = join(pkg, 'inline');
/** Libraries copied into the package, so that it has no dependencies. */
export const pkgVendor = join(pkg, 'vendor');
/** The page. */
export const www = join(root, 'www');
/** Libraries that only the page needs. */
export const wwwVendor = join(www, 'vendor');

/** Tools that are built once for all checkouts of this machine. */
export const cache = resolve(
  process.env.DEVELOPABLE_CACHE ||
    join(process.env.XDG_CACHE_HOME || join(homedir(), '.cache'), 'developable'),
);
