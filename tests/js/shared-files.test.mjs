/** The service worker's part of the share sheet. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { runInNewContext } from 'node:vm';

test('files of the same name that are shared at once are all kept, each under its own name', async () => {
  /** @type {Map<string, Promise<string>>} */
  const kept = new Map();
  const cache = { put: (/** @type {URL} */ { pathname }, /** @type {Response} */ response) => kept.set(pathname, response.text()) };
  /** @type {Record<string, (event: object) => void>} */
  const listeners = {};
  runInNewContext(await readFile(new URL('../../www/site/sw.js', import.meta.url), 'utf8'), {
    SITE: { version: '1', files: [] },
    location: new URL('https://example.org/app/sw.js'),
    caches: { open: async () => cache },
    addEventListener: (/** @type {string} */ name, /** @type {() => void} */ act) => (listeners[name] = act),
    URL, Response, File,
  });
  const body = new FormData();
  for (const text of ['first', 'second']) body.append('files', new File([text], 'IMG 7.png'));
  const request = new Request('https://example.org/app/share', { method: 'POST', body });
  /** @type {Response} */
  const answer = await new Promise((respondWith) => listeners.fetch({ request, respondWith }));
  assert.equal(answer.status, 303);
  assert.deepEqual(await Promise.all(kept.values()), ['first', 'second']);
  for (const path of kept.keys()) assert.equal(path.split('/').pop(), 'IMG%207.png');
});
