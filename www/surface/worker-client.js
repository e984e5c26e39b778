/** Calls functions that take longer than a frame in a worker of the page (`worker.js`). */

/** @typedef {typeof import('./worker.js').tasks} Tasks */

/** @type {Worker | null} */
let worker = null;
let lastId = 0;
/** @type {Map<number, { resolve: (value: any) => void, reject: (error: Error) => void }>} */
const pendingCalls = new Map();

/**
 * Calls a task in the worker. The arguments are copied.
 * @template {keyof Tasks} T
 * @param {T} task
 * @param {Parameters<Tasks[T]>} args
 * @returns {Promise<Awaited<ReturnType<Tasks[T]>>>}
 */
export function callWorker(task, ...args) {
  return transferToWorker(task, [], ...args);
}

/**
 * Calls a task in the worker. The buffers of some arrays are transferred, which leaves these arrays empty.
 * @template {keyof Tasks} T
 * @param {T} task
 * @param {readonly { buffer: ArrayBufferLike }[]} arrays
 * @param {Parameters<Tasks[T]>} args
 * @returns {Promise<Awaited<ReturnType<Tasks[T]>>>}
 */
export function transferToWorker(task, arrays, ...args) {
  worker ??= startWorker();
  const id = ++lastId;
  worker.postMessage({ id, task, args }, arrays.map(({ buffer }) => /** @type {ArrayBuffer} */ (buffer)));
  return new Promise((resolve, reject) => pendingCalls.set(id, { resolve, reject }));
}

function startWorker() {
  const made = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  made.addEventListener('message', ({ data: { id, value, error } }) => {
    const asked = pendingCalls.get(id);
    pendingCalls.delete(id);
    if (error === undefined) asked?.resolve(value);
    else asked?.reject(new Error(error));
  });
  made.addEventListener('error', () => {
    worker = null;
    for (const { reject } of pendingCalls.values()) reject(new Error('the page’s worker has failed'));
    pendingCalls.clear();
  });
  return made;
}
