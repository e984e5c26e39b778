/** Files are read in a worker of their own, which ends with them, or when they are given up. */

/** @import {Api} from './api.js' */
/** @typedef {InstanceType<Api['DevelopableWorker']>} Reader */

/**
 * @template T
 * @param {Api} api
 * @param {AbortSignal} signal
 * @param {(reader: Reader) => Promise<T>} read
 * @returns {Promise<T>}
 */
export async function reading(api, signal, read) {
  signal.throwIfAborted();
  const reader = new api.DevelopableWorker();
  const end = () => reader.dispose();
  signal.addEventListener('abort', end);
  try {
    return await read(reader);
  } finally {
    signal.removeEventListener('abort', end);
    end();
  }
}
