/** The client's end of a solve in the worker. */
import { PROGRESS_INTERVAL } from './progress.js';

/**
 * @typedef {import('./connection.js').Remote} Remote
 * @typedef {import('./control.js').Control} Control
 */

/** Number of the last solve: numbers are chosen here, so that a solve can be stopped at any time. */
let solves = 0;

/**
 * Starts a solve, tells of its progress and waits for its surface.
 * @param {Remote} remote
 * @param {(id: number, interval: number) => Promise<void>} start
 * @param {Control} control
 * @returns {Promise<any>} the surface: of heights or of a mesh, as was started
 */
export async function solve(remote, start, { signal, keep, onProgress }) {
  if (!keep) signal?.throwIfAborted();
  const id = (solves += 1);
  /** @param {boolean} keep */
  const stop = (keep) => void remote.stop(id, keep).catch(() => {});
  const onAbort = () => stop(keep);
  signal?.addEventListener('abort', onAbort);
  try {
    const started = start(id, onProgress ? PROGRESS_INTERVAL : Infinity);
    if (signal?.aborted) stop(keep);
    await started;
    for (;;) {
      // Asked for piece by piece, so that a busy page is not flooded with old news.
      const { progress, surface } = await remote.next(id);
      // Awaited, so that a promise that is rejected ends the solve as an exception does.
      await onProgress?.(progress);
      if (surface) return surface;
    }
  } catch (error) {
    stop(false); // it may be `onProgress` that failed
    throw error;
  } finally {
    signal?.removeEventListener('abort', onAbort);
  }
}

/**
 * The same promise, but that it does not wait for the worker to hear of an abort.
 * @template T
 * @param {Promise<T>} promise
 * @param {Control} control
 * @returns {Promise<T>}
 */
export function orAborted(promise, { signal, keep }) {
  if (!signal || keep) return promise;
  return new Promise((resolve, reject) => {
    const abort = () => reject(signal.reason);
    signal.addEventListener('abort', abort);
    promise.then(resolve, reject).finally(() => signal.removeEventListener('abort', abort));
  });
}
