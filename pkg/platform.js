/**
 * @typedef {{
 *   'node:fs/promises': typeof import('node:fs/promises'),
 *   'node:os': typeof import('node:os'),
 *   'node:worker_threads': typeof import('node:worker_threads'),
 *   'node:url': typeof import('node:url'),
 * }} Builtins
 */

/**
 * A built-in module of Node, or nothing elsewhere. Asked for at run time, so that the same files
 * work in a page, in a bundle and in Node, and no bundler sees an import that it cannot resolve.
 *
 * @template {keyof Builtins} K
 * @param {K} name
 * @returns {Builtins[K] | undefined}
 */
export function builtin(name) {
  const node = /** @type {{ process?: NodeJS.Process }} */ (globalThis).process;
  return /** @type {Builtins[K] | undefined} */ (node?.getBuiltinModule?.(name));
}

/** Type of the message by which a worker of a browser says that it closes itself, of which there is no event. */
export const CLOSED = 'developable: closed';

/** Number of threads that run at the same time here, where that can be known. @returns {number} */
export function hardwareThreads() {
  return globalThis.navigator?.hardwareConcurrency ?? builtin('node:os')?.availableParallelism() ?? Infinity;
}

/**
 * Makes a class work with `using`, where the engine knows that.
 * @param {{ prototype: { dispose(): void } }} type
 */
export function makeDisposable(type) {
  if (Symbol.dispose) {
    Object.defineProperty(type.prototype, Symbol.dispose, {
      value: type.prototype.dispose,
      configurable: true,
      writable: true,
    });
  }
}
