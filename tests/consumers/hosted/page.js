/** Where no worker may be made from a copy: the package's folder on the site itself. */
import { init } from 'developable';
import { solve } from '../app/solve.js';

globalThis.outcome = (async () => {
  await init({ workerUrl: '/developable/worker.js' });
  return { worker: await solve() };
})();
