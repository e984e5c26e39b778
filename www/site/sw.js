/**
 * The service worker: serves one version of the site without a network. The page and the guides are cached at installation;
 * pictures of guides, pages of the reference, text recognition, pdf.js and libheif are cached when they are opened.
 */
/**
 * @typedef {Event & { waitUntil: (done: Promise<unknown>) => void, data: unknown, request: Request, respondWith: (response: Promise<Response>) => void }} WorkerEvent
 * @typedef {typeof globalThis & { SITE: { version: string, files: string[] }, skipWaiting: () => Promise<void>,
 *   clients: { matchAll: (which: object) => Promise<Array<{ postMessage: (message: string) => void }>> } }} Globals
 */
const worker = /** @type {Globals} */ (globalThis);
const { version, files } = worker.SITE;
const scope = new URL('./', location.href);
/** Other folders of the same host may hold other copies of the site. */
const CACHE_PREFIX = `developable ${scope.pathname} `;
const OWN_CACHE = CACHE_PREFIX + version;

/**
 * The names of the site's caches, the oldest first. Whichever worker is active serves from the oldest: a new version is
 * served as soon as the older ones are deleted, though browsers keep its worker waiting until all requests to the old
 * worker are answered.
 */
const cacheNames = async () => (await caches.keys()).filter((name) => name.startsWith(CACHE_PREFIX));
const deleteOtherCaches = async () => Promise.all((await cacheNames()).filter((name) => name !== OWN_CACHE).map((name) => caches.delete(name)));
const servedCache = async () => caches.open((await cacheNames())[0] ?? OWN_CACHE);

/** @param {string} name @param {(event: WorkerEvent) => void} act */
const listen = (name, act) => worker.addEventListener(name, (event) => act(/** @type {WorkerEvent} */ (event)));

listen('install', (event) => {
  event.waitUntil(keepAll());
});
listen('activate', (event) => event.waitUntil(deleteOtherCaches()));
listen('message', (event) => {
  if (event.data === 'take over') event.waitUntil(takeOver());
});

/** Fetches the files one by one, since the page may need the network too. */
async function keepAll() {
  const cache = await caches.open(OWN_CACHE);
  // The browser's own cache may hold files of an older version: the server is asked, and sends only those that have changed.
  for (const file of files) await cache.add(new Request(file, { cache: 'no-cache' }));
}

/** Serves this version from now on, and lets all tabs reload, because the files of the old version are deleted. */
async function takeOver() {
  void worker.skipWaiting();
  await deleteOtherCaches();
  for (const tab of await worker.clients.matchAll({ includeUncontrolled: true })) tab.postMessage('renewed');
}

/** Whether a file is cached when it is opened: of a guide, of the reference, of text recognition, pdf.js or libheif. @param {URL} url */
const isCachedLater = ({ href }) => ['guide/', 'reference/', 'assets/text-', 'assets/pdf-', 'assets/heif-'].some((start) => href.startsWith(new URL(start, scope).href));

listen('fetch', (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method === 'POST' && url.href === new URL('./share', scope).href) return event.respondWith(takeShared(request));
  if (request.method !== 'GET' || url.origin !== location.origin) return;
  event.respondWith((isCachedLater(url) ? laterFileFor(request) : fileFor(request)).then(isolated));
});

/** Adds the headers of cross-origin isolation to a response. Shared memory needs them, and servers of static files seldom send them. @param {Response} response */
function isolated(response) {
  // An opaque response, such as a redirection, cannot be changed.
  if (response.status === 0) return response;
  const headers = new Headers(response.headers);
  headers.set('Cross-Origin-Opener-Policy', 'same-origin');
  headers.set('Cross-Origin-Embedder-Policy', 'require-corp');
  return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}

/** Leaves shared files in a cache for the page, which opens them at its start (`panels/incoming.js`). @param {Request} request */
async function takeShared(request) {
  const files = (await request.formData()).getAll('files');
  const cache = await caches.open('shared with developable');
  for (const [index, file] of files.entries()) {
    // Files of the same name may come from several folders.
    if (file instanceof File) await cache.put(new URL(`./shared/${index}/${encodeURIComponent(file.name)}`, scope), new Response(file));
  }
  return Response.redirect(scope.href, 303);
}

/** The response for the page or one of its files. @param {Request} request */
async function fileFor(request) {
  const wanted = new URL(request.url).pathname === scope.pathname ? './index.html' : request;
  return (await cachedResponse(wanted)) ?? fetch(request);
}

/** The response for a file that is cached when it is opened. @param {Request} request */
async function laterFileFor(request) {
  const kept = await cachedResponse(request);
  if (kept) return kept;
  try {
    const response = await fetch(request);
    if (response.ok) await (await servedCache()).put(request, response.clone());
    return response;
  } catch (error) {
    const instead = request.mode === 'navigate' && await cachedResponse('./guide/offline.html');
    if (instead) return instead;
    throw error;
  }
}

/** The cached response for a request. @param {Request | string} wanted */
async function cachedResponse(wanted) {
  return (await servedCache()).match(wanted, { ignoreSearch: true, ignoreVary: true });
}
