/** Storage of the files that were opened last, in IndexedDB, so that a reload of the page can open them again. */

/** @typedef {{ id?: number, files: File[], time: number, arePhotos?: boolean }} RecentFiles `arePhotos`: whether they are photos of pages */
/** @typedef {{ id: number, states: (PageState | null)[], shown?: number }} StoredOutlines outlines of the photos of an entry, and which photo is shown: these change more often than the files */

const DATABASE_NAME = 'developable';
/** Maximum number of entries in the storage. */
const MAX_ENTRIES = 6;
/** Maximum size of all stored files together, in bytes. */
const MAX_STORED_BYTES = 256e6;

/** @returns {Promise<IDBDatabase>} */
function database() {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE_NAME, 2);
    request.onupgradeneeded = ({ oldVersion }) => {
      if (oldVersion < 1) request.result.createObjectStore('files', { keyPath: 'id', autoIncrement: true });
      request.result.createObjectStore('outlines', { keyPath: 'id' });
    };
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/**
 * Makes one request to the storage, in a transaction of its own.
 * @template T
 * @param {'files' | 'outlines'} storeName
 * @param {IDBTransactionMode} mode
 * @param {(store: IDBObjectStore) => IDBRequest<T>} makeRequest
 * @returns {Promise<T>}
 */
async function requestStore(storeName, mode, makeRequest) {
  const open = await database();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = open.transaction(storeName, mode);
      const request = makeRequest(transaction.objectStore(storeName));
      transaction.oncomplete = () => resolve(request.result);
      transaction.onabort = transaction.onerror = () => reject(transaction.error);
    });
  } finally {
    open.close();
  }
}

/** All entries of the storage, the newest first. @returns {Promise<(RecentFiles & { id: number })[]>} empty if the browser stores nothing */
export async function recentFiles() {
  const all = await requestStore('files', 'readonly', (files) => files.getAll()).catch(() => []);
  return all.sort((a, b) => b.time - a.time);
}

/** The files of one entry, or undefined if there is none. @param {number} id */
export async function storedFiles(id) {
  const entry = await requestStore('files', 'readonly', (files) => files.get(id)).catch(() => undefined);
  return /** @type {RecentFiles | undefined} */ (entry)?.files;
}

/** The outlines of the photos of one entry; an empty list if there are none. @param {number} id @returns {Promise<StoredOutlines>} */
export async function storedOutlines(id) {
  const entry = await requestStore('outlines', 'readonly', (outlines) => outlines.get(id)).catch(() => undefined);
  return entry ?? { id, states: [] };
}

/** Stores the outlines of the photos of one entry, if the browser stores anything. @param {StoredOutlines} stored */
export async function storeOutlines(stored) {
  await requestStore('outlines', 'readwrite', (outlines) => outlines.put(stored)).catch(() => {});
}

/**
 * Stores files that were opened, and deletes the oldest entries where there are too many.
 * @param {readonly File[]} opened
 * @param {{ arePhotos?: boolean, id?: number }} [about] `id`: id of the entry that they take the place of
 * @returns {Promise<number | undefined>} id of the entry; undefined if the files could not be stored
 */
export async function storeFiles(opened, { arePhotos, id: replacedId } = {}) {
  const size = sizeOf(opened);
  if (size > MAX_STORED_BYTES / 2) return undefined;
  try {
    const recent = await recentFiles();
    const same = recent.find(({ id, files }) => id === replacedId || (replacedId === undefined && fingerprint(files) === fingerprint(opened)));
    let freeBytes = MAX_STORED_BYTES - size;
    for (const [i, { id, files }] of recent.filter((one) => one !== same).entries()) {
      freeBytes -= sizeOf(files);
      if (i < MAX_ENTRIES - 1 && freeBytes >= 0) continue;
      await requestStore('files', 'readwrite', (all) => all.delete(id));
      await requestStore('outlines', 'readwrite', (all) => all.delete(id));
    }
    return Number(await requestStore('files', 'readwrite', (all) => all.put({ ...(same && { id: same.id }), files: [...opened], arePhotos, time: Date.now() })));
  } catch {
    // A private window, or a full disk: the page works without the storage.
    return undefined;
  }
}

/** A key that is equal for equal files. @param {readonly File[]} files */
const fingerprint = (files) => files.map(({ name, size, lastModified }) => `${name} ${size} ${lastModified}`).sort().join();

/** Size of all files together, in bytes. @param {readonly File[]} files */
const sizeOf = (files) => files.reduce((sum, { size }) => sum + size, 0);
