/** The command: what to do, how it ends. */
import { dispose, init } from '../index.js';
import { Problem, status } from './problem.js';
import { asProblem } from './explain.js';
import { parse } from './arguments.js';
import { batchOf, runBatch } from './batch.js';
import { fit } from './fit.js';
import { helpOn, overview } from './help.js';
import { info } from './info.js';
import { occlusions } from './occlusions.js';
import { page } from './page.js';
import { dewarp, pattern, unroll } from './sheets.js';
import { analyze, patches, rulings } from './tell.js';
import { version } from './version.js';
import { whole } from './whole.js';
import { print, toStderr, withStreams } from './terminal.js';

/** Signals that end the work in good order, without drafts left beside the output, and the exit status of each. */
const SIGNALS = { SIGHUP: status.hungUp, SIGINT: status.interrupted, SIGTERM: status.terminated };

/**
 * The command as the whole of this process.
 * @returns {Promise<number>} the exit status
 */
export async function runProcess() {
  const interruption = new AbortController();
  // Once each: a second signal of the same kind ends the process at once.
  for (const [signal, code] of Object.entries(SIGNALS)) {
    process.once(signal, () => interruption.abort(new Problem(code, '')));
  }
  const { stdin, stdout, stderr } = process;
  try {
    return await main(process.argv.slice(2), { stdin, stdout, stderr, signal: interruption.signal });
  } finally {
    dispose();
  }
}

/**
 * The command within a process that goes on: it keeps the package's worker, and reads and writes the streams that it is given.
 * @param {string[]} args
 * @param {import('./terminal.js').Streams & { signal?: AbortSignal }} caller `signal` interrupts it
 * @returns {Promise<number>} the exit status
 */
export function main(args, { signal = new AbortController().signal, ...given }) {
  return withStreams(given, async () => {
    try {
      const batch = batchOf(args);
      if (batch !== undefined) return await runBatch(batch, signal);
      await perform(parse(args), signal);
      return status.success;
    } catch (error) {
      const problem = signal.aborted ? interrupted(signal.reason) : asProblem(error);
      if (problem.message) toStderr(`developable: ${problem.message}\n`);
      return problem.status;
    }
  });
}

/** @param {unknown} reason of an interruption */
function interrupted(reason) {
  return reason instanceof Problem ? reason : new Problem(status.interrupted, '');
}

/**
 * @param {ReturnType<typeof parse>} task
 * @param {AbortSignal} signal
 */
async function perform(task, signal) {
  if ('threads' in task && task.threads !== undefined) {
    // A worker that a command before has left may have another number of them.
    dispose();
    await init({ threads: task.threads });
    return act(task, signal).finally(dispose);
  }
  return act(task, signal);
}

/**
 * @param {ReturnType<typeof parse>} task
 * @param {AbortSignal} signal
 */
async function act(task, signal) {
  switch (task.command) {
    case 'help':
      return print(task.about === undefined ? overview() : helpOn(task.about));
    case 'version':
      return print(`${await version()}\n`);
    case 'info':
      return info(task);
    case 'occlusions':
      return occlusions(task, signal);
    case 'analyze':
      return analyze(task, signal);
    case 'patches':
      return patches(task, signal);
    case 'rulings':
      return rulings(task, signal);
    case 'unroll':
      return unroll(task, signal);
    case 'pattern':
      return pattern(task, signal);
    case 'dewarp':
      return dewarp(task, signal);
    case 'surface':
      return whole(task, signal);
    case 'page':
      return page(task, signal);
    default:
      return fit(task, signal);
  }
}
