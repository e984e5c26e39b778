/**
 * `npm run wasm-pack`: shows that wasm-pack's usual commands work in the checkout. Nothing else
 * here depends on wasm-pack.
 */
import { dirname } from 'node:path';
import { cargoInstall } from './setup/cargo-install.mjs';
import { setupTests } from './setup.mjs';
import { check } from './test/step.mjs';
import { withPath } from './util/env.mjs';
import { main, Problem } from './util/problem.mjs';

const version = '0.15.1';

await main(async () => {
  const { env, browser } = await setupTests();
  const folder = await cargoInstall('wasm-pack', version, {
    time: 'about 2 minutes',
    source: ['wasm-pack', '--version', version, '--locked'],
  });
  const path = withPath(env, folder, ...(browser.driver ? [dirname(browser.driver)] : []));
  const tests = { ...path, WASM_BINDGEN_TEST_TIMEOUT: '300' };

  await check('wasm-pack', ['build', 'wasm/solver', '--out-dir', '../../target/wasm-pack'], path);
  await check('wasm-pack', ['test', '--node'], tests);
  await check('wasm-pack', ['test', '--node', 'examples/apps/wasm-pack'], tests);
  if (!browser.chrome || !browser.driver) {
    throw new Problem('No browser with a driver was found for wasm-pack test --headless --chrome: install Chromium and chromedriver.');
  }
  await check('wasm-pack', ['test', '--headless', '--chrome'], tests);
});
