/** Files that were opened last, kept in this browser, so that a reload finds them again. */

/** @typedef {{ id?: number, files: File[], time: number }} Kept */

const [NAME, STORE] = ['developable', 'files'];
/** How many are kept, and bytes of all together. */
const [MOST, ROOM] = [6, 256e6];

/** @returns {Promise<IDBDatabase>} */
function database() {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(NAME, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE, { keyPath: 'id', autoIncrement: true });
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/**
 * @template T
 * @param {IDBTransactionMode} mode
 * @param {(store: IDBObjectStore) => IDBRequest<T>} ask
 * @returns {Promise<T>}
 */
async function store(mode, ask) {
  const open = await database();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = open.transaction(STORE, mode);
      const request = ask(transaction.objectStore(STORE));
      transaction.oncomplete = () => resolve(request.result);
      transaction.onabort = transaction.onerror = () => reject(transaction.error);
    });
  } finally {
    open.close();
  }
}

/** The latest first. @returns {Promise<(Kept & { id: number })[]>} none where the browser keeps nothing */
export async function recentFiles() {
  const all = await store('readonly', (files) => files.getAll()).catch(() => []);
  return all.sort((a, b) => b.time - a.time);
}

/** @param {number} id */
export async function keptFiles(id) {
  const kept = await store('readonly', (files) => files.get(id)).catch(() => undefined);
  return /** @type {Kept | undefined} */ (kept)?.files;
}

/**
 * Keeps what was opened, and lets go of the oldest.
 * @param {readonly File[]} opened
 * @returns {Promise<number | undefined>} its number, where it could be kept
 */
export async function keepFiles(opened) {
  const size = sizeOf(opened);
  if (size > ROOM / 2) return undefined;
  try {
    const recent = await recentFiles();
    const same = recent.find(({ files }) => marksOf(files) === marksOf(opened));
    let room = ROOM - size;
    for (const [i, { id, files }] of recent.filter((one) => one !== same).entries()) {
      room -= sizeOf(files);
      if (i >= MOST - 1 || room < 0) await store('readwrite', (all) => all.delete(id));
    }
    return Number(await store('readwrite', (all) => all.put({ ...(same && { id: same.id }), files: [...opened], time: Date.now() })));
  } catch {
    // A private window, or a full disk: it works without.
    return undefined;
  }
}

/** @param {readonly File[]} files */
export function namesOf(files) {
  return files.map(({ name }) => name).join(', ');
}

/** What tells files from others. @param {readonly File[]} files */
function marksOf(files) {
  return files.map(({ name, size, lastModified }) => `${name} ${size} ${lastModified}`).sort().join();
}

/** @param {readonly File[]} files */
function sizeOf(files) {
  return files.reduce((sum, { size }) => sum + size, 0);
}
