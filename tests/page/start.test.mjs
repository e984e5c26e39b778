/** What the page says where it cannot work. */
import assert from 'node:assert/strict';
import { brokenStartTest } from './support/page.mjs';

/** @typedef {import('playwright-core').Page} Page */

/** @type {{ what: string, spoil: (page: Page) => Promise<unknown>, says: RegExp }[]} */
const cases = [
  { what: 'the wasm', spoil: (page) => page.route(/\.wasm$|\/inline\//, (route) => route.abort()), says: /wasm/i },
  { what: 'the package', spoil: (page) => page.route('**/pkg/**', (route) => route.abort()), says: /pkg|import/i },
  { what: 'WebAssembly', spoil: (page) => page.addInitScript('delete globalThis.WebAssembly'), says: /no WebAssembly/ },
  { what: 'web workers', spoil: (page) => page.addInitScript('delete globalThis.Worker'), says: /no web workers/ },
];

for (const { what, spoil, says } of cases) {
  brokenStartTest(`without ${what} the page says that it cannot start`, spoil, async (page) => {
    const message = await page.getByRole('alert').innerText();
    assert.match(message, /could not be started/);
    assert.match(message, says);
    assert.match(await page.locator('#verdict').innerText(), /could not start/);
  });
}
