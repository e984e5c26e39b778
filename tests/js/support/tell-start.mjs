/** For a command that is started with `--import` of this module: it tells its parent, on the channel, that a solve was asked for. */
import { Worker } from 'node:worker_threads';

const { postMessage } = Worker.prototype;

Worker.prototype.postMessage = function telling(/** @type {any} */ message, ...rest) {
  postMessage.call(this, message, ...rest);
  if (message?.path?.[0] === 'start') process.send?.('solving');
};
