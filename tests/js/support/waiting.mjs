/** Waiting for what must happen. */
import { subscribe } from 'node:diagnostics_channel';
import { setTimeout as sleep } from 'node:timers/promises';

/** Milliseconds after which what has not happened never will, on a machine that may be busy. */
const PATIENCE = 60_000;

/**
 * Waits until something holds; fails when it never does.
 * @param {string} what
 * @param {() => boolean | Promise<boolean>} holds
 */
export async function until(what, holds) {
  const start = performance.now();
  while (!await holds()) {
    if (performance.now() - start > PATIENCE) throw new Error(`never happened: ${what}`);
    await sleep(5);
  }
}

/**
 * Counts how often something is told.
 * @template T
 */
export class Listener {
  count = 0;
  /** @param {T} _ */
  hear = (_) => void (this.count += 1);
  /** @param {number} [count] waits until so many more were told */
  more(count = 1) {
    const wanted = this.count + count;
    return until(`told ${wanted} times`, () => this.count >= wanted);
  }
}

/** @type {Set<import('node:worker_threads').Worker>} */
const workers = new Set();
subscribe('worker_threads', (message) => {
  const { worker } = /** @type {{ worker: import('node:worker_threads').Worker }} */ (message);
  workers.add(worker);
  worker.once('exit', () => workers.delete(worker));
});

/**
 * Waits until every worker's event loop has nothing to do. That of a worker at work never waits, however little of
 * the processor a busy machine leaves to it.
 */
export async function rest() {
  await until('the workers rest', async () => {
    const before = [...workers].map((worker) => ({ worker, usage: worker.performance.eventLoopUtilization() }));
    await sleep(100);
    return before.every(({ worker, usage }) => worker.performance.eventLoopUtilization(usage).utilization < 0.5);
  });
}
