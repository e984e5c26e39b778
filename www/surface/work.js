/** What takes longer than a frame, done in a worker of the page's own. */

/** @typedef {typeof import('./worker.js').tasks} Tasks */

/** @type {Worker | null} */
let worker = null;
let last = 0;
/** @type {Map<number, { resolve: (value: any) => void, reject: (error: Error) => void }>} */
const open = new Map();

/**
 * Arguments are copied.
 * @template {keyof Tasks} T
 * @param {T} task
 * @param {Parameters<Tasks[T]>} args
 * @returns {Promise<Awaited<ReturnType<Tasks[T]>>>}
 */
export function work(task, ...args) {
  return handOver(task, [], ...args);
}

/**
 * The same, but that some arrays are handed over and gone afterwards.
 * @template {keyof Tasks} T
 * @param {T} task
 * @param {readonly { buffer: ArrayBufferLike }[]} arrays
 * @param {Parameters<Tasks[T]>} args
 * @returns {Promise<Awaited<ReturnType<Tasks[T]>>>}
 */
export function handOver(task, arrays, ...args) {
  worker ??= started();
  const id = ++last;
  worker.postMessage({ id, task, args }, arrays.map(({ buffer }) => /** @type {ArrayBuffer} */ (buffer)));
  return new Promise((resolve, reject) => open.set(id, { resolve, reject }));
}

function started() {
  const made = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  made.addEventListener('message', ({ data: { id, value, error } }) => {
    const asked = open.get(id);
    open.delete(id);
    if (error === undefined) asked?.resolve(value);
    else asked?.reject(new Error(error));
  });
  made.addEventListener('error', () => {
    worker = null;
    for (const { reject } of open.values()) reject(new Error('the page’s worker has failed'));
    open.clear();
  });
  return made;
}
