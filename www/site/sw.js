/**
 * Serves one version of the site without a network. The page and the guides are kept when it is installed; pictures of
 * guides and pages of the reference are kept when they are opened.
 */
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
const scope = new URL('./', location.href);

/** Whether an address is that of a document: a guide or a page of the reference, or what belongs to one. @param {URL} url */
const isDocument = ({ href }) => ['guide/', 'reference/'].some((folder) => href.startsWith(new URL(folder, scope).href));

on('fetch', (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method !== 'GET' || url.origin !== location.origin) return;
  event.respondWith((isDocument(url) ? documentFor(request) : fileFor(request)).then(isolated));
});

/**
 * An answer with the headers by which browsers isolate a page from others, so that its memory may be shared with its workers:
 * a server of static files seldom sends them.
 * @param {Response} response
 */
function isolated(response) {
  // A redirection is the browser's own affair.
  if (response.status === 0) return response;
  const headers = new Headers(response.headers);
  headers.set('Cross-Origin-Opener-Policy', 'same-origin');
  headers.set('Cross-Origin-Embedder-Policy', 'require-corp');
  return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}

/** The page or one of its files. @param {Request} request */
async function fileFor(request) {
  const wanted = new URL(request.url).pathname === scope.pathname ? './index.html' : request;
  return (await found(wanted)) ?? fetch(request);
}

/** A document, which is kept from now on. @param {Request} request */
async function documentFor(request) {
  const kept = await found(request);
  if (kept) return kept;
  try {
    const response = await fetch(request);
    if (response.ok) await (await caches.open(NAME)).put(request, response.clone());
    return response;
  } catch (error) {
    const instead = request.mode === 'navigate' && await found('./guide/offline.html');
    if (instead) return instead;
    throw error;
  }
}

/** @param {Request | string} wanted */
async function found(wanted) {
  return (await caches.open(NAME)).match(wanted, { ignoreSearch: true, ignoreVary: true });
}
