/** Serves one version of the page, all of it kept when it was installed, so that it works without a network. */
/**
 * @typedef {Event & { waitUntil: (done: Promise<unknown>) => void, request: Request, respondWith: (response: Promise<Response>) => void }} Occasion
 * @typedef {typeof globalThis & { SITE: { version: string, files: string[] }, skipWaiting: () => Promise<void> }} Globals
 */
const worker = /** @type {Globals} */ (globalThis);
const { version, files } = worker.SITE;
const PREFIX = 'developable ';
const NAME = PREFIX + version;

/** @param {string} name @param {(event: Occasion) => void} act */
const on = (name, act) => worker.addEventListener(name, (event) => act(/** @type {Occasion} */ (event)));

on('install', (event) => {
  // From the server, not from what the browser has kept of an older version.
  event.waitUntil(caches.open(NAME).then((cache) => cache.addAll(files.map((file) => new Request(file, { cache: 'reload' })))));
});
on('activate', (event) => {
  event.waitUntil(caches.keys().then((names) =>
    Promise.all(names.filter((name) => name.startsWith(PREFIX) && name !== NAME).map((name) => caches.delete(name)))));
});
worker.addEventListener('message', ({ data }) => {
  if (data === 'take over') void worker.skipWaiting();
});
on('fetch', (event) => {
  const { request } = event;
  if (request.method !== 'GET' || new URL(request.url).origin !== location.origin) return;
  const wanted = request.mode === 'navigate' ? './index.html' : request;
  event.respondWith(caches.open(NAME)
    .then((cache) => cache.match(wanted, { ignoreSearch: true, ignoreVary: true }))
    .then((kept) => kept ?? fetch(request)));
});
