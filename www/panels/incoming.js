/** Files that arrive without a dialog: pasted, opened with the installed page, or handed over by the system's share sheet. */

/** Name of the cache in which the service worker (`site/sw.js`) leaves what was shared. */
const SHARED_CACHE_NAME = 'shared with developable';

/** @typedef {{ files: readonly { getFile: () => Promise<File> }[] }} Launch */

/** @param {(files: File[]) => unknown} open */
export function watchIncoming(open) {
  /** @param {File[]} files */
  const take = (files) => {
    if (files.length > 0) open(files);
  };
  addEventListener('paste', ({ clipboardData }) => take([...clipboardData?.files ?? []]));
  /** @type {{ launchQueue?: { setConsumer: (take: (launch: Launch) => void) => void } }} */
  const { launchQueue } = /** @type {any} */ (window);
  launchQueue?.setConsumer(async ({ files }) => take(await Promise.all(files.map((file) => file.getFile()))));
  void sharedFiles().then(take, () => {});
}

/** The files that were shared with the page, once. @returns {Promise<File[]>} */
async function sharedFiles() {
  if (!('caches' in window) || !(await caches.has(SHARED_CACHE_NAME))) return [];
  const cache = await caches.open(SHARED_CACHE_NAME);
  const files = await Promise.all((await cache.keys()).map(async (request) => {
    const response = await cache.match(request);
    const name = decodeURIComponent(new URL(request.url).pathname.split('/').pop() ?? '');
    return new File([await /** @type {Response} */ (response).blob()], name, { type: response?.headers.get('Content-Type') ?? '' });
  }));
  await caches.delete(SHARED_CACHE_NAME);
  return files;
}
