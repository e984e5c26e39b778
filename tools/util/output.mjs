/** Where goes what is printed: to the terminal, or to be kept until other work has printed its own. */
import { AsyncLocalStorage } from 'node:async_hooks';

/** @type {AsyncLocalStorage<string[]>} */
const kept = new AsyncLocalStorage();

/** Prints a text, or keeps it within [`keepingOutput`]. @param {string} text */
export function print(text) {
  const texts = kept.getStore();
  if (texts) texts.push(text);
  else process.stdout.write(text);
}

/**
 * Does some work and keeps what it prints by [`print`].
 * @template T
 * @param {() => Promise<T>} work
 * @returns {Promise<[T, string]>} the work's result and what it printed
 */
export async function keepingOutput(work) {
  /** @type {string[]} */
  const texts = [];
  return [await kept.run(texts, work), texts.join('')];
}
