/**
 * For a command that is started with `--import` of this module: its first draft is written, which is told on the channel
 * to the parent, and then the command stands still until a signal has come.
 */
import { open } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';

const file = await open(fileURLToPath(import.meta.url));
const handles = Object.getPrototypeOf(file);
await file.close();
const { sync } = handles;

handles.sync = async function pausing() {
  await sync.call(this);
  handles.sync = sync;
  const signal = /** @type {NodeJS.Signals} */ (process.env.AWAITED_SIGNAL);
  // Only signals that the command itself takes can be waited for: to listen to another one would keep it from ending the process.
  const come = new Promise((resolve) => {
    if (process.listenerCount(signal) > 0) process.once(signal, () => resolve(undefined));
  });
  const alive = setInterval(() => {}, 1000);
  process.send?.('draft');
  await come;
  clearInterval(alive);
};
