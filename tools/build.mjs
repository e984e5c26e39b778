/** `npm run build`: the release wasm, its JavaScript and the libraries that come along, into the package and the page. */
import { pathToFileURL } from 'node:url';
import { setupBuild } from './setup.mjs';
import { main } from './util/problem.mjs';
import { buildInline } from './build/inline.mjs';
import { buildVendor } from './build/vendor.mjs';
import { buildWasm } from './build/wasm.mjs';

/** @param {import('./util/process.mjs').Env} env */
export async function build(env) {
  await buildVendor();
  await buildWasm(env);
  await buildInline();
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  await main(async () => build((await setupBuild()).env));
}
