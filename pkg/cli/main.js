/** The command: what to do, how it ends. */
import { dispose, formatOf, init } from '../index.js';
import { batchOf, runBatch } from './batch.js';
import { split } from './command-line.js';
import { asProblem } from './explain.js';
import { readBytes } from './files.js';
import { filesOf } from './globs.js';
import { Problem, status } from './problem.js';
import { isUntold, taskOf } from './task.js';
import { print, streams, withStreams } from './terminal.js';

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
 * @param {import('./terminal.js').Streams} caller
 * @returns {Promise<number>} the exit status
 */
export function main(args, { signal = new AbortController().signal, ...given }) {
  return withStreams({ ...given, signal }, async () => {
    try {
      return await perform(args, signal);
    } catch (error) {
      const problem = signal.aborted ? interrupted(signal.reason) : asProblem(error);
      if (problem.message) streams().stderr.write(`developable: ${problem.message}\n`);
      return problem.status;
    }
  });
}

/** @param {unknown} reason of an interruption */
function interrupted(reason) {
  return reason instanceof Problem ? reason : new Problem(status.interrupted, '');
}

/** @typedef {(task: import('./task.js').Task, signal: AbortSignal) => Promise<void>} Action */

/** The action of each command on one input, loaded when it is asked for. @type {Record<import('./commands.js').CommandName, () => Promise<Action>>} */
const actions = {
  fit: async () => (await import('./fit.js')).fit,
  design: async () => (await import('./fit.js')).fit,
  occlusions: async () => (await import('./occlusions.js')).occlusions,
  analyze: async () => (await import('./surface-commands.js')).analyze,
  patches: async () => (await import('./surface-commands.js')).patches,
  rulings: async () => (await import('./surface-commands.js')).rulings,
  unroll: async () => (await import('./unroll.js')).unroll,
  pattern: async () => (await import('./pattern.js')).pattern,
  dewarp: async () => (await import('./dewarp.js')).dewarp,
  info: async () => (await import('./info.js')).info,
  completion: async () => {
    const { completionFor } = await import('./completion.js');
    return ({ input }) => print(completionFor(input));
  },
};

/** The action of all commands on inputs of some modes. @type {Partial<Record<import('./task.js').Mode, () => Promise<Action>>>} */
const modeActions = {
  photo: async () => (await import('./page.js')).page,
  surface: async () => (await import('./mesh-commands.js')).whole,
};

/**
 * Finds out the formats of inputs whose names do not tell them. Of a file that cannot be read, the command that needs it says so;
 * the only input is read once.
 * @param {string[]} inputs
 */
async function tellFormats(inputs) {
  const all = streams();
  all.formats = new Map();
  for (const path of inputs.filter(isUntold)) {
    const bytes = await (path === '-' ? readBytes(path) : readBytes(path).catch(() => undefined));
    all.formats.set(path, bytes && await formatOf(bytes));
    if (bytes && inputs.length === 1) all.kept = { path, bytes };
  }
}

/**
 * @param {string[]} args
 * @param {AbortSignal} signal
 * @returns {Promise<number>} the exit status
 */
async function perform(args, signal) {
  const line = split(args);
  if ('printed' in line) {
    await print(line.printed);
    return status.success;
  }
  streams().quiet = line.values.quiet;
  const inputs = line.inputs.flatMap(filesOf);
  await tellFormats(inputs);
  const batch = batchOf({ ...line, inputs });
  if (batch !== undefined) return runBatch(batch, signal);
  const given = taskOf(line.command, inputs, line.values);
  const task = given.mode === 'mesh' ? await (await import('./side.js')).sideOrWhole(given, line.values) : given;
  const action = await (modeActions[task.mode] ?? actions[task.command])();
  if (task.threads === undefined) {
    await action(task, signal);
  } else {
    // A worker that a command before has left may have another number of them.
    dispose();
    await init({ threads: task.threads });
    await action(task, signal).finally(dispose);
  }
  return status.success;
}
