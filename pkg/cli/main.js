/** The command: what to do, how it ends. */
import { dispose, init } from '../index.js';
import { Problem, status } from './problem.js';
import { asProblem } from './explain.js';
import { parse } from './arguments.js';
import { batchOf, runBatch } from './batch.js';
import { fit } from './fit.js';
import { asSpelled } from './flags.js';
import { helpOn, overview } from './help.js';
import { info } from './info.js';
import { occlusions } from './occlusions.js';
import { page } from './page.js';
import { dewarp, pattern, unroll } from './sheets.js';
import { analyze, patches, rulings } from './tell.js';
import { version } from './version.js';
import { whole } from './whole.js';
import { print } from './terminal.js';

/** Signals that end the work in good order, without drafts left beside the output, and the exit status of each. */
const SIGNALS = { SIGHUP: status.hungUp, SIGINT: status.interrupted, SIGTERM: status.terminated };

/**
 * @param {string[]} args
 * @returns {Promise<number>} the exit status
 */
export async function main(args) {
  const interruption = new AbortController();
  // Once each: a second signal of the same kind ends the process at once.
  for (const [signal, code] of Object.entries(SIGNALS)) {
    process.once(signal, () => interruption.abort(new Problem(code, '')));
  }
  try {
    const batch = batchOf(args);
    if (batch !== undefined) return await runBatch(batch, interruption.signal);
    const task = parse(args);
    await perform(task, interruption.signal);
    return status.success;
  } catch (error) {
    const problem = interruption.signal.aborted ? interruption.signal.reason : asProblem(error);
    if (problem.message) process.stderr.write(`developable: ${asSpelled(problem.message, args)}\n`);
    return problem.status;
  } finally {
    dispose();
  }
}

/**
 * @param {ReturnType<typeof parse>} task
 * @param {AbortSignal} signal
 */
async function perform(task, signal) {
  if ('threads' in task) await init({ threads: task.threads });
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
