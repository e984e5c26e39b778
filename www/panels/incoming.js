/** Files that arrive without a dialog: dropped, pasted, opened with the installed page, or handed over by the system's share sheet. */
import { element } from '../dom.js';

/** Name of the cache in which the service worker (`site/sw.js`) leaves what was shared. */
const SHARED_CACHE_NAME = 'shared with developable';

/** @typedef {{ files: readonly { getFile: () => Promise<File> }[] }} Launch */

/** @param {(files: File[]) => unknown} open */
export function watchIncoming(open) {
  /** @param {File[]} files */
  const take = (files) => files.length > 0 && open(files);
  addEventListener('paste', ({ clipboardData }) => take([...clipboardData?.files ?? []]));
  /** @type {{ launchQueue?: { setConsumer: (take: (launch: Launch) => void) => void } }} */
  const { launchQueue } = /** @type {any} */ (window);
  launchQueue?.setConsumer(async ({ files }) => take(await Promise.all(files.map((file) => file.getFile()))));
  void sharedFiles().then(take, () => {});
}

/** Watches for files that are dropped. @param {(files: File[]) => void} onFiles */
export function watchDrops(onFiles) {
  const overlay = element('drop', HTMLElement);
  /** @param {DragEvent} event */
  const hasFiles = (event) => event.dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragover', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    overlay.hidden = false;
  });
  // Nothing of the page is entered where the page itself is left.
  addEventListener('dragleave', ({ relatedTarget }) => (overlay.hidden ||= relatedTarget === null));
  addEventListener('drop', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    overlay.hidden = true;
    void filesOf(event).then((files) => files.length > 0 && onFiles(files));
  });
}

/** The dropped files, and those in dropped folders. @param {DragEvent} event @returns {Promise<File[]>} */
async function filesOf({ dataTransfer }) {
  // The browser clears `dataTransfer` when the event handler returns, so it is read before any `await`.
  const files = [...dataTransfer?.files ?? []];
  const entries = [...dataTransfer?.items ?? []].map((item) => item.webkitGetAsEntry?.());
  const folders = /** @type {FileSystemDirectoryEntry[]} */ (entries.filter((entry) => entry?.isDirectory));
  if (folders.length === 0) return files;
  const folderFiles = await Promise.all(folders.map(filesIn));
  const names = folders.map(({ name }) => name);
  return [...files.filter(({ name }) => !names.includes(name)), ...folderFiles.flat()];
}

/** The files of a folder, without hidden files and subfolders. @param {FileSystemDirectoryEntry} folder @returns {Promise<File[]>} */
async function filesIn(folder) {
  const reader = folder.createReader();
  /** @type {FileSystemEntry[]} */
  const entries = [];
  for (;;) {
    const batch = await new Promise((/** @type {(entries: FileSystemEntry[]) => void} */ resolve, reject) => reader.readEntries(resolve, reject));
    if (batch.length === 0) break;
    entries.push(...batch);
  }
  const visible = /** @type {FileSystemFileEntry[]} */ (entries.filter(({ isFile, name }) => isFile && !name.startsWith('.')));
  return Promise.all(visible.map((entry) => new Promise((/** @type {(file: File) => void} */ resolve, reject) => entry.file(resolve, reject))));
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
