/** Tasks in workers, which can be cancelled. */

/** @typedef {InstanceType<Api['DevelopableWorker']>} Worker */

/** Runs a task in a new worker, which is disposed of when the task ends or is aborted. @template T @param {Api} api @param {AbortSignal} signal @param {(worker: Worker) => Promise<T>} task */
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

/** Idle time after which a worker is disposed of, in milliseconds. */
export const WORKER_IDLE_MS = 5000;

/** Tasks that share a worker, which is disposed of when they are cancelled and when it is idle; and their answers, each found once. */
export class Tasks {
  #Worker;
  /** @type {Worker | null} */
  #worker = null;
  /** Number of running tasks. */
  #runningTasks = 0;
  #idleTimer = 0;
  /** Answers by their questions about an object, which are freed together with it. @type {WeakMap<object, Map<string, Promise<any>>>} */
  #answers = new WeakMap();
  /** Forgets the answers that are not there yet. @type {Set<() => void>} */
  #pending = new Set();

  /** @param {Api['DevelopableWorker']} Worker class of their worker */
  constructor(Worker) {
    this.#Worker = Worker;
  }

  /** @template T @param {(worker: Worker) => Promise<T>} task */
  async run(task) {
    clearTimeout(this.#idleTimer);
    const worker = (this.#worker ??= new this.#Worker());
    this.#runningTasks++;
    try {
      return await task(worker);
    } finally {
      if (worker === this.#worker && --this.#runningTasks === 0) this.#idleTimer = window.setTimeout(() => this.#dispose(), WORKER_IDLE_MS);
    }
  }

  /** The answer to a question: the cached one, or that of a new task; a failed answer is not kept. @template T @param {object} subject @param {string} question its key @param {(worker: Worker) => Promise<T>} task @returns {Promise<T>} */
  answer(subject, question, task) {
    const answers = this.#answers.get(subject) ?? new Map();
    this.#answers.set(subject, answers);
    const cached = answers.get(question);
    if (cached) return cached;
    const answer = this.run(task);
    answers.set(question, answer);
    const forget = () => void answers.delete(question);
    this.#pending.add(forget);
    answer.catch(forget).finally(() => this.#pending.delete(forget));
    return answer;
  }

  /** Cancels all running tasks; their promises reject. */
  stop() {
    // Their questions may be asked again before they have rejected.
    for (const forget of this.#pending) forget();
    if (this.#runningTasks > 0) this.#dispose();
  }

  #dispose() {
    this.#worker?.dispose();
    this.#worker = null;
    this.#runningTasks = 0;
  }
}
