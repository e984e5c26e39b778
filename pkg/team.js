/** Helpers of a worker's solver: further workers with the same script, probed before they are relied on. */
import { hardwareThreads } from './platform.js';
import { reportCrash } from './helper-start.js';
import { wrap } from './wire.js';

/**
 * @typedef {import('./connection.js').Remote} Remote
 * @typedef {import('./thread.js').Thread} Thread
 * @typedef {'options' | 'isolation' | 'build' | 'system' | 'cores'} ThreadLimit why a solve does not run on more threads
 */

/** Milliseconds that a helper may take to start, and all helpers to join. */
const HELPER_START_LIMIT_MS = 3000;

export class Team {
  /** @type {{ thread: Thread, remote: Remote }[]} */
  #helpers = [];
  #wanted;
  /** @type {ThreadLimit} */
  #limit = 'options';

  /** @param {number} threads that were asked for, the solver's own among them */
  constructor(threads) {
    const usable = Math.min(threads, hardwareThreads());
    this.#wanted = usable - 1;
    if (usable < threads) this.#limit = 'cores';
  }

  /** Why there are not more helpers. */
  get limit() {
    return this.#limit;
  }

  /** Number of helpers. */
  get size() {
    return this.#helpers.length;
  }

  /**
   * Starts the helpers, and keeps those whose writes to shared memory are seen here.
   * @param {() => Thread} begin
   */
  async start(begin) {
    if (this.#wanted < 1) return;
    const memory = sharedPage();
    if (!memory) return this.dismiss('isolation');
    try {
      while (this.#helpers.length < this.#wanted) {
        const thread = begin();
        this.#helpers.push({ thread, remote: /** @type {Remote} */ (wrap(thread.endpoint)) });
        thread.hold(false);
      }
    } catch {
      this.#limit = 'system';
    }
    await this.#keep(({ remote }) => remote.countIn(memory));
    const [seen] = new Int32Array(memory.buffer);
    if (seen < this.#helpers.length) this.dismiss('system');
  }

  /**
   * Lets the helpers join the solver's team.
   * @param {import('./helper-start.js').HelperStart[]} starts
   */
  async join(starts) {
    const joined = Promise.all(this.#helpers.map(async ({ thread, remote }, index) => {
      const start = starts[index];
      // Without this the solver would wait for ever for a helper that is killed at work.
      thread.ended.then(() => reportCrash(start));
      await remote.becomeHelper(start);
    }));
    // A late helper joins all the same: to end it might end it at work.
    const all = await Promise.race([joined.then(() => true, () => false), timeLimit()]);
    if (!all) this.#limit = 'system';
  }

  /** Ends all helpers. @param {ThreadLimit} [limit] why */
  dismiss(limit = this.#limit) {
    this.#limit = limit;
    for (const { thread } of this.#helpers) thread.terminate();
    this.#helpers = [];
  }

  /**
   * Keeps the helpers that do something in time.
   * @param {(helper: { thread: Thread, remote: Remote }, index: number) => Promise<void>} act
   */
  async #keep(act) {
    const helpers = this.#helpers;
    const kept = await Promise.all(helpers.map(async (helper, index) => {
      const done = act(helper, index).then(() => true, () => false);
      return Promise.race([done, helper.thread.ended.then(() => false), timeLimit()]);
    }));
    helpers.forEach(({ thread }, index) => kept[index] || thread.terminate());
    if (kept.includes(false)) this.#limit = 'system';
    // The team may have been dismissed meanwhile.
    this.#helpers = this.#helpers.filter((_, index) => kept[index]);
  }
}

/** A page of shared memory; nothing where that cannot be had, as in pages without cross-origin isolation. */
function sharedPage() {
  if (typeof SharedArrayBuffer === 'undefined' || globalThis.crossOriginIsolated === false) return undefined;
  try {
    return new WebAssembly.Memory({ initial: 1, maximum: 1, shared: true });
  } catch {
    return undefined;
  }
}

/** False, after the time that a helper has. @returns {Promise<boolean>} */
function timeLimit() {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, HELPER_START_LIMIT_MS, false);
    /** @type {{ unref?: () => void }} */ (timer).unref?.();
  });
}
