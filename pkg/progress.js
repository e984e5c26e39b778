/** Progress of calls, told to their callers. */
import { DevelopableError } from './errors.js';

/** @typedef {(progress: import('./types.js').CallProgress) => unknown} OnProgress */

/** Milliseconds between two calls of `onProgress`, at least. */
export const PROGRESS_INTERVAL = 60;

/**
 * What `onProgress` returns, where it is called by the synchronous API. A promise is refused: nothing can wait for it here, and
 * nobody would hear of its rejection.
 * @template P
 * @param {((progress: P) => unknown) | undefined} onProgress
 * @param {P} progress
 */
export function answerOf(onProgress, progress) {
  const answer = onProgress?.(progress);
  if (typeof Object(answer).then !== 'function') return answer;
  Promise.resolve(answer).catch(() => {});
  throw new DevelopableError(
    'OPTION',
    'option `onProgress` returned a promise, for which this call cannot wait: pass a function that is not async, or use the promise API',
  );
}

/**
 * A port by which a worker tells how far a call is, and the end of that at the caller's. `onProgress` is called with one
 * fraction after the other, and awaited if it returns a promise.
 * @param {OnProgress} onProgress
 */
export function progressPort(onProgress) {
  const { port1, port2 } = new MessageChannel();
  /** What `onProgress` has returned so far. */
  let told = Promise.resolve();
  let isOpen = true;
  port1.onmessage = ({ data: fraction }) => {
    // The end is told with the result.
    if (!isOpen || fraction === 1) return;
    told = told.then(async () => void await onProgress({ fraction }));
    // The call rejects when it has ended.
    told.catch(() => {});
  };
  return {
    port: port2,
    /** Resolves when all has been told. */
    async end() {
      isOpen = false;
      port1.close();
      await told;
    },
  };
}
