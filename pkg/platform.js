/**
 * @typedef {{
 *   'node:fs/promises': typeof import('node:fs/promises'),
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
