/** The thread that a worker's script runs in: a module worker, or in Node a worker thread. */
import { messageOf } from './errors.js';
import { builtin, CLOSED } from './platform.js';
import nodeEndpoint from './vendor/node-adapter.mjs';
import { locate } from './wasm-source.js';

/**
 * @typedef {{
 *   endpoint: import('./vendor/comlink.mjs').Endpoint,
 *   ended: Promise<string>,
 *   terminate: () => void,
 *   hold: (busy: boolean) => void,
 * }} Thread `ended` gives the reason why it ended by itself
 */

/**
 * The script beside this module. Not as `new URL('./worker.js', import.meta.url)`, by which bundlers
 * would bring it along a second time, as a mere file.
 */
const ownScript = () => new URL(import.meta.url.replace(/[^/]*$/, 'worker.js'));

/**
 * A thread that runs the package's own script, or the one at an address.
 * @param {string | URL} [url]
 * @returns {Thread}
 */
export function spawn(url) {
  const threads = threadsOfNode();
  if (threads) return ofNode(new threads.Worker(url ?? ownScript(), { execArgv: [] }));
  const place = url === undefined ? optional(ownScript) : locate(url);
  if (place && isForeign(place)) return ofImport(place.href);
  return ofBrowser(trusted(() => (
    url !== undefined
      ? new Worker(url, { type: 'module', name: 'developable' })
      : // Bundlers look for exactly this.
        new Worker(new URL('./worker.js', import.meta.url), { type: 'module' })
  )));
}

/**
 * A thread that runs a script without imports, given as bytes.
 * @param {Uint8Array<ArrayBuffer>} code
 * @returns {Thread}
 */
export function spawnCode(code) {
  const threads = threadsOfNode();
  if (!threads) return ofScript(code);
  const text = encodeURIComponent(new TextDecoder().decode(code));
  return ofNode(new threads.Worker(new URL(`data:text/javascript,${text}`), { execArgv: [] }));
}

/**
 * The worker threads of Node, and of Deno, whose own workers keep the process alive.
 */
const threadsOfNode = () => (typeof Worker === 'undefined' || 'Deno' in globalThis ? builtin('node:worker_threads') : undefined);

/**
 * The package's policy of Trusted Types, without which a page that requires them starts no worker.
 * @type {{ createScriptURL: (url: string) => any } | undefined}
 */
let policy;

/**
 * Starts a worker whose address is trusted, where the page asks for that. A bundler finds only `new Worker(new URL(…))`, so the
 * address is vouched for within that call.
 * @param {() => Worker} start
 * @returns {Worker}
 */
function trusted(start) {
  const scope = /** @type {any} */ (globalThis);
  if (!scope.trustedTypes) return start();
  const { Worker: Plain } = globalThis;
  try {
    policy ??= scope.trustedTypes.createPolicy('developable', { createScriptURL: (/** @type {string} */ url) => url });
  } catch {
    return start(); // the page allows no such policy
  }
  scope.Worker = function (/** @type {string | URL} */ url, /** @type {WorkerOptions} */ options) {
    return new Plain(policy?.createScriptURL(String(url)), options);
  };
  try {
    return start();
  } finally {
    scope.Worker = Plain;
  }
}

/**
 * Nothing where a bundle knows of no such place.
 * @param {() => URL} place
 */
function optional(place) {
  try {
    return place();
  } catch {
    return undefined;
  }
}

/**
 * Whether browsers refuse to make a worker of it.
 * @param {URL} place
 */
function isForeign({ protocol, origin }) {
  const here = globalThis.location?.origin;
  return here !== undefined && /^https?:/.test(here) && /^https?:$/.test(protocol) && origin !== here;
}

/**
 * A script of this page's own that imports the one at another origin, which has to allow that (CORS).
 * @param {string} href
 */
const ofImport = (href) => ofScript(`import ${JSON.stringify(href)};`);

/** @param {BlobPart} code */
function ofScript(code) {
  const url = URL.createObjectURL(new Blob([code], { type: 'text/javascript' }));
  const worker = trusted(() => new Worker(url, { type: 'module', name: 'developable' }));
  worker.addEventListener('message', () => URL.revokeObjectURL(url), { once: true });
  return ofBrowser(worker);
}

/**
 * @param {Worker} worker
 * @returns {Thread}
 */
function ofBrowser(worker) {
  const ended = new Promise((resolve) => {
    worker.addEventListener('error', (event) => {
      event.preventDefault?.();
      // A script that cannot be loaded gives an event without a message.
      resolve(event.message || 'its script could not be loaded');
    });
    worker.addEventListener('messageerror', () => resolve('it sent what cannot be received'));
    worker.addEventListener('message', ({ data }) => data?.type === CLOSED && resolve('it closed itself'));
  });
  // Bun's workers keep the process alive unless they are told not to.
  const { ref, unref } = /** @type {{ ref?: () => void, unref?: () => void }} */ (/** @type {unknown} */ (worker));
  return {
    endpoint: worker,
    ended,
    terminate: () => worker.terminate(),
    hold: (busy) => (busy ? ref : unref)?.call(worker),
  };
}

/**
 * @param {import('node:worker_threads').Worker} worker
 * @returns {Thread}
 */
function ofNode(worker) {
  const ended = new Promise((resolve) => {
    worker.on('error', (error) => resolve(messageOf(error)));
    worker.on('messageerror', () => resolve('it sent what cannot be received'));
    worker.on('exit', (code) => resolve(`it ended with exit code ${code}`));
  });
  worker.unref();
  return {
    endpoint: nodeEndpoint(/** @type {any} */ (worker)),
    ended,
    terminate: () => void worker.terminate(),
    // An idle worker does not keep the process alive.
    hold: (busy) => (busy ? worker.ref() : worker.unref()),
  };
}
