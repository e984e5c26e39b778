/**
 * Every test there is, in the order of what fails fastest in each lane. The seconds are those on two cores after `npm start`, with
 * no other step beside it (`benches/tests.md`).
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
  { name: 'format', lane: 'cargo', seconds: 2, quick: true, what: 'the layout of the Rust code', run: format },
  { name: 'size', lane: 'cargo', seconds: 1, quick: true, what: 'lines and tuned constants beside their budgets', run: size },
  { name: 'types', lane: 'cargo', seconds: 8, quick: true, what: 'TypeScript over all JavaScript, with the types that Rust gives', run: types },
  { name: 'lint', lane: 'cargo', seconds: 67, quick: true, what: 'clippy', run: lint },
  { name: 'rust', lane: 'cargo', seconds: 180, what: 'the tests beside the code, and those of the whole library', run: rustTests },
  { name: 'rust-doc', lane: 'cargo', seconds: 20, what: 'the examples in the documentation', run: docTests },
  { name: 'docs', lane: 'cargo', seconds: 20, what: "the documentation's links and examples", run: docs },
  {
    name: 'build',
    lane: 'node',
    seconds: 20,
    what: 'the package, and the size of its wasm',
    run: async (context) => {
      await buildVendor();
      await buildWasm(context);
      await buildThreads(context);
      await buildInline();
    },
  },
  { name: 'wasm-node', lane: 'node', seconds: 7, what: 'the wasm in Node', run: inNode('wasm_node') },
  { name: 'wasm-browser', lane: 'node', seconds: 5, what: "the wasm in Chromium's main thread", run: inBrowser('wasm_browser') },
  { name: 'wasm-worker', lane: 'node', seconds: 5, what: 'the wasm in a dedicated worker in Chromium', run: inBrowser('wasm_worker') },
  { name: 'js', lane: 'node', seconds: 85, what: 'the package and its command in Node', run: nodeTests },
  { name: 'page', lane: 'node', seconds: 190, what: 'the page in Chromium', run: pageTests },
];
