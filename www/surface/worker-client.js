/** Calls functions that take longer than a frame in a worker of the page (`worker.js`). */

/** @typedef {typeof import('./worker.js').tasks} Tasks */

/** Started with the first call, and after a failure. @type {Promise<{ worker: Worker, tasks: any }> | null} */
let started = null;

/** The import is dynamic, so that the page can report that there is no package. */
async function start() {
  const { wrap } = await import('../../pkg/wire.js');
  const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  worker.addEventListener('error', () => (started = null));
  return { worker, tasks: wrap(worker) };
}

/** Starts the worker before its first task, unless it runs. */
export const startWorker = () => (started ??= start());

/**
 * Calls a task in the worker. The arguments are copied, or handed over by Comlink's `transfer`.
 * @template {keyof Tasks} T
 * @param {T} task
 * @param {Parameters<Tasks[T]>} args
 * @returns {Promise<Awaited<ReturnType<Tasks[T]>>>}
 */
export async function callWorker(task, ...args) {
  const { worker, tasks } = await startWorker();
  const ended = new AbortController();
  return new Promise((resolve, reject) => {
    worker.addEventListener('error', () => reject(new Error('the page’s worker has failed')), { signal: ended.signal });
    tasks[task](...args).then(resolve, reject);
  }).finally(() => ended.abort());
}
