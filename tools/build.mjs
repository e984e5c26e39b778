/** `npm run build`: the release wasm, its JavaScript and the libraries that come along, into the package and the page. */
import { pathToFileURL } from 'node:url';
import { setupBuild } from './setup.mjs';
import { main } from './util/problem.mjs';
import { buildInline } from './build/inline.mjs';
import { buildOptionTypes } from './build/option-types.mjs';
import { buildThreads, leaveThreadsOut } from './build/threads.mjs';
import { buildVendor } from './build/vendor.mjs';
import { compileWasm, packWasm } from './build/wasm.mjs';

/**
 * Sets up what is missing and builds.
 * @param {import('./build/wasm.mjs').Build} [kind]
 * @param {{ threads?: boolean }} [parts] `threads`: whether to build the solver for several threads, which takes minutes
 */
export async function build(kind, { threads = true } = {}) {
  const { env, bindgen } = await setupBuild((found) => compileWasm(found, kind));
  await Promise.all([buildVendor(), buildOptionTypes()]);
  await packWasm({ env, bindgen }, kind);
  await (threads ? buildThreads({ env, bindgen }) : leaveThreadsOut());
  await buildInline();
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) await main(() => build());
