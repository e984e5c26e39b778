/** Every test there is, in the order of what fails fastest. */
import { buildInline } from '../build/inline.mjs';
import { buildVendor } from '../build/vendor.mjs';
import { buildWasm } from '../build/wasm.mjs';
import { docs, format, lint, nativeTests } from './rust.mjs';
import { nodeTests, pageTests, types } from './javascript.mjs';
import { inBrowser, inNode, sameBindings } from './wasm.mjs';

/** @type {import('./step.mjs').Step[]} */
export const steps = [
  { name: 'format', what: 'the layout of the Rust code', run: format },
  { name: 'lint', what: 'clippy', run: lint },
  { name: 'rust', what: 'the tests of the library, and those in its documentation', run: nativeTests },
  { name: 'docs', what: "the documentation's links and examples", run: docs },
  {
    name: 'build',
    what: 'the package, and the size of its wasm',
    run: async (context) => {
      await buildVendor();
      await buildWasm(context);
      await buildInline();
    },
  },
  { name: 'bindings', what: "tools/bindgen beside wasm-bindgen's own command", run: sameBindings },
  { name: 'wasm-node', what: 'the wasm in Node', run: inNode('wasm_node') },
  { name: 'wasm-browser', what: "the wasm in Chromium's main thread", run: inBrowser('wasm_browser') },
  { name: 'wasm-worker', what: 'the wasm in a dedicated worker in Chromium', run: inBrowser('wasm_worker') },
  { name: 'types', what: 'TypeScript over all JavaScript', run: types },
  { name: 'js', what: 'the package and its command in Node', run: nodeTests },
  { name: 'page', what: 'the page in Chromium', run: pageTests },
];
