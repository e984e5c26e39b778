/** The worker's script, for module workers in browsers and for worker threads in Node. */
import { useGlue } from './glue.js';
import { builtin, CLOSED } from './platform.js';
import { service } from './service.js';
import nodeEndpoint from './vendor/node-adapter.mjs';
import { expose } from './wire.js';

useGlue();
const port = builtin('node:worker_threads')?.parentPort;
if (!port) {
  const close = globalThis.close;
  globalThis.close = () => {
    globalThis.postMessage({ type: CLOSED });
    close.call(globalThis);
  };
}
expose(service, port ? nodeEndpoint(/** @type {any} */ (port)) : undefined);
