/** What may be given up, each in a worker of its own, which ends with it. */

/** @import {Api} from './api.js' */
/** @import {Slow} from './session.js' */
/** @typedef {InstanceType<Api['DevelopableWorker']>} Worker */

/** Milliseconds for a byte of a file, until that was measured. */
const EACH = 2e-5;

/** @param {File} file @returns {Slow} */
export function readingOf({ name, size }) {
  return { words: 'Reading the file', kind: name.slice(name.lastIndexOf('.') + 1).toLowerCase(), size, each: EACH };
}

/**
 * @template T
 * @param {Api} api
 * @param {AbortSignal} signal
 * @param {(worker: Worker) => Promise<T>} work
 * @returns {Promise<T>}
 */
export async function apart(api, signal, work) {
  signal.throwIfAborted();
  const worker = new api.DevelopableWorker();
  const end = () => worker.dispose();
  signal.addEventListener('abort', end);
  try {
    return await work(worker);
  } finally {
    signal.removeEventListener('abort', end);
    end();
  }
}
