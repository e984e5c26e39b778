/**
 * Every test there is, in the order of what fails fastest. The seconds are those on two cores after `npm start`
 * (`benches/tests.md`).
 */
import { buildInline } from '../build/inline.mjs';
import { buildThreads } from '../build/threads.mjs';
import { buildVendor } from '../build/vendor.mjs';
import { buildWasm } from '../build/wasm.mjs';
import { docs, docTests, format, lint, nativeTests, unitTests } from './rust.mjs';
import { nodeTests, pageTests, types } from './javascript.mjs';
import { inBrowser, inNode, sameBindings } from './wasm.mjs';

/** @type {import('./step.mjs').Step[]} */
export const steps = [
  { name: 'format', seconds: 2, quick: true, what: 'the layout of the Rust code', run: format },
  { name: 'lint', seconds: 67, quick: true, what: 'clippy', run: lint },
  { name: 'rust-unit', seconds: 90, what: 'the tests beside the code', run: unitTests },
  { name: 'rust-native', seconds: 180, what: 'the tests of the whole library', run: nativeTests },
  { name: 'rust-doc', seconds: 5, what: 'the examples in the documentation', run: docTests },
  { name: 'docs', seconds: 20, quick: true, what: "the documentation's links and examples", run: docs },
  {
    name: 'build',
    seconds: 120,
    what: 'the package, and the size of its wasm',
    run: async (context) => {
      await buildVendor();
      await buildWasm(context);
      await buildThreads(context);
      await buildInline();
    },
  },
  { name: 'bindings', seconds: 7, what: "tools/bindgen beside wasm-bindgen's own command", run: sameBindings },
  { name: 'wasm-node', seconds: 7, what: 'the wasm in Node', run: inNode('wasm_node') },
  { name: 'wasm-browser', seconds: 5, what: "the wasm in Chromium's main thread", run: inBrowser('wasm_browser') },
  { name: 'wasm-worker', seconds: 5, what: 'the wasm in a dedicated worker in Chromium', run: inBrowser('wasm_worker') },
  { name: 'types', seconds: 3, quick: true, what: 'TypeScript over all JavaScript', run: types },
  { name: 'js', seconds: 165, what: 'the package and its command in Node', run: nodeTests },
  { name: 'page', seconds: 500, what: 'the page in Chromium', run: pageTests },
];
