/** Tasks that can be cancelled, each in a worker of its own, which ends with it; and a cache of their answers. */

/** @import {Api} from './api.js' */
/** @typedef {InstanceType<Api['DevelopableWorker']>} Worker */

/**
 * Runs a task in a new worker, which is disposed of when the task ends or is aborted.
 * @template T
 * @param {Api} api
 * @param {AbortSignal} signal
 * @param {(worker: Worker) => Promise<T>} task
 * @returns {Promise<T>}
 */
export async function runInWorker(api, signal, task) {
  signal.throwIfAborted();
  const worker = new api.DevelopableWorker();
  const dispose = () => worker.dispose();
  signal.addEventListener('abort', dispose);
  try {
    return await task(worker);
  } finally {
    signal.removeEventListener('abort', dispose);
    dispose();
  }
}

/** Cache of answers to questions about objects. The answers about an object are freed together with it. */
export class AnswerCache {
  /** @type {WeakMap<object, Map<string, Promise<any>>>} */
  #answers = new WeakMap();

  /**
   * The answer to a question: the cached one, or a new one. A failed answer is not kept, so that the question may be asked again.
   * @template T
   * @param {object} subject
   * @param {string} question key of the question
   * @param {() => Promise<T>} compute
   * @returns {Promise<T>}
   */
  answer(subject, question, compute) {
    const answers = this.#answers.get(subject) ?? new Map();
    this.#answers.set(subject, answers);
    const cached = answers.get(question);
    if (cached) return cached;
    const answer = compute();
    answers.set(question, answer);
    answer.catch(() => answers.delete(question));
    return answer;
  }
}
