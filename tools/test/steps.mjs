/**
 * Every test there is, in the order of what fails fastest. Those of JavaScript and of wasm run beside those of Rust, once what they need
 * is set up. The seconds are those on two idle cores after `npm start`, of each step by itself (`benches/tests.md`).
 */
import { buildInline } from '../build/inline.mjs';
import { buildThreads } from '../build/threads.mjs';
import { buildVendor } from '../build/vendor.mjs';
import { buildWasm } from '../build/wasm.mjs';
import { docs, docTests, format, lint, rustTests } from './rust.mjs';
import { nodeTests, pageTests, size, types } from './javascript.mjs';
import { inBrowser, inNode } from './wasm.mjs';

/** @type {import('./step.mjs').Step[]} */
export const steps = [
  { name: 'format', seconds: 2, quick: true, what: 'the layout of the Rust code', run: format },
  { name: 'size', seconds: 1, quick: true, what: 'lines and tuned constants beside their budgets', run: size },
  { name: 'lint', seconds: 83, quick: true, what: 'clippy', run: lint },
  { name: 'rust', seconds: 240, what: 'the tests beside the code, and those of the whole library', run: rustTests },
  { name: 'rust-doc', seconds: 20, what: 'the examples in the documentation', run: docTests },
  { name: 'docs', seconds: 20, what: "the documentation's links and examples", run: docs },
  {
    name: 'build',
    seconds: 20,
    beside: true,
    what: 'the package, and the size of its wasm',
    run: async (context) => {
      await buildVendor();
      await buildWasm(context);
      await buildThreads(context);
      await buildInline();
    },
  },
  { name: 'types', seconds: 8, quick: true, beside: true, what: 'TypeScript over all JavaScript, with the types that Rust gives', run: types },
  { name: 'wasm-node', seconds: 7, beside: true, what: 'the wasm in Node', run: inNode('wasm_node') },
  { name: 'wasm-browser', seconds: 5, beside: true, what: "the wasm in Chromium's main thread", run: inBrowser('wasm_browser') },
  { name: 'wasm-worker', seconds: 5, beside: true, what: 'the wasm in a dedicated worker in Chromium', run: inBrowser('wasm_worker') },
  { name: 'js', seconds: 120, beside: true, what: 'the package and its command in Node', run: nodeTests },
  { name: 'page', seconds: 190, beside: true, what: 'the page in Chromium', run: pageTests },
];
